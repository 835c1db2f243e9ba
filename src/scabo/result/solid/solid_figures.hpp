// Numbers of an increment in space: totals of contacts, reactions, and what the history asks for.
#pragma once

#include <vector>

#include "scabo/analysis/space/posed_solids.hpp"

namespace scabo::result {

/// Of the pairs of one contact; forces on side b.
struct SolidTotals {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), tangential = Eigen::Vector3d::Zero(),
                  moment = Eigen::Vector3d::Zero();
  double largest_pressure = 0.0, largest_gap = 0.0;
  int open = 0, stick = 0, slip = 0, broken = 0;
};

SolidTotals totals_of(const analysis::SolidIncrement& increment, std::size_t contact, const Eigen::Vector3d& about);

/// What a support exerts on its body.
struct SolidReaction {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  ///< the latter about the origin
};
std::vector<SolidReaction> reactions_of(const analysis::PosedSolids& posed, std::size_t supports,
                                        const analysis::SolidIncrement& increment);

double value_of(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                const analysis::SolidIncrement& increment, const model::SpaceQuantity& quantity);

}  // namespace scabo::result
