// Places in vectors that hold both components of every node: x of node i, then y of node i, for i = 0, 1, 2 ...
//
// Elements, bodies and fields have such vectors, each with its own nodes. Which node of a part a body's node is, is the
// matter of system/dofs.hpp.
#pragma once

#include <Eigen/Core>

namespace scabo {

/// Place of component `c` (0: x, 1: y) of a node.
template <typename Node>
constexpr Eigen::Index place_of(Node node, int c = 0) {
  return 2 * static_cast<Eigen::Index>(node) + c;
}

/// Length of a vector with both components of `nodes` nodes.
template <typename Count>
constexpr Eigen::Index places_of(Count nodes) {
  return 2 * static_cast<Eigen::Index>(nodes);
}

}  // namespace scabo
