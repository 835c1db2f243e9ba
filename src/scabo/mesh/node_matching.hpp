// Node-to-node matching of two elastic edges: partners, and the nodes that should have one and have none.
// What matches is defined in interface.hpp.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scabo/mesh/contact_side.hpp"

namespace scabo::mesh {

/// How a node lies to the other side's edge.
enum class Lie {
  beyond,   ///< its foot is not on the edge
  at_end,   ///< its foot is an end of the edge
  averted,  ///< over the edge, but facing another way
  face_to_face
};

/// A node that should have a partner and has none.
struct LoneNode {
  bool on_a = true;    ///< of side A, else of B
  int node = -1;       ///< place in that side
  int nearest = -1;    ///< place in the other side
  double along = 0.0;  ///< distance from the nearest, along the edge
};

struct NodeMatching {
  std::vector<Lie> lies_a, lies_b;           ///< for every node of A and of B
  std::vector<std::array<int, 2>> partners;  ///< places in A and B, in the order of A's boundary
  std::optional<LoneNode> lone;              ///< the first along the interface
};

NodeMatching match_nodes(const ContactSide& a, const ContactSide& b);

/// n = (n_A - n_B) / |n_A - n_B|.
Vec2 common_normal(const Vec2& normal_a, const Vec2& normal_b);

/// Whether a run from `first` to `last` goes towards smaller x (upright: y).
bool runs_backwards(const Vec2& first, const Vec2& last);

/// Faces turned by more than 60 degrees against each other do not face each other ...
constexpr double facing_cosine = -0.5;
/// ... but a partner may still be found up to about 87. Not 90: that falls on nodes of half circles.
constexpr double pairing_cosine = -0.05;
/// Offset along the edge, in element lengths, up to which nodes lie opposite each other.
constexpr double matching_tolerance = 1e-6;

}  // namespace scabo::mesh
