#include "scabo/result/cell_polygons.hpp"

#include "scabo/base/components.hpp"

namespace scabo::result {

CellPolygons cell_polygons(const analysis::Discretisation& discretisation, const analysis::FieldState& state) {
  constexpr std::uint8_t vtk_line = 3, vtk_polygon = 7;
  CellPolygons polygons;
  std::int32_t first = 0;
  for (std::size_t b = 0; b < discretisation.mesh.bodies.size(); ++b) {
    const mesh::BodyMesh& mesh = discretisation.mesh.bodies[b];
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      const Vec2 u = state.displacements[b].segment<2>(place_of(i)) - state.reference_displacement(b);
      polygons.points.insert(polygons.points.end(), {mesh.nodes[i].x(), mesh.nodes[i].y(), 0.0});
      polygons.displacement.insert(polygons.displacement.end(), {u.x(), u.y(), 0.0});
    }
    const auto add = [&](const std::vector<int>& nodes, std::uint8_t type, const mesh::Cell& cell) {
      for (const int node : nodes) polygons.connectivity.push_back(first + node);
      polygons.offsets.push_back(static_cast<std::int32_t>(polygons.connectivity.size()));
      polygons.types.push_back(type);
      polygons.body.push_back(static_cast<std::int32_t>(b) + 1);
      polygons.material.push_back(cell.materials.front() + 1);
      polygons.finite_element.push_back(cell.kind == mesh::CellKind::finite_element ? 1 : 0);
    };
    for (const mesh::Cell& cell : mesh.cells) {
      if (!discretisation.model.bodies[b].outside) {
        add(cell.nodes(), vtk_polygon, cell);
        continue;
      }
      for (const mesh::LineElement& element : cell.boundary)
        for (std::size_t i = 0; i + 1 < element.nodes.size(); ++i)
          add({element.nodes[i], element.nodes[i + 1]}, vtk_line, cell);
    }
    first += static_cast<std::int32_t>(mesh.nodes.size());
  }
  return polygons;
}

}  // namespace scabo::result
