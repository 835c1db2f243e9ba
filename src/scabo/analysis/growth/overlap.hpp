// Faces of cracks that overlap, which nothing keeps from it where cracks grow.
#pragma once

#include <string>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Where faces of cracks overlap under these displacements, as a reason why a run ends; empty if they do not.
std::string overlap(const Prepared& prepared, const FieldState& fields);

}  // namespace scabo::analysis
