#include "scabo/mesh/plane/grid.hpp"

#include <cmath>

#include "scabo/mesh/plane/divide.hpp"

namespace scabo::mesh {

namespace {

double elements_on(const model::Body& body, int edge) {
  return elements_along(body.outline.edges[edge].length(), body.mesh.size);
}

Vec2 between(const Vec2& a, const Vec2& b, double t) {
  return {std::lerp(a.x(), b.x(), t), std::lerp(a.y(), b.y(), t)};  // exact at both ends and where a = b
}

}  // namespace

double count_grid_nodes(const model::Body& body) {
  const double nx = elements_on(body, 0);
  const double ny = elements_on(body, 1);
  if (body.mesh.order == 1) return (nx + 1.0) * (ny + 1.0);
  return (2.0 * nx + 1.0) * (ny + 1.0) + (nx + 1.0) * ny;
}

BodyMesh divide_grid(const model::Body& body) {
  const std::vector<model::Edge>& sides = body.outline.edges;
  ensure(body.outline.rectangle && sides.size() == 4, "a grid divides a rectangle");
  const int nx = static_cast<int>(elements_on(body, 0));
  const int ny = static_cast<int>(elements_on(body, 1));

  // Columns i and rows j are as far apart as nodes on a side: p of them to an element. Where both are odd for p = 2,
  // there is no node.
  const int p = body.mesh.order, columns = p * nx, rows = p * ny;
  ensure(p == 1 || p == 2, "a grid has elements of order 1 or 2");
  const auto node = [&](int i, int j) {
    if (p == 1) return j * (nx + 1) + i;
    const int row = (j / 2) * (3 * nx + 2) + (j % 2) * (2 * nx + 1);
    return row + (j % 2 == 0 ? i : i / 2);
  };

  BodyMesh mesh;
  mesh.nodes.reserve(static_cast<std::size_t>(count_grid_nodes(body)));
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; i += 1 + (p == 2 ? j % 2 : 0)) {
      const double s = static_cast<double>(i) / columns;
      const Vec2 bottom = between(sides[0].start, sides[1].start, s);
      const Vec2 top = between(sides[3].start, sides[2].start, s);
      mesh.nodes.push_back(between(bottom, top, static_cast<double>(j) / rows));
    }
  }
  // A side from node (i, j) in direction (di, dj).
  const auto side = [&](int i, int j, int di, int dj) {
    LineElement element;
    for (int k = 0; k <= p; ++k) element.nodes.push_back(node(i + k * di, j + k * dj));
    return element;
  };
  for (int j = 0; j < rows; j += p) {
    for (int i = 0; i < columns; i += p) {
      Cell cell;
      cell.kind = CellKind::finite_element;
      cell.materials = {body.material};
      cell.boundary = {side(i, j, 1, 0), side(i + p, j, 0, 1), side(i + p, j + p, -1, 0), side(i, j + p, 0, -1)};
      mesh.cells.push_back(std::move(cell));
    }
  }

  mesh.edges.resize(4);
  for (int i = 0; i < columns; i += p) {
    mesh.edges[0].push_back(side(i, 0, 1, 0));
    mesh.edges[2].push_back(side(columns - i, rows, -1, 0));
  }
  for (int j = 0; j < rows; j += p) {
    mesh.edges[1].push_back(side(columns, j, 0, 1));
    mesh.edges[3].push_back(side(0, rows - j, 0, -1));
  }
  mesh.corners = {node(0, 0), node(columns, 0), node(columns, rows), node(0, rows)};
  return mesh;
}

}  // namespace scabo::mesh
