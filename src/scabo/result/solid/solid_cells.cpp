#include "scabo/result/solid/solid_cells.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "scabo/element/space/tetrahedron.hpp"

namespace scabo::result {

namespace {

constexpr std::uint8_t vtk_tetra = 10, vtk_quadratic_tetra = 24;

/// Barycentric coordinates of the nodes of a tetrahedron, one column each.
Matrix places_of_nodes(std::size_t nodes) {
  Matrix places = Matrix::Zero(4, static_cast<Eigen::Index>(nodes));
  places.leftCols(4) = Matrix::Identity(4, 4);
  if (nodes == 4) return places;
  Eigen::Index column = 4;
  for (const std::array<int, 2>& edge : geometry::SimplexBasis::of(3, 10).edges()) {
    places(edge[0], column) = places(edge[1], column) = 0.5;
    ++column;
  }
  return places;
}

/// A cut of a body, and by how much its parts are pulled together.
using PulledTogether = std::pair<const system::SolidCut*, double>;

/// `heated`: change of temperature of the nodes, or empty.
Matrix stresses_at_nodes(const analysis::SolidBody& body, const Vector& u, const Vector& heated,
                         const PulledTogether& pulled) {
  const mesh::SolidMesh& mesh = body.mesh;
  const element::Mat6 D = element::elasticity_in_space(body.young, body.poisson);
  Matrix sum = Matrix::Zero(6, mesh.nodes.cols());
  if (body.rigid_at) return sum;
  Vector count = Vector::Zero(mesh.nodes.cols());
  const auto& [cut, shortening] = pulled;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::vector<int>& cell = mesh.cells[c];
    const Matrix nodes = mesh::nodes_of(mesh, cell), places = places_of_nodes(cell.size());
    Vector of_cell(3 * nodes.cols());
    for (std::size_t i = 0; i < cell.size(); ++i) {
      auto of_node = of_cell.segment<3>(3 * static_cast<Eigen::Index>(i));
      of_node = u.segment<3>(3 * cell[i]);
      if (cut != nullptr && cut->above[c] && cut->on[static_cast<std::size_t>(cell[i])])
        of_node -= shortening * cut->normal;
    }
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Vector lambda = places.col(static_cast<Eigen::Index>(i));
      sum.col(cell[i]) += D * element::strain_at(nodes, of_cell, lambda);
      count[cell[i]] += 1.0;
    }
  }
  for (Eigen::Index i = 0; i < sum.cols(); ++i)
    if (count[i] > 0.0) sum.col(i) /= count[i];
  if (heated.size() > 0) sum -= body.expansion * D.leftCols<3>().rowwise().sum() * heated.transpose();
  return sum;
}

void add_stress(const element::Vec6& s, SolidCells& cells) {
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, false).eigenvalues();
  const Eigen::Matrix3d deviator = tensor - tensor.trace() / 3.0 * Eigen::Matrix3d::Identity();
  for (int k = 0; k < 6; ++k) cells.stress.push_back(static_cast<float>(s[k]));
  cells.principal_1.push_back(static_cast<float>(principal[2]));
  cells.principal_2.push_back(static_cast<float>(principal[1]));
  cells.principal_3.push_back(static_cast<float>(principal[0]));
  cells.von_mises.push_back(static_cast<float>(std::sqrt(1.5) * deviator.norm()));
}

}  // namespace

Matrix stresses_at_nodes(const analysis::SolidModel& model, const analysis::SolidIncrement& increment,
                         std::size_t body) {
  PulledTogether pulled{nullptr, 0.0};
  for (std::size_t i = 0; i < model.preloads.size(); ++i)
    if (model.preloads[i].body == static_cast<int>(body))
      pulled = {&model.preloads[i].cut, increment.tensions[i].shortening};
  return stresses_at_nodes(model.bodies[body], increment.u[body], increment.heated[body], pulled);
}

SolidCells solid_cells(const analysis::SolidModel& model, const analysis::SolidIncrement& increment) {
  const std::vector<Vector>& u = increment.u;
  SolidCells cells;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const mesh::SolidMesh& mesh = model.bodies[b].mesh;
    const auto first = static_cast<std::int32_t>(cells.point_body.size()), number = static_cast<std::int32_t>(b + 1);
    cells.points.insert(cells.points.end(), mesh.nodes.data(), mesh.nodes.data() + mesh.nodes.size());
    cells.displacement.insert(cells.displacement.end(), u[b].data(), u[b].data() + u[b].size());
    cells.point_body.insert(cells.point_body.end(), static_cast<std::size_t>(mesh.nodes.cols()), number);
    const Matrix stresses = stresses_at_nodes(model, increment, b);
    for (Eigen::Index i = 0; i < stresses.cols(); ++i) add_stress(stresses.col(i), cells);
    for (const std::vector<int>& cell : mesh.cells) {
      for (const int node : cell) cells.connectivity.push_back(first + node);
      cells.offsets.push_back(static_cast<std::int32_t>(cells.connectivity.size()));
      cells.types.push_back(cell.size() == 4 ? vtk_tetra : vtk_quadratic_tetra);
      cells.cell_body.push_back(number);
    }
  }
  return cells;
}

}  // namespace scabo::result
