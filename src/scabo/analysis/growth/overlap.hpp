// How far faces of cracks are apart, and those that overlap, which nothing keeps from it where cracks grow.
#pragma once

#include <string>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Where faces of cracks overlap under these displacements, as a reason why a run ends; empty if they do not.
std::string overlap(const Prepared& prepared, const FieldState& fields);

/// The largest opening of a crack under these displacements, along the normal of its faces; 0 if it is open nowhere.
double largest_opening(const Prepared& prepared, const FieldState& fields, int body, int crack);

}  // namespace scabo::analysis
