#include "scabo/system/solid_cut.hpp"

#include "scabo/base/cell_topology.hpp"

namespace scabo::system {

SolidCut cut_of(const mesh::SolidMesh& mesh, const element::Mat6& D, const Eigen::Vector3d& point,
                const Eigen::Vector3d& normal, const element::SuperElements& solved) {
  SolidCut cut;
  cut.normal = normal;
  const auto nodes = static_cast<std::size_t>(mesh.nodes.cols());
  std::vector<char> of_below(nodes, 0), of_above(nodes, 0);
  for (const std::vector<int>& cell : mesh.cells) {
    const auto corners = static_cast<Eigen::Index>(CellTopology::of(cell.size()).corners);
    const Eigen::Vector3d centre = mesh::nodes_of(mesh, cell).leftCols(corners).rowwise().mean();
    cut.above.push_back((centre - point).dot(normal) > 0.0);
    for (const int node : cell) (cut.above.back() ? of_above : of_below)[static_cast<std::size_t>(node)] = 1;
  }
  for (std::size_t i = 0; i < nodes; ++i) cut.on.push_back(of_below[i] && of_above[i]);
  cut.forces = Vector::Zero(3 * mesh.nodes.cols());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::vector<int>& cell = mesh.cells[c];
    if (!cut.above[c]) continue;
    Vector moved = Vector::Zero(3 * static_cast<Eigen::Index>(cell.size()));
    for (std::size_t i = 0; i < cell.size(); ++i)
      if (cut.on[static_cast<std::size_t>(cell[i])]) moved.segment<3>(3 * static_cast<Eigen::Index>(i)) = normal;
    if (moved.isZero(0.0)) continue;
    const Vector forces =
        element::cell_stiffness(mesh::nodes_of(mesh, cell), D, element::super_element_of(solved, c)) * moved;
    cut.stiffness += moved.dot(forces);
    for (std::size_t i = 0; i < cell.size(); ++i)
      cut.forces.segment<3>(3 * cell[i]) += forces.segment<3>(3 * static_cast<Eigen::Index>(i));
  }
  return cut;
}

}  // namespace scabo::system
