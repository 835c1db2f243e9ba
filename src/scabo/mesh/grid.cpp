#include "scabo/mesh/grid.hpp"

#include <cmath>

#include "scabo/mesh/divide.hpp"

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
  return (2.0 * nx + 1.0) * (ny + 1.0) + (nx + 1.0) * ny;
}

BodyMesh divide_grid(const model::Body& body) {
  const std::vector<model::Edge>& sides = body.outline.edges;
  ensure(body.outline.rectangle && sides.size() == 4, "a grid divides a rectangle");
  const int nx = static_cast<int>(elements_on(body, 0));
  const int ny = static_cast<int>(elements_on(body, 1));

  // Column i and row j count half elements; where both are odd there is no node.
  const auto node = [nx](int i, int j) {
    const int row = (j / 2) * (3 * nx + 2) + (j % 2) * (2 * nx + 1);
    return row + (j % 2 == 0 ? i : i / 2);
  };

  BodyMesh mesh;
  mesh.nodes.reserve(static_cast<std::size_t>(count_grid_nodes(body)));
  for (int j = 0; j <= 2 * ny; ++j) {
    for (int i = 0; i <= 2 * nx; i += 1 + j % 2) {
      const double s = i / (2.0 * nx);
      const Vec2 bottom = between(sides[0].start, sides[1].start, s);
      const Vec2 top = between(sides[3].start, sides[2].start, s);
      mesh.nodes.push_back(between(bottom, top, j / (2.0 * ny)));
    }
  }
  for (int j = 0; j < 2 * ny; j += 2) {
    for (int i = 0; i < 2 * nx; i += 2) {
      Cell cell;
      cell.kind = CellKind::finite_element;
      cell.materials = {body.material};
      cell.boundary = {{{node(i, j), node(i + 1, j), node(i + 2, j)}},
                       {{node(i + 2, j), node(i + 2, j + 1), node(i + 2, j + 2)}},
                       {{node(i + 2, j + 2), node(i + 1, j + 2), node(i, j + 2)}},
                       {{node(i, j + 2), node(i, j + 1), node(i, j)}}};
      mesh.cells.push_back(std::move(cell));
    }
  }

  mesh.edges.resize(4);
  for (int i = 0; i < 2 * nx; i += 2) {
    const int k = 2 * nx - i;
    mesh.edges[0].push_back({{node(i, 0), node(i + 1, 0), node(i + 2, 0)}});
    mesh.edges[2].push_back({{node(k, 2 * ny), node(k - 1, 2 * ny), node(k - 2, 2 * ny)}});
  }
  for (int j = 0; j < 2 * ny; j += 2) {
    const int k = 2 * ny - j;
    mesh.edges[1].push_back({{node(2 * nx, j), node(2 * nx, j + 1), node(2 * nx, j + 2)}});
    mesh.edges[3].push_back({{node(0, k), node(0, k - 1), node(0, k - 2)}});
  }
  mesh.corners = {node(0, 0), node(2 * nx, 0), node(2 * nx, 2 * ny), node(0, 2 * ny)};
  return mesh;
}

}  // namespace scabo::mesh
