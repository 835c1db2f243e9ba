// A factorisation of a sparse symmetric positive definite matrix by one of the libraries that are built in.
#pragma once

#include <memory>
#include <vector>

#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::linalg {

class SparseFactor {
 public:
  virtual ~SparseFactor() = default;
  /// A^-1 B, B n x m.
  virtual Matrix solve(const Matrix& B) const = 0;
  /// What solve_at() and solve_from() need of b, n.
  virtual Vector begin(const Vector& b) const { return b; }
  /// Some entries of A^-1 b: those at `wanted`, in this order.
  virtual Vector solve_at(const Vector& begun, const std::vector<int>& wanted) const { return solve(begun)(wanted, 0); }
  /// A^-1 (b + more).
  virtual Vector solve_from(const Vector& begun, const Vector& more) const { return solve(begun + more); }
  /// E' A^-1 E, symmetric, where the columns of E are those columns of the identity given by `indices`.
  virtual Matrix inverse_block(const std::vector<int>& indices) const = 0;
};

/// CHOLMOD's supernodal factor. Throws NotPositiveDefinite. Adds to `costs`.
std::unique_ptr<SparseFactor> factorise_by_cholmod(const SparseMatrix& A, const SparseOptions& options,
                                                   FactorisationCosts& costs);
/// MUMPS, if it is built in; the same.
std::unique_ptr<SparseFactor> factorise_by_mumps(const SparseMatrix& A, const SparseOptions& options,
                                                 FactorisationCosts& costs);

}  // namespace scabo::linalg
