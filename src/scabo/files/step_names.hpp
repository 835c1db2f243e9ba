// Names of faces in STEP files (ISO 10303-21), which OpenCASCADE does not hand over: MANIFOLD_SOLID_BREP or
// BREP_WITH_VOIDS, its shells, and their ADVANCED_FACEs with a name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::files {

struct StepFace {
  std::string name;                       ///< often empty
  std::vector<Eigen::Vector3d> vertices;  ///< ends of its edges, in the unit and place of the file
};

/// The faces of every solid, in the order of the file. What is not understood is passed over.
std::vector<std::vector<StepFace>> step_solids(std::string_view text);

}  // namespace scabo::files
