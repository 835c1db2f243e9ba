// Slips that contradict small displacements: bodies that are said to press on each other where they have left each
// other.
#pragma once

#include <string>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Where pairs in contact between curved sides slide farther than the sides are long, a sentence that says so and names
/// the motion; else empty. On straight sides it is for the user to say whether the other body reaches as far. On
/// curved ones a body that contact alone holds comes to that where nothing but the differences between the normals
/// keeps it: forces then follow from a motion that leads it away.
std::string slid_beyond_sides(const Prepared& prepared, const State& state);

}  // namespace scabo::analysis
