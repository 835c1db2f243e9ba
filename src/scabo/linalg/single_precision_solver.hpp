// Factorisation of a dense square matrix without symmetry in single precision: P A = L U by LAPACK. Half the time of
// one in double precision; a preconditioner for iterations in double precision.
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

class SinglePrecisionSolver {
 public:
  /// `A`, n x n, is overwritten and must exist as long as this. False if a pivot is exactly zero or not finite.
  [[nodiscard]] bool factorise(Eigen::MatrixXf& A);
  /// result ~ A^-1 x, to about the condition of A times 6e-8. Vectors of any size above 1e-38 of their largest entry.
  void solve(const Vector& x, Vector& result) const;

 private:
  const Eigen::MatrixXf* factor_ = nullptr;
  std::vector<int> pivots_;
  mutable Eigen::VectorXf rounded_;
};

}  // namespace scabo::linalg
