// Factorisation of a dense square matrix without symmetry: P A = L U by LAPACK. Memory is reused from one matrix to the
// next.
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

class GeneralSolver {
 public:
  /// Factorises the leading n x n block of `A`, which is overwritten. False if a pivot is exactly zero.
  [[nodiscard]] bool factorise(Matrix& A, Eigen::Index n);
  /// Estimate of 1 / (|A| |A^-1|) in the 1-norm (Higham, ACM Trans. Math. Softw. 14 (1988) 381), not finite where A^-1
  /// overflows. LAPACK's own driver guards every solve against that, and takes twice as long.
  double reciprocal_condition() const;
  /// x <- A^-1 x for the first n entries of `x`.
  void solve_in_place(Vector& x) const;

 private:
  const Matrix* factor_ = nullptr;
  Eigen::Index n_ = 0;
  double norm_ = 0.0;
  std::vector<int> pivots_;
  mutable std::vector<double> work_;
  mutable std::vector<int> whole_work_;
};

}  // namespace scabo::linalg
