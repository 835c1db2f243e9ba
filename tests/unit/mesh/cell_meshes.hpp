// Meshes of few cells made by hand: cells are given by their corners, and share the nodes of their sides.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::test {

class CellMesh {
 public:
  explicit CellMesh(int order) : order_(order) {}

  int node(const Vec2& x) {
    mesh.nodes.push_back(x);
    return static_cast<int>(mesh.nodes.size()) - 1;
  }

  /// `corners` counter-clockwise; the scaling centre is their mean.
  mesh::Cell& add(mesh::CellKind kind, const std::vector<int>& corners) {
    mesh::Cell cell;
    cell.kind = kind;
    cell.materials = {0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      cell.boundary.push_back(side(corners[i], corners[(i + 1) % corners.size()]));
      cell.centre += mesh.nodes[static_cast<std::size_t>(corners[i])] / static_cast<double>(corners.size());
    }
    mesh.cells.push_back(std::move(cell));
    return mesh.cells.back();
  }

  /// A quadrilateral, or two triangles.
  void add_quad(const std::array<int, 4>& c, bool triangles) {
    if (!triangles) {
      add(mesh::CellKind::finite_element, {c[0], c[1], c[2], c[3]});
      return;
    }
    add(mesh::CellKind::finite_element, {c[0], c[1], c[2]});
    add(mesh::CellKind::finite_element, {c[0], c[2], c[3]});
  }

  mesh::LineElement side(int a, int b) {
    if (order_ == 1) return {{a, b}};
    const auto [at, added] = middles_.emplace(std::minmax(a, b), 0);
    if (added)
      at->second = node(0.5 * (mesh.nodes[static_cast<std::size_t>(a)] + mesh.nodes[static_cast<std::size_t>(b)]));
    return {{a, at->second, b}};
  }

  mesh::BodyMesh mesh;

 private:
  int order_;
  std::map<std::pair<int, int>, int> middles_;
};

/// [0, nx] x [0, ny], each node moved by `map`; edges as those of a rectangle.
inline mesh::BodyMesh mapped_grid(int nx, int ny, int order, bool triangles,
                                  const std::function<Vec2(const Vec2&)>& map) {
  CellMesh made(order);
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) made.node({i, j});
  const auto at = [nx](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      made.add_quad({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, triangles);
  made.mesh.edges.resize(4);
  for (int i = 0; i < nx; ++i) {
    made.mesh.edges[0].push_back(made.side(at(i, 0), at(i + 1, 0)));
    made.mesh.edges[2].push_back(made.side(at(nx - i, ny), at(nx - i - 1, ny)));
  }
  for (int j = 0; j < ny; ++j) {
    made.mesh.edges[1].push_back(made.side(at(nx, j), at(nx, j + 1)));
    made.mesh.edges[3].push_back(made.side(at(0, ny - j), at(0, ny - j - 1)));
  }
  for (Vec2& x : made.mesh.nodes) x = map(x);
  return made.mesh;
}

}  // namespace scabo::test
