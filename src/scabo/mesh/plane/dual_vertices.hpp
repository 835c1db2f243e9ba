// Vertices of the triangulation whose dual is a mesh of polygons, and the triangulation itself: first steps of
// polygon_mesh (polygons.hpp).
#pragma once

#include <unordered_map>
#include <utility>
#include <vector>

#include "scabo/mesh/plane/domain.hpp"
#include "scabo/mesh/plane/former_vertices.hpp"
#include "scabo/mesh/plane/triangulation.hpp"

namespace scabo::mesh {

/// A line or a part of one, with vertices of the triangulation at both ends and at the middles of its facets, except
/// for the first and the last.
struct LinePiece {
  int line = 0;
  int begin = 0, end = 0;     ///< points of the line from where to where: end - begin facets
  std::vector<int> vertices;  ///< two for a single facet, otherwise as many as there are facets
  int facets() const { return end - begin; }
};

/// The edge of the triangulation from vertex `edge` to vertex `edge` + 1 of a piece. With two facets or more, it
/// contains the point begin + edge + 1 of the line.
struct PieceEdge {
  int piece = -1, edge = -1;
};

/// Vertices: those where pieces end (corners), those in the middle of facets, those inside, in this order.
struct DualVertices {
  std::vector<LinePiece> pieces;
  std::vector<std::pair<int, int>> ends;  ///< for each line, the corners at its start and its end
  std::vector<Vec2> points;
  std::vector<double> spacing;  ///< wanted distance from neighbours
  int corners = 0, on_lines = 0;
  std::vector<std::pair<int, int>> segments;             ///< all edges of pieces
  std::unordered_map<long long, PieceEdge> piece_edges;  ///< by pair_key of two vertices

  static long long pair_key(int a, int b) {
    return a < b ? (static_cast<long long>(a) << 32) + b : (static_cast<long long>(b) << 32) + a;
  }
};

/// Corners with their positions, and pieces of all lines. `divide_arcs`: at every point of an arc, not only where
/// its facets turn by much.
DualVertices vertices_on_lines(const Domain& domain, bool divide_arcs);

/// Index of the corner at `place`; -1: none. After triangulate_domain, which sets the spacing there.
int corner_at(const DualVertices& vertices, const Vec2& place);

struct DualTriangulation {
  DualVertices vertices;  ///< with those inside
  std::vector<Triangle> triangles;
  std::vector<int> region;  ///< of each triangle; -1: outside
};

/// Adds the vertices inside, triangulates and smooths. The order of the triangles follows from that of their vertices.
/// `former`: segments and vertices before, which become those of this triangulation; empty: none stay.
DualTriangulation triangulate_domain(const Domain& domain, DualVertices vertices, FormerVertices& former);

}  // namespace scabo::mesh
