#include "scabo/result/solid/solid_stress.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace scabo::result {

namespace {

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

}  // namespace

Eigen::Matrix3d tensor_of(const element::Vec6& s) {
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return tensor;
}

StressInSpace::StressInSpace(const element::Vec6& stress) {
  const Eigen::Matrix3d tensor = tensor_of(stress);
  principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, false).eigenvalues().reverse();
  von_mises = std::sqrt(1.5) * (tensor - tensor.trace() / 3.0 * Eigen::Matrix3d::Identity()).norm();
}

SolidStress::SolidStress(const analysis::SolidModel& model, const analysis::SolidIncrement& increment, std::size_t body)
    : body_(model.bodies[body]), u_(increment.u[body]), heated_(increment.heated[body]) {
  if (is_rigid()) return;
  D_ = element::elasticity_in_space(body_.young, body_.poisson);
  for (std::size_t i = 0; i < model.preloads.size(); ++i)
    if (model.preloads[i].body == static_cast<int>(body)) {
      cut_ = &model.preloads[i].cut;
      shortening_ = increment.tensions[i].shortening;
    }
}

Vector SolidStress::displacements_of(std::size_t cell) const {
  const std::vector<int>& nodes = body_.mesh.cells[cell];
  Vector of_cell(3 * static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    auto of_node = of_cell.segment<3>(3 * static_cast<Eigen::Index>(i));
    of_node = u_.segment<3>(3 * nodes[i]);
    if (cut_ != nullptr && cut_->above[cell] && cut_->on[static_cast<std::size_t>(nodes[i])])
      of_node -= shortening_ * cut_->normal;
  }
  return of_cell;
}

element::Vec6 SolidStress::at(std::size_t cell, const Vector& lambda) const {
  const std::vector<int>& nodes = body_.mesh.cells[cell];
  element::Vec6 stress = D_ * element::strain_at(mesh::nodes_of(body_.mesh, nodes), displacements_of(cell), lambda);
  if (heated_.size() == 0) return stress;
  const Vector N = geometry::SimplexBasis::of(3, static_cast<int>(nodes.size())).values(lambda);
  double change = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) change += N[static_cast<Eigen::Index>(i)] * heated_[nodes[i]];
  stress -= body_.expansion * change * D_.leftCols<3>().rowwise().sum();
  return stress;
}

Matrix SolidStress::at_nodes() const {
  const mesh::SolidMesh& mesh = body_.mesh;
  Matrix sum = Matrix::Zero(6, mesh.nodes.cols());
  if (is_rigid()) return sum;
  Vector count = Vector::Zero(mesh.nodes.cols());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::vector<int>& cell = mesh.cells[c];
    const Matrix nodes = mesh::nodes_of(mesh, cell), places = places_of_nodes(cell.size());
    const Vector of_cell = displacements_of(c);
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Vector lambda = places.col(static_cast<Eigen::Index>(i));
      sum.col(cell[i]) += D_ * element::strain_at(nodes, of_cell, lambda);
      count[cell[i]] += 1.0;
    }
  }
  for (Eigen::Index i = 0; i < sum.cols(); ++i)
    if (count[i] > 0.0) sum.col(i) /= count[i];
  if (heated_.size() > 0) sum -= body_.expansion * D_.leftCols<3>().rowwise().sum() * heated_.transpose();
  return sum;
}

}  // namespace scabo::result
