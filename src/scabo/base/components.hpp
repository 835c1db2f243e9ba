// Places in vectors that hold all components of every node: x of node i, then y (and z in space), for i = 0, 1, 2 ...;
// and in those of every contact pair: along its normal n, then along t.
//
// Elements, bodies and fields have such vectors, each with its own nodes. Which node of a part a body's node is, is the
// matter of system/dofs.hpp.
#pragma once

#include <Eigen/Core>

namespace scabo {

/// How degrees of freedom are numbered where every node has `dimension` of them: 2 in the plane, 3 in space.
struct Components {
  int dimension = 2;

  /// Place of component `c` (0: x or n, 1: y or t, 2: z) of a node or pair.
  template <typename Node>
  constexpr Eigen::Index of(Node node, int c = 0) const {
    return dimension * static_cast<Eigen::Index>(node) + c;
  }
  /// Length of a vector with all components of `nodes` nodes.
  template <typename Count>
  constexpr Eigen::Index count(Count nodes) const {
    return dimension * static_cast<Eigen::Index>(nodes);
  }
  /// The node that has a place, and the component that it is.
  constexpr int node_of(Eigen::Index place) const { return static_cast<int>(place / dimension); }
  constexpr int component_of(Eigen::Index place) const { return static_cast<int>(place % dimension); }
  /// Place of component 0 of the same node.
  constexpr Eigen::Index first_of_node(Eigen::Index place) const { return of(node_of(place)); }
  /// Motions without deformation: translations and rotations.
  constexpr int rigid_motions() const { return dimension == 2 ? 3 : 6; }
};

/// The same where everything is plane.
inline constexpr Components plane_components{2};

template <typename Node>
constexpr Eigen::Index place_of(Node node, int c = 0) {
  return plane_components.of(node, c);
}
template <typename Count>
constexpr Eigen::Index places_of(Count nodes) {
  return plane_components.count(nodes);
}

}  // namespace scabo
