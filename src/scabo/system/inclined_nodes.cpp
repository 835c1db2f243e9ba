#include "scabo/system/inclined_nodes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>

#include "scabo/base/components.hpp"

namespace scabo::system {

namespace {

/// The values of every node of `nodes` times its matrix.
template <typename Nodes, typename MatrixOf>
Vector multiplied(const Nodes& nodes, Vector values, const MatrixOf& matrix_of) {
  for (const auto& at : nodes)
    values.segment<2>(place_of(at.node)) = (matrix_of(at) * values.segment<2>(place_of(at.node))).eval();
  return values;
}

}  // namespace

InclinedNodes::InclinedNodes(const std::vector<Constraint>& constraints) {
  const auto is_inclined = [](const Constraint& constraint) { return constraint.component < 0; };
  if (std::none_of(constraints.begin(), constraints.end(), is_inclined)) return;
  std::map<int, std::array<const Constraint*, 2>> held;
  for (const Constraint& constraint : constraints)
    held[plane_components.node_of(constraint.dof)]
        [static_cast<std::size_t>(plane_components.component_of(constraint.dof))] = &constraint;
  for (const auto& [node, at] : held) {
    if (!((at[0] && at[0]->component < 0) || (at[1] && at[1]->component < 0))) continue;
    Mat2 rows;
    for (int k = 0; k < 2; ++k)
      if (const Constraint* constraint = at[static_cast<std::size_t>(k)]) rows.row(k) = constraint->direction();
    if (!at[1]) rows.row(1) << -rows(0, 1), rows(0, 0);
    if (!at[0]) rows.row(0) << rows(1, 1), -rows(1, 0);
    nodes_.push_back({node, rows, Mat2(rows.inverse())});
  }
}

bool InclinedNodes::operator==(const InclinedNodes& other) const {
  return std::equal(nodes_.begin(), nodes_.end(), other.nodes_.begin(), other.nodes_.end(),
                    [](const Inclined& a, const Inclined& b) { return a.node == b.node && a.rows == b.rows; });
}

const Mat2* InclinedNodes::of(int node) const {
  const auto at = std::lower_bound(nodes_.begin(), nodes_.end(), node,
                                   [](const Inclined& inclined, int wanted) { return inclined.node < wanted; });
  return at != nodes_.end() && at->node == node ? &at->M : nullptr;
}

Vector InclinedNodes::displacements(Vector v) const {
  return multiplied(nodes_, std::move(v), [](const Inclined& at) { return at.M; });
}

Vector InclinedNodes::along(Vector u) const {
  return multiplied(nodes_, std::move(u), [](const Inclined& at) { return at.rows; });
}

Vector InclinedNodes::components(Vector f) const {
  return multiplied(nodes_, std::move(f), [](const Inclined& at) { return Mat2(at.M.transpose()); });
}

Vector InclinedNodes::forces(Vector components) const {
  return multiplied(nodes_, std::move(components), [](const Inclined& at) { return Mat2(at.rows.transpose()); });
}

Matrix InclinedNodes::stiffness(Matrix K) const {
  for (const Inclined& at : nodes_)
    K.middleCols<2>(place_of(at.node)) = (K.middleCols<2>(place_of(at.node)) * at.M).eval();
  for (const Inclined& at : nodes_)
    K.middleRows<2>(place_of(at.node)) = (at.M.transpose() * K.middleRows<2>(place_of(at.node))).eval();
  return K;
}

Eigen::SparseMatrix<double> InclinedNodes::stiffness(const Eigen::SparseMatrix<double>& K) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (int node = 0; node < plane_components.node_of(K.rows()); ++node) {
    const Mat2* M = of(node);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        if (M || i == j) entries.emplace_back(place_of(node, i), place_of(node, j), M ? (*M)(i, j) : 1.0);
  }
  Eigen::SparseMatrix<double> T(K.rows(), K.cols());
  T.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> KT = K * T, transposed = T.transpose();
  return transposed * KT;
}

}  // namespace scabo::system
