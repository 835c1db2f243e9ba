#include "scabo/mesh/plane/fan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace scabo::mesh {

namespace {

/// The spokes from the nodes of a cell to its centre, each with a node in its middle at order 2.
class Fan {
 public:
  Fan(const Cell& cell, std::vector<Vec2>& nodes) : cell_(cell), nodes_(nodes), centre_(add(cell.centre)) {}

  std::vector<Cell> triangles() {
    std::vector<Cell> made;
    const std::vector<LineElement>& sides = cell_.boundary;
    const LineElement first = spoke(sides.front().nodes.front());
    LineElement from = first;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const LineElement to = k + 1 < sides.size() ? spoke(sides[k].nodes.back()) : first;
      Cell triangle;
      triangle.kind = CellKind::finite_element;
      triangle.centre = cell_.centre;
      triangle.boundary = {sides[k], to, {{from.nodes.rbegin(), from.nodes.rend()}}};
      triangle.materials = {cell_.materials[cell_.materials.size() > 1 ? k : 0]};
      made.push_back(std::move(triangle));
      from = to;
    }
    return made;
  }

 private:
  int add(const Vec2& x) {
    nodes_.push_back(x);
    return static_cast<int>(nodes_.size()) - 1;
  }
  LineElement spoke(int node) {
    if (cell_.boundary.front().nodes.size() == 2) return {{node, centre_}};
    return {{node, add(0.5 * (nodes_[static_cast<std::size_t>(node)] + cell_.centre)), centre_}};
  }

  const Cell& cell_;
  std::vector<Vec2>& nodes_;
  int centre_;
};

}  // namespace

std::optional<Diagnostic> divide_into_triangles(BodyMesh& mesh, const model::Body& body) {
  std::vector<Cell> cells;
  for (const Cell& cell : mesh.cells) {
    if (cell.kind == CellKind::finite_element) {
      cells.push_back(cell);
      continue;
    }
    const std::size_t count = cell.boundary.front().nodes.size();
    if (count > 3 || std::any_of(cell.boundary.begin(), cell.boundary.end(),
                                 [&](const LineElement& side) { return side.nodes.size() != count; }))
      return Diagnostic{body.source,
                        fmt::format("body '{}' touches or is tied to a body whose elements have another order: "
                                    "give both the same 'order'",
                                    body.name)};
    for (Cell& triangle : Fan(cell, mesh.nodes).triangles()) cells.push_back(std::move(triangle));
  }
  mesh.cells = std::move(cells);
  return std::nullopt;
}

}  // namespace scabo::mesh
