#include "scabo/result/body_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "scabo/base/interruption.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/geometry/plane/polygon.hpp"

namespace scabo::result {

namespace {

/// So many cells of a body may have more points than one ring: the file of its fields is small all the same.
constexpr std::size_t few_cells = 500;

/// Position of a point of a ring whose ray meets the boundary at x.
Vec2 on_ring(const mesh::Cell& cell, const Vec2& x, double xi) {
  return xi == 1.0 ? x : Vec2(cell.centre + xi * (x - cell.centre));
}

CellType type_of(element::FiniteElementKind kind) {
  switch (kind) {
    case element::FiniteElementKind::triangle3:
      return CellType::triangle;
    case element::FiniteElementKind::triangle6:
      return CellType::quadratic_triangle;
    case element::FiniteElementKind::quad4:
      return CellType::quad;
    case element::FiniteElementKind::quad8:
      return CellType::quadratic_quad;
  }
  throw BrokenInvariant("a finite element of unknown kind");
}

/// The points on the sides of cells: first the nodes; where materials meet, one more for each further material.
class SharedPoints {
 public:
  SharedPoints(Grid& grid, const std::vector<Vec2>& nodes, std::int32_t body, CellsBody& made)
      : grid_(grid), nodes_(nodes), body_(body), made_(made) {
    for (std::size_t node = 0; node < nodes.size(); ++node) add(static_cast<int>(node), -1);
  }

  /// The point of a node for cells of a material, a new one if there is none yet.
  std::int32_t of(int node, int material) {
    int& of_node = made_.materials[static_cast<std::size_t>(node)];
    if (of_node < 0) of_node = material;
    if (of_node == material) return static_cast<std::int32_t>(node);
    const auto [entry, is_new] =
        further_.try_emplace(std::pair(node, material), static_cast<std::int32_t>(made_.nodes.size()));
    if (is_new) add(node, material);
    return entry->second;
  }

 private:
  void add(int node, int material) {
    made_.nodes.push_back(node);
    made_.materials.push_back(material);
    grid_.add_point(nodes_[static_cast<std::size_t>(node)], body_);
  }

  Grid& grid_;
  const std::vector<Vec2>& nodes_;
  std::int32_t body_;
  CellsBody& made_;
  std::map<std::pair<int, int>, std::int32_t> further_;  // node and material
};

/// A finite element; `first` is the first point of its body.
void add_finite_element(Grid& grid, const element::FiniteElement& element, const CellsBody::OfCell& points,
                        std::int32_t first, std::int32_t body) {
  std::vector<std::int32_t> numbers = points.outer;
  for (std::int32_t& point : numbers) point += first;
  grid.add_cell(type_of(element.kind), numbers, body);
}

/// What is inside of a super-element: its points, and cells between the rings and at the centre.
void add_inside(Grid& grid, const mesh::Cell& cell, const std::vector<Vec2>& coordinates, CellsBody::OfCell& points,
                std::int32_t first, std::int32_t body) {
  const RingSampling& sampling = *points.sampling;
  const std::vector<int> nodes = cell.nodes();
  points.inner = static_cast<std::int32_t>(grid.point_count()) - first;
  const auto n = static_cast<std::int32_t>(sampling.nodes.size());
  const auto rings = static_cast<std::int32_t>(sampling.levels.size());
  for (std::int32_t ring = 1; ring < rings; ++ring)
    for (const int node : sampling.nodes)
      grid.add_point(on_ring(cell, coordinates[static_cast<std::size_t>(nodes[static_cast<std::size_t>(node)])],
                             sampling.levels[static_cast<std::size_t>(ring)]),
                     body);
  const std::int32_t centre = first + points.inner + (rings - 1) * n;
  for (int k = 0; k <= sampling.centre.back(); ++k) grid.add_point(cell.centre, body);
  const auto point = [&](std::int32_t ring, std::int32_t k) {
    return first + (ring == 0 ? points.outer[static_cast<std::size_t>(k)] : points.inner + (ring - 1) * n + k);
  };
  for (std::int32_t ring = 0; ring < rings; ++ring)
    for (std::size_t e = 0; e < sampling.points.size(); ++e)
      for (std::size_t i = 0; i + 1 < sampling.points[e].size(); ++i) {
        const std::int32_t a = sampling.points[e][i], b = sampling.points[e][i + 1];
        if (ring + 1 < rings)
          grid.add_cell(CellType::quad,
                        std::array{point(ring + 1, a), point(ring, a), point(ring, b), point(ring + 1, b)}, body);
        else
          grid.add_cell(CellType::triangle, std::array{centre + sampling.centre[e], point(ring, a), point(ring, b)},
                        body);
      }
}

}  // namespace

void add_super_element(Grid& grid, const mesh::BodyMesh& body, const RingSampling& sampling, std::int32_t number) {
  const mesh::Cell& whole = body.cells.front();
  const auto first = static_cast<std::int32_t>(grid.point_count());
  const auto n = static_cast<std::int32_t>(sampling.size());
  const auto node_at = [&](int node) { return body.nodes[static_cast<std::size_t>(node)]; };
  for (const double xi : sampling.levels)
    for (std::size_t point = 0; point < sampling.size(); ++point)
      grid.add_point(on_ring(whole, sampling.at(point, node_at), xi), number);
  const bool unbounded = sampling.levels.back() > 1.0;
  if (!unbounded)
    for (int c = 0; c <= sampling.centre.back(); ++c) grid.add_point(whole.centre, number);
  const auto rings = static_cast<std::int32_t>(sampling.levels.size());
  for (std::int32_t ring = 0; ring < rings; ++ring) {
    const std::int32_t outer = first + ring * n, inner = outer + n;
    for (std::size_t e = 0; e < sampling.points.size(); ++e)
      for (std::size_t i = 0; i + 1 < sampling.points[e].size(); ++i) {
        const std::int32_t a = sampling.points[e][i], b = sampling.points[e][i + 1];
        if (ring + 1 < rings && unbounded)
          grid.add_cell(CellType::quad, std::array{outer + a, inner + a, inner + b, outer + b}, number);
        else if (ring + 1 < rings)
          grid.add_cell(CellType::quad, std::array{inner + a, outer + a, outer + b, inner + b}, number);
        else if (!unbounded)
          grid.add_cell(CellType::triangle, std::array{inner + sampling.centre[e], outer + a, outer + b}, number);
      }
  }
}

CellsBody add_cells(Grid& grid, const mesh::BodyMesh& body, const element::SolvedCells& cells, SamplingLibrary& library,
                    const UsesOfCells& uses, std::int32_t number) {
  const auto first = static_cast<std::int32_t>(grid.point_count());
  CellsBody made;
  made.cells.resize(cells.size());
  SharedPoints points(grid, body.nodes, number, made);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    interruption_point();
    const mesh::Cell& cell = body.cells[c];
    CellsBody::OfCell& of_cell = made.cells[c];
    if (!cells[c]) {
      const element::FiniteElement element = element::finite_element_of(cell, body.nodes);
      for (const int node : element.nodes()) of_cell.outer.push_back(points.of(node, cell.materials.front()));
      continue;
    }
    of_cell.sampling = library.of_cell(*cells[c], uses.at(cells[c].get()), cells.size() <= few_cells);
    const RingSampling& sampling = *of_cell.sampling;
    const std::vector<int> nodes = cell.nodes();
    for (std::size_t k = 0; k < sampling.nodes.size(); ++k)
      of_cell.outer.push_back(points.of(nodes[static_cast<std::size_t>(sampling.nodes[k])],
                                        cells[c]->sectors.material_of(sampling.sectors[k])));
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    interruption_point();
    if (cells[c])
      add_inside(grid, body.cells[c], body.nodes, made.cells[c], first, number);
    else
      add_finite_element(grid, element::finite_element_of(body.cells[c], body.nodes), made.cells[c], first, number);
  }
  return made;
}

RigidBody add_rigid(Grid& grid, const model::Outline& outline, std::int32_t number) {
  std::vector<std::size_t> cell;
  RigidBody body;
  const Vec2 centroid = outline.centroid();
  for (const Vec2& x : polygon_of(outline)) {
    cell.push_back(grid.point_count());
    grid.add_point(x, number);
    body.arms.push_back(x - centroid);
  }
  grid.add_cell(CellType::polygon, cell, number);
  return body;
}

}  // namespace scabo::result
