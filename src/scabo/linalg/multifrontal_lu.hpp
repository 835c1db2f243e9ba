// LU factorisation of a sparse square matrix whose unknowns come in blocks with the same neighbours: walls of bodies,
// where all forces of a joint are such a block.
//
// The multifrontal method (Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302) on blocks. A front gathers what the
// matrix and the fronts below say of its pivots, 1, and of the unknowns that they still have as neighbours, 2,
//
//     [ F11 F12 ]        P F11 = L11 U11     U12 = L11^-1 P F12     L21 = F21 U11^-1
//     [ F21 F22 ]        F22 - L21 U12 goes to the front of the next of these neighbours
//
// and everything is a product or a triangular solve of dense matrices. Rows are exchanged within F11 alone, so that the
// fronts are the same for all matrices of one pattern: they are found once. That is as stable as each F11 is regular;
// `factorise` solves a system with a known solution to see. Blocks are merged where larger products are worth more than
// the zeros that they gain.
//
// Of a saddle matrix [A11 A12; A21 A22] with a small A22 the pivots of A11 alone may be tiny although the matrix is
// regular: forces that only move a body as a whole. Rows of A21 are therefore added to those above,
//
//     [A11 + A12 c A21, A12 + A12 c A22; A21 A22] x = [b1 + A12 c b2; b2],   c diagonal
//
// whose solution is the same, with c as large as makes what is added as large as A11.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

/// A pattern by blocks, in the order of their elimination.
struct OrderedBlocks {
  std::vector<std::vector<int>> members;  ///< unknowns of each block; every unknown is in one
  std::vector<std::vector<int>> later;    ///< neighbours of each block that follow it, ascending
  std::vector<int>
      bare;  ///< unknowns of A22, each in a block after all its neighbours, which are neighbours of each other
};

class MultifrontalLU {
 public:
  explicit MultifrontalLU(OrderedBlocks blocks);

  /// Of `A`, n x n and compressed, with no entries but between neighbours. False where a pivot is zero, or where the
  /// solution of a system comes out with an error of its right-hand side above 1e-6.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& A);
  /// Smallest over largest pivot, of rows whose entries add up to 1.
  double reciprocal_condition() const { return reciprocal_condition_; }
  /// X = A^-1 B, n rows.
  void solve(const Matrix& B, Matrix& X) const;

  double operations() const { return operations_; }  ///< of a factorisation
  double entries() const { return entries_; }        ///< of L and U

 private:
  struct Front {
    std::vector<int> unknowns;  // pivots first, then the neighbours left, each in the order of elimination
    int pivots = 0;
    std::vector<int> children;   // fronts whose rest is added to this one
    Matrix F11, U12, L21, rest;  // factors and, until it is added, F22 - L21 U12
    std::vector<int> exchanged;  // rows of F11, as LAPACK states them
    int border() const { return static_cast<int>(unknowns.size()) - pivots; }
  };
  void add_rows_of_bare(const Eigen::SparseMatrix<double>& A,
                        const Eigen::SparseMatrix<double, Eigen::RowMajor>& by_rows);
  void gather(Front& front, const Eigen::SparseMatrix<double>& A,
              const Eigen::SparseMatrix<double, Eigen::RowMajor>& by_rows);
  void add_rest(Front& front, Front& child);
  bool eliminate(Front& front);

  int n_ = 0;
  std::vector<Front> fronts_;  // each after its children
  std::vector<int> place_;     // of each unknown in the front at hand
  std::vector<char> done_;     // unknowns whose front has been left
  std::vector<int> bare_;
  std::vector<char> is_bare_;
  std::vector<double> factor_of_;      // c, of unknowns of A22
  Eigen::SparseMatrix<double> added_;  // n x n, A12 c in the columns of A22
  Vector row_scale_;
  double reciprocal_condition_ = 0.0, operations_ = 0.0, entries_ = 0.0;
};

}  // namespace scabo::linalg
