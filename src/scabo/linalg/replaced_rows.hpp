// Systems with a matrix A of which rows are replaced one after the other, as in methods that follow changes of states.
// One matrix B is factorised; with the rows R that differ from it and by how much, D,
//
//     A = B + E D',   E the unit vectors of R,   A^-1 b = y - Y w,   y = B^-1 b,   Y = B^-1 E,   (1 + D'Y) w = D'y
//
// (Sherman, Morrison, Woodbury). A row takes one solve with the factors when it is first replaced. Where there may be
// many rows the inverse of 1 + D'Y follows from the one before. It is not relied on: w is refined with 1 + D'Y itself,
// and where that does not converge, as close to a singular A, 1 + D'Y is factorised.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <utility>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::linalg {

class ReplacedRows {
 public:
  /// Entries of a row.
  using Row = std::vector<std::pair<int, double>>;

  /// B, n x n, of which up to `most` rows will be replaced; all rows are its own again. False where it is singular to
  /// working precision. `blocks`: as of SparseGeneralSolver, may be empty.
  [[nodiscard]] bool factorise(Eigen::SparseMatrix<double> B, Eigen::Index most,
                               const std::function<OrderedBlocks()>& blocks);

  /// Row `row` of A is that of B plus `difference`.
  void replace(int row, Row difference);

  /// Rows that were replaced since the factorisation.
  const std::vector<int>& rows() const { return rows_; }

  /// With the factors of B alone.
  double operations_of_solve() const { return 2.0 * lu_.entries(); }

  /// x = A^-1 b, refined once. False where A is singular to working precision.
  [[nodiscard]] bool solve(const Vector& b, Vector& x) const;

  /// B^-1 b, refined once.
  Vector solve_before(const Vector& b) const;

  /// x = A^-1 (b + E c), y = B^-1 b being known; c in the order of rows(). Not refined; a nearly singular A gives an x
  /// along the motion that nothing holds.
  void solve_from(const Vector& y, const Vector& c, Vector& x) const;

 private:
  double times_difference(std::size_t at, const Eigen::Ref<const Vector>& x) const;
  /// (1 + D'Y)^-1 right.
  Vector small_solution(const Vector& right) const;
  /// The same by a factorisation, of which the inverse is kept where there is one.
  Vector factorised_solution(const Vector& right) const;
  bool keeps_inverse() const;
  /// y - Y w.
  void subtract(const Vector& w, Vector& y) const;
  Eigen::Index count() const { return static_cast<Eigen::Index>(rows_.size()); }

  Eigen::SparseMatrix<double> B_;
  SparseGeneralSolver lu_;
  std::vector<int> rows_, place_;  // place: of each row of B in rows_, or -1
  std::vector<Row> differences_;
  Matrix solved_, small_;  // Y; 1 + D'Y; both with room for more rows
  mutable Matrix inverse_;
};

}  // namespace scabo::linalg
