// The factor of a matrix by that of another one, most of whose rows and columns are the same to the last bit.
//
// The unknowns of both are far ones, f, whose columns are the same, and near ones, n, of which only some, b, have
// entries in columns of far ones; near ones of the first matrix, o, may be others:
//
//     A = [ F  B' ]      A_0 = [ F  B'  ]
//         [ B  N  ]            [ B  N_0 ]
//
// With C = B F^-1 B', which has entries on b only, A x = r is
//
//     (N - C) x_n = r_n - B F^-1 r_f,      F x_f = r_f - B'x_n                                                      (1)
//
// C and solutions with F follow from A_0 and its factor. On b, (A_0^-1)_bb = G and (N_0^-1)_bb = H give
//
//     C = H^-1 - G^-1                                                                                               (2)
//
// and with y = A_0^-1 [r_f, 0] and z = x_n - y_b
//
//     (N - C) z = r_n + N_0 y_o - N y_b,      x_f = (A_0^-1 [r_f, q])_f,      q = G^-1 z_b                          (3)
//
// A solution takes as long as one with the factor of A_0, and N - C is small. Rounding of C and G^-1 counts by z alone.
#pragma once

#include <memory>
#include <vector>

#include "scabo/linalg/sparse_factor.hpp"

namespace scabo::linalg {

/// Some rows and columns of a symmetric matrix.
struct PrincipalPart {
  const SparseMatrix& matrix;
  const std::vector<int>& unknowns;  ///< ascending
  const std::vector<int>& place;     ///< of every row of `matrix` among them, or -1

  Eigen::Index size() const { return static_cast<Eigen::Index>(unknowns.size()); }
};

/// A matrix and its factor.
struct Factorised {
  PrincipalPart A;
  std::shared_ptr<const SymmetricPositiveSolver> factor;
};

/// `same`: of every unknown of A that of A_0 which may be the same one, distinct, or -1. `near`: unknowns of A whose
/// inverse_block() will be asked for. Null where too much is different for this to pay, or where N - C has lost its
/// digits.
std::unique_ptr<SparseFactor> factor_by_changes(const PrincipalPart& A, const Factorised& before,
                                                const std::vector<int>& same, const std::vector<int>& near);

}  // namespace scabo::linalg
