// One side of a contact pair, or an end of a bar: a point of a part that moves as the weighted mean of some nodes.
#pragma once

#include <cstddef>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::system {

struct PairSide {
  /// A node of the part, and its weight.
  struct Node {
    int node = -1;
    double weight = 1.0;
  };
  static constexpr std::size_t ground = static_cast<std::size_t>(-1);
  std::size_t part = 0;       ///< `ground`: a point that does not move
  std::vector<Node> nodes;    ///< the weights add up to 1; none: of a rigid part
  Vec2 point = Vec2::Zero();  ///< of a rigid part, which is plane
};

}  // namespace scabo::system
