#include "scabo/files/imported_mesh.hpp"

#include <array>
#include <cmath>

#include "scabo/base/error.hpp"
#include "scabo/files/side_table.hpp"

namespace scabo::files {

namespace {

/// Twice the area between a side and the point `o`, positive if `o` is on its left; exact for a parabola: the triangle,
/// and 2/3 of the parallelogram of chord and sagitta, twice.
double twice_sector(const ImportedMesh& mesh, const Facet& facet, const Vec2& o) {
  const auto at = [&mesh](int node) -> const Vec2& { return mesh.nodes[static_cast<std::size_t>(node)]; };
  const Vec2& a = at(facet.start);
  const Vec2& b = at(facet.end);
  double sum = cross(a - o, b - o);
  if (facet.middle >= 0) sum += 4.0 / 3.0 * cross(at(facet.middle) - a, b - a);
  return sum;
}

}  // namespace

bool is_quadratic(CellKind kind) {
  return kind == CellKind::triangle6 || kind == CellKind::quad8 || kind == CellKind::quadratic_polygon;
}

std::string_view name_of(CellKind kind) {
  switch (kind) {
    case CellKind::triangle3:
      return "triangle with 3 nodes";
    case CellKind::quad4:
      return "quadrilateral with 4 nodes";
    case CellKind::triangle6:
      return "triangle with 6 nodes";
    case CellKind::quad8:
      return "quadrilateral with 8 nodes";
    case CellKind::polygon:
      return "polygon";
    case CellKind::quadratic_polygon:
      return "quadratic polygon";
  }
  return "cell";
}

Facet side_of(const ImportedCell& cell, int i) {
  const int n = cell.corners();
  const auto at = [&cell](int k) { return cell.nodes[static_cast<std::size_t>(k)]; };
  return {at(i), at(i + 1 == n ? 0 : i + 1), is_quadratic(cell.kind) ? at(n + i) : -1};
}

double area_of(const ImportedMesh& mesh, const ImportedCell& cell) {
  const Vec2& o = mesh.nodes[static_cast<std::size_t>(cell.nodes.front())];
  double twice = 0.0;
  for (int i = 0; i < cell.corners(); ++i) twice += twice_sector(mesh, side_of(cell, i), o);
  return 0.5 * twice;
}

double length_of(const ImportedMesh& mesh, const Facet& facet) {
  const auto at = [&mesh](int node) -> const Vec2& { return mesh.nodes[static_cast<std::size_t>(node)]; };
  const Vec2 chord = at(facet.end) - at(facet.start);
  if (facet.middle < 0) return chord.norm();
  // x(s) = a (s^2 - s)/2 + m (1 - s^2) + b (s^2 + s)/2, -1 <= s <= 1, so x'(s) = chord/2 + s (a + b - 2 m).
  const Vec2 bend = at(facet.start) + at(facet.end) - 2.0 * at(facet.middle);
  constexpr std::array<std::array<double, 2>, 3> gauss{{{0.0, 128.0 / 225.0},
                                                        {0.53846931010568309104, 0.47862867049936646804},
                                                        {0.90617984593866399280, 0.23692688505618908751}}};
  double sum = 0.0;
  for (const auto& [s, weight] : gauss) {
    sum += weight * (0.5 * chord + s * bend).norm();
    if (s > 0.0) sum += weight * (0.5 * chord - s * bend).norm();
  }
  return sum;
}

std::vector<BoundaryLoop> boundary_facets(const ImportedMesh& mesh) {
  const SideTable table(mesh.cells, static_cast<int>(mesh.nodes.size()));
  ensure(!table.conflict(), "cells of an imported mesh overlap");
  std::vector<std::vector<bool>> taken(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    taken[c].assign(static_cast<std::size_t>(mesh.cells[c].corners()), false);
  }
  const auto next_in_cell = [&mesh](CellSide s) {
    return CellSide{s.cell, (s.side + 1) % mesh.cells[static_cast<std::size_t>(s.cell)].corners()};
  };
  std::vector<BoundaryLoop> loops;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (int i = 0; i < mesh.cells[c].corners(); ++i) {
      CellSide side{static_cast<int>(c), i};
      if (taken[c][static_cast<std::size_t>(i)] || table.neighbour(side)) continue;
      BoundaryLoop loop;
      const Vec2& o = mesh.nodes[static_cast<std::size_t>(side_of(mesh.cells[c], i).start)];
      while (!taken[static_cast<std::size_t>(side.cell)][static_cast<std::size_t>(side.side)]) {
        taken[static_cast<std::size_t>(side.cell)][static_cast<std::size_t>(side.side)] = true;
        const Facet facet = side_of(mesh.cells[static_cast<std::size_t>(side.cell)], side.side);
        loop.facets.push_back(facet);
        loop.area += 0.5 * twice_sector(mesh, facet, o);
        // Around the end node, through the cells that are joined there, to the next side on the boundary.
        side = next_in_cell(side);
        while (const auto other = table.neighbour(side)) side = next_in_cell(*other);
      }
      ensure(loop.facets.back().end == loop.facets.front().start, "a boundary of an imported mesh is not closed");
      loops.push_back(std::move(loop));
    }
  }
  return loops;
}

}  // namespace scabo::files
