// How long steps in time may be for the curves that they follow. A time step feels the mean of a curve over it.
#pragma once

#include <cstddef>
#include <vector>

#include "scabo/model/step.hpp"

namespace scabo::model {

/// Indices of the curves that a step in time follows: of the ground, of loads and of supports.
std::vector<std::size_t> curves_in_time(const Step& step);

/// How much of a curve time steps of this size average away: of its mean square over the duration that of what deviates
/// from the means over the steps, 0 to 1; 0 for more than a million steps.
double part_averaged_away(const Curve& curve, double duration, double size);

/// The longest time steps that average away no more than a hundredth of a curve: 18 in a period of a sine.
double resolving_step(const Curve& curve, double duration);

}  // namespace scabo::model
