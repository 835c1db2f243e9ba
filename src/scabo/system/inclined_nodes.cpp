#include "scabo/system/inclined_nodes.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>

namespace scabo::system {

namespace {

using NodeMatrix = InclinedNodes::NodeMatrix;
/// Of a node, by their places there; null: none.
using HeldThere = std::array<const Constraint*, 3>;

NodeMatrix rows_in_plane(const HeldThere& held) {
  Mat2 rows;
  for (int k = 0; k < 2; ++k)
    if (const Constraint* constraint = held[static_cast<std::size_t>(k)]) rows.row(k) = constraint->direction();
  if (!held[1]) rows.row(1) << -rows(0, 1), rows(0, 0);
  if (!held[0]) rows.row(0) << rows(1, 1), -rows(1, 0);
  return rows;
}

NodeMatrix rows_in_space(const HeldThere& held) {
  Eigen::Matrix3d rows;
  std::array<int, 3> places{};  // of those that are held, then the others
  int count = 0;
  for (const bool is_held : {true, false})
    for (int k = 0; k < 3; ++k)
      if (const Constraint* constraint = held[static_cast<std::size_t>(k)]; (constraint != nullptr) == is_held) {
        places[static_cast<std::size_t>(count++)] = k;
        if (is_held) rows.row(k) = constraint->direction_in_space();
      }
  const auto row = [&](std::size_t i) { return rows.row(places[i]); };
  const auto missing = static_cast<int>(std::count(held.begin(), held.end(), nullptr));
  if (missing == 2) row(1) = Eigen::Vector3d(row(0)).unitOrthogonal();
  if (missing > 0) row(2) = Eigen::Vector3d(row(0)).cross(Eigen::Vector3d(row(1))).normalized();
  return rows;
}

}  // namespace

/// The values of every inclined node times its matrix.
template <typename MatrixOf>
Vector InclinedNodes::multiplied(Vector values, const MatrixOf& matrix_of) const {
  const Eigen::Index n = of_nodes_.dimension;
  for (const Inclined& at : nodes_) {
    auto here = values.segment(of_nodes_.of(at.node), n);
    here = (matrix_of(at) * here).eval();
  }
  return values;
}

InclinedNodes::InclinedNodes(const std::vector<Constraint>& constraints, Components components)
    : of_nodes_(components) {
  const auto is_inclined = [](const Constraint* constraint) { return constraint && constraint->component < 0; };
  if (std::none_of(constraints.begin(), constraints.end(), [](const Constraint& of) { return of.component < 0; }))
    return;
  std::map<int, HeldThere> held;
  for (const Constraint& constraint : constraints)
    held[of_nodes_.node_of(constraint.dof)][static_cast<std::size_t>(of_nodes_.component_of(constraint.dof))] =
        &constraint;
  for (const auto& [node, at] : held) {
    if (std::none_of(at.begin(), at.end(), is_inclined)) continue;
    const NodeMatrix rows = of_nodes_.dimension == 2 ? rows_in_plane(at) : rows_in_space(at);
    nodes_.push_back({node, rows, rows.inverse()});
  }
}

bool InclinedNodes::operator==(const InclinedNodes& other) const {
  return std::equal(nodes_.begin(), nodes_.end(), other.nodes_.begin(), other.nodes_.end(),
                    [](const Inclined& a, const Inclined& b) { return a.node == b.node && a.rows == b.rows; });
}

const InclinedNodes::NodeMatrix* InclinedNodes::of(int node) const {
  const auto at = std::lower_bound(nodes_.begin(), nodes_.end(), node,
                                   [](const Inclined& inclined, int wanted) { return inclined.node < wanted; });
  return at != nodes_.end() && at->node == node ? &at->M : nullptr;
}

Vector InclinedNodes::displacements(Vector v) const {
  return multiplied(std::move(v), [](const Inclined& at) { return at.M; });
}

Vector InclinedNodes::along(Vector u) const {
  return multiplied(std::move(u), [](const Inclined& at) { return at.rows; });
}

Vector InclinedNodes::components(Vector f) const {
  return multiplied(std::move(f), [](const Inclined& at) { return NodeMatrix(at.M.transpose()); });
}

Vector InclinedNodes::forces(Vector components) const {
  return multiplied(std::move(components), [](const Inclined& at) { return NodeMatrix(at.rows.transpose()); });
}

Matrix InclinedNodes::stiffness(Matrix K) const {
  const Eigen::Index n = of_nodes_.dimension;
  for (const Inclined& at : nodes_) {
    auto columns = K.middleCols(of_nodes_.of(at.node), n);
    columns = (columns * at.M).eval();
  }
  for (const Inclined& at : nodes_) {
    auto rows = K.middleRows(of_nodes_.of(at.node), n);
    rows = (at.M.transpose() * rows).eval();
  }
  return K;
}

Eigen::SparseMatrix<double> InclinedNodes::stiffness(const Eigen::SparseMatrix<double>& K) const {
  std::vector<Eigen::Triplet<double>> entries;
  const int n = of_nodes_.dimension;
  for (int node = 0; node < of_nodes_.node_of(K.rows()); ++node) {
    const NodeMatrix* M = of(node);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (M || i == j) entries.emplace_back(of_nodes_.of(node, i), of_nodes_.of(node, j), M ? (*M)(i, j) : 1.0);
  }
  Eigen::SparseMatrix<double> T(K.rows(), K.cols());
  T.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> KT = K * T, transposed = T.transpose();
  return transposed * KT;
}

}  // namespace scabo::system
