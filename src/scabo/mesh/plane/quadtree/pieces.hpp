// A mesh of polygons in the making: the cells that lines cut are improved before it becomes a PolygonMesh.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scabo/mesh/plane/domain.hpp"

namespace scabo::mesh::quadtree {

/// What holds a node in its place.
enum class Hold : signed char { nothing, line, corner };

struct Pieces {
  std::vector<Vec2> nodes;
  std::vector<Hold> holds;                            // one for each node
  std::vector<int> line_of;                           // of a node held by a line: which one, otherwise -1
  std::vector<PolygonCell> cells;                     // no nodes: given up
  std::vector<double> sizes;                          // of the cell of the tree that a cell comes from
  std::size_t first_cut = 0;                          // cells before are rectangles of the tree
  std::vector<std::vector<int>> chains;               // nodes along each line from its start to its end
  std::unordered_map<std::uint64_t, int> line_sides;  // sides on lines, by `side_key`
  std::vector<DomainLine> curved;  // the lines, if sides on arcs are going to be arcs; empty if they remain chords
};

/// Of the side between two nodes, the same in both directions.
inline std::uint64_t side_key(int a, int b) {
  return a < b ? (std::uint64_t(a) << 32) | std::uint32_t(b) : (std::uint64_t(b) << 32) | std::uint32_t(a);
}

/// How well a point sees the sides of a polygon.
struct Sight {
  Vec2 centre = Vec2::Zero();
  double clearance = -1.0;  ///< least distance at which the line of a side passes the centre on its left; a length
};

double polygon_area(const std::vector<Vec2>& corners);
/// The centroid if it sees all sides well, otherwise the point that sees them best; negative clearance if none does.
Sight best_sight(const std::vector<Vec2>& corners);
/// The sight of the polygon, or of a chain of sides that is not closed, from a given point.
double clearance_from(const Vec2& centre, const std::vector<Vec2>& corners, bool closed);

/// Two parts of a closed polygon, given by its node numbers, divided between the corner at place `from` and the one at
/// place `to`, so that each part sees its sides best. Without a place for `from`: between any two. Both empty if no
/// division improves the worse part.
struct Halves {
  std::vector<int> first, second;
  double clearance = -1.0;
};
Halves best_division(const std::vector<int>& polygon, const std::vector<Vec2>& nodes, int from = -1);

/// The steps, in this order.
void collapse_short_sides(Pieces& pieces, double shortest);
void divide_unseen_cells(Pieces& pieces);
void merge_small_cells(Pieces& pieces);
/// Sets centres. Appends a point to `trouble` for each cell whose sides no point sees.
void place_centres(Pieces& pieces, std::vector<Vec2>& trouble);
/// Appends the nodes along lines that no cell has: cells so small that rounding decides what cuts them.
void find_lost_nodes(const Pieces& pieces, std::vector<Vec2>& trouble);
/// Gives both sides of cracks nodes of their own and returns the mesh without unused nodes.
PolygonMesh finished(Pieces&& pieces, const std::vector<DomainLine>& lines);

}  // namespace scabo::mesh::quadtree
