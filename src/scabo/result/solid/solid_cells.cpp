#include "scabo/result/solid/solid_cells.hpp"

#include "scabo/result/solid/solid_stress.hpp"

namespace scabo::result {

namespace {

void add_stress(const element::Vec6& stress, SolidCells& cells) {
  const StressInSpace measures(stress);
  for (int k = 0; k < 6; ++k) cells.stress.push_back(static_cast<float>(stress[k]));
  cells.principal_1.push_back(static_cast<float>(measures.principal[0]));
  cells.principal_2.push_back(static_cast<float>(measures.principal[1]));
  cells.principal_3.push_back(static_cast<float>(measures.principal[2]));
  cells.von_mises.push_back(static_cast<float>(measures.von_mises));
}

}  // namespace

std::uint8_t vtk_type(std::size_t nodes) {
  constexpr std::uint8_t tetra = 10, quadratic_tetra = 24, quadratic_hexahedron = 25, quadratic_wedge = 26;
  if (nodes == 4) return tetra;
  if (nodes == 10) return quadratic_tetra;
  return nodes == 15 ? quadratic_wedge : quadratic_hexahedron;
}

SolidCells solid_cells(const analysis::SolidModel& model, const analysis::SolidIncrement& increment) {
  const std::vector<Vector>& u = increment.u;
  SolidCells cells;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (increment.is_absent(b)) continue;
    const mesh::SolidMesh& mesh = model.bodies[b].mesh;
    const auto first = static_cast<std::int32_t>(cells.point_body.size()), number = static_cast<std::int32_t>(b + 1);
    cells.points.insert(cells.points.end(), mesh.nodes.data(), mesh.nodes.data() + mesh.nodes.size());
    cells.displacement.insert(cells.displacement.end(), u[b].data(), u[b].data() + u[b].size());
    cells.point_body.insert(cells.point_body.end(), static_cast<std::size_t>(mesh.nodes.cols()), number);
    const Matrix stresses = SolidStress(model, increment, b).at_nodes();
    for (Eigen::Index i = 0; i < stresses.cols(); ++i) add_stress(stresses.col(i), cells);
    for (const std::vector<int>& cell : mesh.cells) {
      for (const int node : cell) cells.connectivity.push_back(first + node);
      cells.offsets.push_back(static_cast<std::int32_t>(cells.connectivity.size()));
      cells.types.push_back(vtk_type(cell.size()));
      cells.cell_body.push_back(number);
    }
  }
  return cells;
}

}  // namespace scabo::result
