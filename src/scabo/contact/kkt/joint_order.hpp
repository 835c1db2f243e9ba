// In which order forces of many bodies' joints are eliminated from the saddle systems [W + D, G; G' 0] of a problem.
//
// All pairs of a joint have the same neighbours, the pairs of its two bodies: they are one vertex of a graph, which is
// dissected once (linalg/elimination_order). Systems of Newton's method have some of the forces as unknowns, other ones
// each time; an order for all is one for some. Rigid motions, which have no diagonal entry, follow the last joint of
// their body: what the body's joints together leave them as pivots is largest there.
#pragma once

#include <vector>

#include "scabo/contact/problem.hpp"
#include "scabo/linalg/multifrontal_lu.hpp"

namespace scabo::contact {

/// Pairs that the motion of this one depends on by a sparse W, and those in `with`, ascending.
std::vector<int> pairs_beside(const Problem& problem, Eigen::Index pair, std::vector<int> with = {});

class JointOrder {
 public:
  /// W sparse.
  explicit JointOrder(const Problem& problem);

  /// For a system whose unknowns are forces, `pair_of` each, and then the m rigid motions.
  linalg::OrderedBlocks blocks(const std::vector<int>& pair_of) const;

 private:
  std::vector<int> joint_of_pair_;                  // joints are numbered in the order of their elimination
  std::vector<std::vector<int>> later_;             // of each joint, ascending
  std::vector<std::vector<int>> joints_of_motion_;  // ascending
};

}  // namespace scabo::contact
