// A model in space as it is solved: faces as facets, supports as constraints of nodes, loads as nodal forces.
#pragma once

#include "scabo/analysis/space/face_resultants.hpp"
#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/model/solid_model.hpp"

namespace scabo::analysis {

struct PosedSolids {
  SolidModel model;
  std::vector<SolidFactors> increments;  ///< of all steps
  /// Of every increment, from 0 and from 1.
  std::vector<std::pair<std::size_t, int>> step_and_number;
  std::vector<FaceActions> resultants;  ///< of SpaceModel::resultants
};

/// Throws InputError with all mistakes of geometry: elements that are folded, faces without facets or that cannot form
/// pairs, nodes that two supports hold at different places.
PosedSolids pose_solids(const model::SpaceModel& model);

}  // namespace scabo::analysis
