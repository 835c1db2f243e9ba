// Approximate factorisation of a dense square matrix whose unknowns lie along a line: a preconditioner.
//
// The unknowns are halved again and again (Ambikasaran and Darve, J. Sci. Comput. 57 (2013) 477). The blocks that
// couple two halves have low rank, because what one half does to the other varies smoothly away from their common end:
//
//     A = [ A1       U1 V1' ]     x = y - [ Z1 w1 ]     [ 1       V1'Z2 ] [ w1 ]   [ V1'y2 ]
//         [ U2 V2'   A2     ]             [ Z2 w2 ]     [ V2'Z1   1     ] [ w2 ] = [ V2'y1 ] (1)
//
// with y_i = A_i^-1 b_i, Z_i = A_i^-1 U_i. A1 and A2 are of the same kind; the smallest blocks are factorised by LU.
// n unknowns and rank k take about n k^2 log^2 n operations instead of 2/3 n^3, and each entry of A is read once.
//
// U is an orthonormal basis of the products of a block with random vectors, always the same ones, V' = U' (block)
// (Halko, Martinsson, Tropp, SIAM Review 53 (2011) 217); products with eight further vectors tell whether there were
// enough of them.
#pragma once

#include <functional>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::linalg {

class HierarchicalSolver {
 public:
  /// Sets a block of A whose first entry is A(row, column).
  using Fill = std::function<void(Eigen::Index row, Eigen::Index column, Matrix& block)>;

  /// `tolerance`: error of the blocks between two halves, relative to each. False where a rank is too large for this to
  /// pay (unknowns that are not ordered along a line), a number is not finite, or a matrix of (1) is singular.
  [[nodiscard]] bool factorise(Eigen::Index size, const Fill& fill, double tolerance = 1e-10);
  /// result ~ A^-1 x.
  void solve(const Vector& x, Vector& result) const;
  Eigen::Index size() const { return size_; }
  Eigen::Index largest_rank() const { return largest_rank_; }

 private:
  struct Node {
    Eigen::Index first = 0, size = 0;
    int halves[2] = {-1, -1};  // none: the smallest
    Matrix lu;                 // of a smallest one, or of the matrix of (1)
    std::vector<int> pivots;
    Matrix V[2], Z[2];  // V1': k1 x size of the second half, Z1: size of the first half x k1
  };
  int divide(Eigen::Index first, Eigen::Index size);
  bool factorise(int node, const Fill& fill, double tolerance);
  void solve(int node, double* x, Eigen::Index columns, Eigen::Index stride) const;

  Eigen::Index size_ = 0, largest_rank_ = 0;
  std::vector<Node> nodes_;
};

}  // namespace scabo::linalg
