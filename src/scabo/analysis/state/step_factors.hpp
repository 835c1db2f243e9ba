// Factors of loads and supports, and coefficients of friction, over the steps of a model.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Part of its loads that acts on every body at the end of a step, 0 or 1; step -1: before the first. Empty if no body
/// is ever absent.
std::vector<double> presence_at(const model::Model& model, int step);

/// Whether bodies or supports are taken away in a step.
bool takes_away(const model::Model& model, std::size_t step);

/// At part `s` of a step, 0 to 1: between those at the end of the step before it (or of the run from which this one
/// starts; zero before the first step) and those of the step, or along curves.
Factors factors_in(const model::Model& model, std::size_t step, double s);

/// Of a step in time, at a time since its begin.
Factors factors_at_time(const model::Model& model, std::size_t step, double time);
/// Of a step in time, their means between two times.
Factors mean_factors(const model::Model& model, std::size_t step, double from, double to);

/// Velocity of the ground along x (0) or y (1) at part `s` of a step; it was at rest before the first step in time.
double ground_velocity(const model::Model& model, std::size_t index, double s, std::size_t axis);

}  // namespace scabo::analysis
