// Systems A x = b of which many rows give one unknown alone, or by one other: d x_i = b_i, d x_i + c x_j = b_i, as
// those of pairs that are open or slip give their forces. They are substituted in the other rows,
//
//     [A_kk A_ks] [x_k]   [b_k]         x_s = g + T x_k,   g and T from the rows that are substituted
//     [A_sk A_ss] [x_s] = [b_s]         (A_kk + A_ks T) x_k = b_k - A_ks g
//
// and what is left is factorised.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::linalg {

class SubstitutedRows {
 public:
  /// A, n x n, of which rows before `may_be_substituted` are where they can be. `blocks` as of SparseGeneralSolver, for
  /// the unknowns kept, ascending; may be empty. False where A is singular to working precision.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& A, Eigen::Index may_be_substituted,
                               const std::function<OrderedBlocks(const std::vector<int>& kept)>& blocks);

  /// X = A^-1 B, of one right-hand side or several.
  void solve(const Matrix& B, Matrix& X) const;

  /// Unknowns that are not substituted.
  const std::vector<int>& kept() const { return kept_; }
  /// Entries of the factors: a solve takes two operations for each.
  double entries() const { return lu_.entries(); }

 private:
  /// x_unknown = (b_unknown - factor x_other) / diagonal; `other` -1: none.
  struct Substitution {
    int unknown = 0, other = -1;
    double diagonal = 1.0, factor = 0.0;
    bool other_kept = false;
  };
  void find_substitutions(const Eigen::SparseMatrix<double>& A, Eigen::Index rows);

  Eigen::Index n_ = 0;
  std::vector<int> kept_;
  std::vector<Substitution> substituted_;                     // one that follows another substituted one comes after it
  Eigen::SparseMatrix<double> kept_matrix_, of_substituted_;  // A_kk + A_ks T; A_ks, in the order of substituted_
  SparseGeneralSolver lu_;
};

}  // namespace scabo::linalg
