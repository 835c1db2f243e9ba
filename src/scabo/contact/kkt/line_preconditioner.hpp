// A preconditioner for the matrix of a Newton direction (newton_direction.hpp) of a dense W whose pairs follow each
// other along joints:
//
//     [ A  M ]     A = L'W C + D
//     [ F  0 ]     M = L'G,  F = G'C
//
// A by halves of low coupling (linalg/hierarchical_solver.hpp), the rigid motions from F A^-1 M.
#pragma once

#include <Eigen/LU>

#include "scabo/contact/kkt/saddle_matrix.hpp"
#include "scabo/linalg/hierarchical_solver.hpp"

namespace scabo::contact {

class LinePreconditioner {
 public:
  /// Keeps nothing of its arguments. W must be dense. False where this does not pay or the matrix is singular.
  bool factorise(const Problem& problem, const SaddleRows& rows);
  void solve(const Vector& x, Vector& result) const;

 private:
  linalg::HierarchicalSolver A_;
  Matrix solved_;  // A^-1 M
  Matrix F_;
  Eigen::PartialPivLU<Matrix> balance_;  // F A^-1 M
  mutable Vector part_, y_, da_;
};

}  // namespace scabo::contact
