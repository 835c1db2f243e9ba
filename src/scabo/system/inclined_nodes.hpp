// Nodes that are held along inclined directions.
#pragma once

#include <vector>

#include "scabo/system/body_system.hpp"

namespace scabo::system {

/// Their displacements are u = M v, with v along the directions of the constraints, of which the second one, if it is
/// missing, is at right angles to the first. A force f has the components M'f, and K becomes T'K T, with M on the
/// diagonal of T at these nodes and 1 at all others. Exact: no spring, no multiplier. Vectors have two components for
/// each node of the body.
class InclinedNodes {
 public:
  InclinedNodes() = default;
  explicit InclinedNodes(const std::vector<Constraint>& constraints);

  bool none() const { return nodes_.empty(); }
  bool operator==(const InclinedNodes& other) const;
  /// M of a node, or nothing.
  const Mat2* of(int node) const;

  Vector displacements(Vector v) const;    ///< u from v
  Vector along(Vector u) const;            ///< v from u
  Vector components(Vector f) const;       ///< of forces along x and y
  Vector forces(Vector components) const;  ///< along x and y

  /// T'K T.
  Matrix stiffness(Matrix K) const;
  Eigen::SparseMatrix<double> stiffness(const Eigen::SparseMatrix<double>& K) const;

 private:
  struct Inclined {
    int node;
    Mat2 rows, M;  // of directions, and its inverse
  };
  std::vector<Inclined> nodes_;  // ascending
};

}  // namespace scabo::system
