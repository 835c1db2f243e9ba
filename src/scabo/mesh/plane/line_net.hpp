// The lines of a body of many cells: its outline, its regions and its cracks, cut so that they meet only at their ends.
#pragma once

#include <vector>

#include "scabo/mesh/plane/crack_net.hpp"

namespace scabo::mesh {

/// A part of an edge of the outline or of a region, or of a crack.
struct NetLine {
  geometry::Edge edge;       ///< straight or an arc
  int left = 0, right = -1;  ///< as in DomainLine
  bool crack = false;
  int of_edge = -1;                   ///< edge of the outline
  int region = -1, region_edge = -1;  ///< or of a region, counted from 0
  int of_crack = -1;                  ///< or of a crack of the body
  int start = 0, end = 0;  ///< numbers of its ends; lines that meet there have the same one, and the same coordinates
};

/// Regions are clipped to the body. Where the border of a region lies on the outline or on that of another region,
/// within 1e-9 of the size of the body, there is one line. Where several regions lie on each other, the smallest
/// counts. Lines of the outline come first, in its order.
std::vector<NetLine> line_net(const model::Body& body, const CrackNet& cracks);

}  // namespace scabo::mesh
