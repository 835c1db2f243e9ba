// Factorisation of a sparse square matrix whose pattern, but not its entries, is symmetric: P R A Q = L U by UMFPACK
// (Davis, ACM Trans. Math. Softw. 30 (2004) 196), ordered by AMD. Of a saddle matrix [W G; G' 0] the unknowns without a
// diagonal entry stand right behind neighbours that fill it, and pivots stay on the diagonal. UMFPACK by itself takes
// such a matrix for an unsymmetric one and orders A'A, which takes three times the operations (walls of 40 x 40
// blocks: 4.1e9 and 1.2e10). Large saddle matrices are factorised by fronts of blocks (multifrontal_lu.hpp) wherever
// that is accurate; where it is not, UMFPACK follows, but for the largest.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <memory>

#include "scabo/base/types.hpp"
#include "scabo/linalg/multifrontal_lu.hpp"

namespace scabo::linalg {

class SparseGeneralSolver {
 public:
  SparseGeneralSolver();
  ~SparseGeneralSolver();
  SparseGeneralSolver(SparseGeneralSolver&&) noexcept;
  SparseGeneralSolver& operator=(SparseGeneralSolver&&) noexcept;

  /// Of `A`, n x n and compressed, which must outlive the solves. False where a pivot is zero. The ordering is kept for
  /// the next matrix with the same pattern: about half of the time.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& A) { return factorise(A, {}); }
  /// The same where the caller knows `blocks` and their order, which is asked for when the pattern is new: of large
  /// matrices it is found for all patterns at once.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& A, const std::function<OrderedBlocks()>& blocks);
  /// Smallest over largest pivot: a coarse estimate of 1 / (|A| |A^-1|).
  double reciprocal_condition() const { return reciprocal_condition_; }
  /// Entries of the factors: a solve takes two operations for each.
  double entries() const;
  /// X = A^-1 B, of one right-hand side or several.
  void solve(const Vector& b, Vector& x) const;
  void solve(const Matrix& B, Matrix& X) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  double reciprocal_condition_ = 0.0;
};

}  // namespace scabo::linalg
