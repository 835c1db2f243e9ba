// Factorisation of a symmetric positive definite matrix, dense or sparse, whichever costs less.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <stdexcept>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

using SparseMatrix = Eigen::SparseMatrix<double>;  // compressed columns

enum class SparseLibrary { cholmod, mumps };
/// Whether this program can use the library.
bool is_built_in(SparseLibrary library);

enum class Ordering { automatic, minimum_degree, nested_dissection, dissection_by_position };

struct SparseOptions {
  SparseLibrary library = SparseLibrary::cholmod;
  Ordering ordering = Ordering::automatic;  ///< elimination_order.hpp
  std::vector<Vec2> positions = {};         ///< of every unknown, or empty: its node, for the order of elimination
};

/// Seconds and size of a sparse factorisation; all zero for a dense one.
struct FactorisationCosts {
  double order = 0.0, analyse = 0.0, factorise = 0.0;  ///< s: elimination order, structure of L, its entries
  double entries = 0.0, operations = 0.0;              ///< nonzero entries of L, floating point operations
};

class SparseFactor;  // sparse_factor.hpp

/// A = L L'. Dense Cholesky factorisation (LAPACK) if a quarter of the entries or more is nonzero, a sparse one
/// (CHOLMOD, supernodal, or MUMPS) otherwise: the stiffness of one super-element is full, that of a finite element mesh
/// is sparse.
class SymmetricPositiveSolver {
 public:
  /// A solver for zero unknowns.
  SymmetricPositiveSolver();
  /// `A`: n x n, both triangles stored. Throws NotPositiveDefinite.
  explicit SymmetricPositiveSolver(const SparseMatrix& A, const SparseOptions& options = {});
  explicit SymmetricPositiveSolver(Matrix A);
  /// By a factor of an n x n matrix that was computed elsewhere.
  SymmetricPositiveSolver(int n, std::unique_ptr<SparseFactor> factor, const FactorisationCosts& costs);
  SymmetricPositiveSolver(SymmetricPositiveSolver&&) noexcept;
  SymmetricPositiveSolver& operator=(SymmetricPositiveSolver&&) noexcept;
  ~SymmetricPositiveSolver();

  /// A^-1 B, B n x m.
  Matrix solve(const Matrix& B) const;
  /// What solve_at() and solve_from() need of b: with CHOLMOD's factor half of a solve, less where few entries of b are
  /// not zero.
  Vector begin(const Vector& b) const;
  /// Some entries of A^-1 b: those at `wanted`, in this order. Where they are few, CHOLMOD's factor needs little time.
  Vector solve_at(const Vector& begun, const std::vector<int>& wanted) const;
  /// A^-1 (b + more): with CHOLMOD's factor half of a solve where few entries of `more` are not zero.
  Vector solve_from(const Vector& begun, const Vector& more) const;

  /// E' A^-1 E, symmetric, where the columns of E are those columns of the identity given by `indices`.
  Matrix inverse_block(const std::vector<int>& indices) const;

  const FactorisationCosts& costs() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

/// The matrix given to SymmetricPositiveSolver is not positive definite (to working precision).
struct NotPositiveDefinite : std::runtime_error {
  NotPositiveDefinite() : std::runtime_error("the matrix is not positive definite") {}
};

}  // namespace scabo::linalg
