// *TRANSFORM of a deck of solids: axes of nodes of their own, along which *BOUNDARY and *CLOAD count.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "scabo/convert/deck_references.hpp"
#include "scabo/convert/remark.hpp"
#include "scabo/files/abaqus.hpp"

namespace scabo::convert {

struct NodeAxes {
  Eigen::Matrix3d rows;  ///< the axes, of length 1
  double radius = -1.0;  ///< of TYPE=C: distance from its axis; else negative
  files::DeckPlace at;
};

/// By node of the mesh; the last *TRANSFORM of a node counts. Those of `references` become remarks.
std::map<int, NodeAxes> transforms_of(const files::AbaqusDeck& deck, const std::vector<DeckReference>& references,
                                      Remarks& remarks);

}  // namespace scabo::convert
