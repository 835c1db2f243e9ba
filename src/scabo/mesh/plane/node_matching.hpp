// Node-to-node matching of two elastic edges: partners, nodes that should have a partner but have none, and elements of
// which the nodes have partners but not the shape functions. interface.hpp defines which nodes match.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scabo/mesh/plane/contact_side.hpp"

namespace scabo::mesh {

/// Position of a node relative to the edge of the other side.
enum class Lie {
  beyond,   ///< its foot is not on the edge
  at_end,   ///< its foot is at an end of the edge
  averted,  ///< opposite the edge, but facing another direction
  face_to_face
};

/// A node that should have a partner but has none.
struct LoneNode {
  bool on_a = true;    ///< it belongs to side A, otherwise to B
  int node = -1;       ///< position in that side
  int nearest = -1;    ///< position of the nearest node in the other side
  double along = 0.0;  ///< distance from that node along the edge
};

struct NodeMatching {
  std::vector<Lie> lies_a, lies_b;           ///< for every node of A and of B
  std::vector<std::array<int, 2>> partners;  ///< positions in A and B, in the order of the boundary of A
  std::optional<LoneNode> lone;              ///< the first one along the interface
  /// Whether an element has other displacements than the other side, although their nodes match: its partners are those
  /// of several elements, or of one of another order.
  bool unlike = false;
};

NodeMatching match_nodes(const ContactSide& a, const ContactSide& b);

/// n = (n_A - n_B) / |n_A - n_B|.
Vec2 common_normal(const Vec2& normal_a, const Vec2& normal_b);

/// Whether the direction from `first` to `last` is towards smaller x (if x is equal: y).
bool runs_backwards(const Vec2& first, const Vec2& last);

/// Sides whose normals deviate by more than 60 degrees from opposite directions do not face each other ...
constexpr double facing_cosine = -0.5;
/// ... but a partner may be found up to a deviation of about 87 degrees, slightly less than 90, because 90 degrees
/// falls on nodes of half circles.
constexpr double pairing_cosine = -0.05;
/// Largest cosine of the angle between the normals of points that are made opposite each other, between those two.
constexpr double sight_cosine = -0.25;
/// Largest offset along the edge, in element lengths, at which nodes lie opposite each other.
constexpr double matching_tolerance = 1e-6;

}  // namespace scabo::mesh
