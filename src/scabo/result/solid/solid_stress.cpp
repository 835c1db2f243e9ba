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

Matrix tetrahedron_strains(const Matrix& nodes, const Vector& u) {
  const Matrix places = places_of_nodes(static_cast<std::size_t>(nodes.cols()));
  Matrix strains(6, nodes.cols());
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) strains.col(i) = element::strain_at(nodes, u, places.col(i));
  return strains;
}

element::PyramidPlace pyramid_of(const PlaceInCell& place) { return {place.facet, place.lambda}; }

/// Of a change that is linear in the coordinates; `change`: at the nodes.
double temperature_at(const Matrix& nodes, const Vector& change, const PlaceInCell& place) {
  if (place.facet < 0)
    return change.dot(geometry::SimplexBasis::of(3, static_cast<int>(nodes.cols())).values(place.lambda));
  return element::value_in_super_element(nodes, change, pyramid_of(place));
}

}  // namespace

Eigen::Vector3d CellField::displacement_at(const PlaceInCell& place) const {
  if (interior_) return interior_->displacement_at(pyramid_of(place));
  if (place.facet >= 0) {  // of a rigid body: linear
    Eigen::Vector3d at;
    for (int k = 0; k < 3; ++k)
      at[k] =
          element::value_in_super_element(nodes_, u_.reshaped(3, nodes_.cols()).row(k).transpose(), pyramid_of(place));
    return at;
  }
  const Vector N = geometry::SimplexBasis::of(3, static_cast<int>(nodes_.cols())).values(place.lambda);
  return u_.reshaped(3, nodes_.cols()) * N;
}

element::Vec6 CellField::strain_at(const PlaceInCell& place) const {
  return interior_ ? interior_->strain_at(pyramid_of(place)) : element::strain_at(nodes_, u_, place.lambda);
}

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
  inside_ = analysis::inside_cells_of(model, increment, body);
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

element::SolidCellLoads SolidStress::loads_in(std::size_t cell, const Matrix& nodes) const {
  return element::loads_in_cell(nodes, *body_.solved[cell], body_.mesh.cells[cell], inside_);
}

CellField SolidStress::field_of(std::size_t cell) const {
  const Matrix nodes = mesh::nodes_of(body_.mesh, body_.mesh.cells[cell]);
  const Vector u = displacements_of(cell);
  std::optional<element::SolidInterior> interior;
  if (const element::SolidSuperElement* of = element::super_element_of(body_.solved, cell))
    interior.emplace(nodes, *of, u, loads_in(cell, nodes));
  return {nodes, u, std::move(interior)};
}

element::Vec6 SolidStress::at(std::size_t cell, const CellField& field, const PlaceInCell& place) const {
  element::Vec6 stress = D_ * field.strain_at(place);
  if (heated_.size() == 0) return stress;
  const std::vector<int>& nodes = body_.mesh.cells[cell];
  const Vector change = heated_(nodes);
  stress -= body_.expansion * temperature_at(mesh::nodes_of(body_.mesh, nodes), change, place) *
            D_.leftCols<3>().rowwise().sum();
  return stress;
}

Matrix SolidStress::at_nodes() const {
  const mesh::SolidMesh& mesh = body_.mesh;
  Matrix sum = Matrix::Zero(6, mesh.nodes.cols());
  if (is_rigid()) return sum;
  Vector count = Vector::Zero(mesh.nodes.cols());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::vector<int>& cell = mesh.cells[c];
    const Matrix nodes = mesh::nodes_of(mesh, cell);
    const Vector of_cell = displacements_of(c);
    const element::SolidSuperElement* of = element::super_element_of(body_.solved, c);
    const Matrix strains =
        of ? element::strains_at_nodes(nodes, *of, of_cell, loads_in(c, nodes)) : tetrahedron_strains(nodes, of_cell);
    for (std::size_t i = 0; i < cell.size(); ++i) {
      sum.col(cell[i]) += D_ * strains.col(static_cast<Eigen::Index>(i));
      count[cell[i]] += 1.0;
    }
  }
  for (Eigen::Index i = 0; i < sum.cols(); ++i)
    if (count[i] > 0.0) sum.col(i) /= count[i];
  if (heated_.size() > 0) sum -= body_.expansion * D_.leftCols<3>().rowwise().sum() * heated_.transpose();
  return sum;
}

}  // namespace scabo::result
