// Nodes that are held along inclined directions.
#pragma once

#include <vector>

#include "scabo/base/components.hpp"
#include "scabo/system/body_system.hpp"

namespace scabo::system {

/// Their displacements are u = M v, with v along the directions of the constraints, and, where these are fewer than the
/// components of a node, along others at right angles to all of them. A force f has the components M'f, and K becomes
/// T'K T, with M on the diagonal of T at these nodes and 1 at all others. Exact: no spring, no multiplier. Vectors have
/// all components of each node of the body.
class InclinedNodes {
 public:
  using NodeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;

  InclinedNodes() = default;
  InclinedNodes(const std::vector<Constraint>& constraints, Components components);

  bool none() const { return nodes_.empty(); }
  bool operator==(const InclinedNodes& other) const;
  /// M of a node, or nothing.
  const NodeMatrix* of(int node) const;

  Vector displacements(Vector v) const;    ///< u from v
  Vector along(Vector u) const;            ///< v from u
  Vector components(Vector f) const;       ///< of forces along the axes
  Vector forces(Vector components) const;  ///< along the axes

  /// T'K T.
  Matrix stiffness(Matrix K) const;
  Eigen::SparseMatrix<double> stiffness(const Eigen::SparseMatrix<double>& K) const;

 private:
  struct Inclined {
    int node;
    NodeMatrix rows, M;  // of directions, and its inverse
  };
  template <typename MatrixOf>
  Vector multiplied(Vector values, const MatrixOf& matrix_of) const;

  Components of_nodes_;
  std::vector<Inclined> nodes_;  // ascending
};

}  // namespace scabo::system
