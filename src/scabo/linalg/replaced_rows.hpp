// Systems with a matrix A of which rows are replaced one after the other, as in methods that follow changes of states.
// One matrix B is factorised; with the rows R that differ from it and by how much, D,
//
//     A = B + E D',   E the unit vectors of R,   A^-1 b = y - Y w,   y = B^-1 b,   Y = B^-1 E,   (1 + D'Y) w = D'y
//
// (Sherman, Morrison, Woodbury). A row takes one solve with the factors when it is first replaced; of rows that are
// replaced together the solves are made together, which takes a quarter of the time. Where there may be many rows the
// inverse of 1 + D'Y follows from the one before. It is not relied on: w is refined with 1 + D'Y itself, and where that
// does not converge, as close to a singular A, 1 + D'Y is factorised.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <utility>
#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/linalg/substituted_rows.hpp"

namespace scabo::linalg {

class ReplacedRows {
 public:
  /// Entries of a row.
  using Row = std::vector<std::pair<int, double>>;
  struct Replaced {
    int row = 0;
    Row difference;  ///< to the row of B
  };

  /// B, n x n, of which up to `most` rows will be replaced; all rows are its own again. False where it is singular to
  /// working precision. `may_be_substituted`, `blocks`: as of SubstitutedRows.
  [[nodiscard]] bool factorise(Eigen::SparseMatrix<double> B, Eigen::Index may_be_substituted, Eigen::Index most,
                               const std::function<OrderedBlocks(const std::vector<int>& kept)>& blocks);

  /// These rows of A, each once, are those of B and the differences.
  void replace(std::vector<Replaced> changes);
  void replace(int row, Row difference) { replace({{row, std::move(difference)}}); }

  /// Rows that were replaced since the factorisation.
  const std::vector<int>& rows() const { return rows_; }

  /// Of det A / det B.
  int sign() const;

  /// With the factors of B alone.
  double operations_of_solve() const { return 2.0 * lu_.entries(); }

  /// x = A^-1 b, refined once. False where A is singular to working precision.
  [[nodiscard]] bool solve(const Vector& b, Vector& x) const;

  /// The same, not refined.
  void solve_once(const Vector& b, Vector& x) const;

  /// The same, in haste: not exact where 1 + D'Y should be factorised. Half as long for a b that is zero but in rows().
  void solve_roughly(const Vector& b, Vector& x) const;

  /// B^-1 b, refined once.
  Vector solve_before(const Vector& b) const;

  /// x = A^-1 (b + E c), y = B^-1 b being known; c in the order of rows(). Not refined; a nearly singular A gives an x
  /// along the motion that nothing holds.
  void solve_from(const Vector& y, const Vector& c, Vector& x) const;

 private:
  double times_difference(std::size_t at, const Vector& x) const;
  /// Makes room for rows that were not replaced before, their differences still zero.
  void add_rows(const std::vector<Replaced>& changes);
  /// (1 + D'Y)^-1 right.
  Vector small_solution(const Vector& right) const;
  /// The same by a factorisation, of which the inverse is kept where there is one.
  Vector factorised_solution(const Vector& right) const;
  /// By the inverse that is kept; whether that is `exact`.
  Vector solution_by_inverse(const Vector& right, bool& exact) const;
  bool keeps_inverse() const;
  bool is_of_replaced_rows(const Vector& b) const;
  /// y - Y w.
  void subtract(const Vector& w, Vector& y) const;
  Eigen::Index count() const { return static_cast<Eigen::Index>(rows_.size()); }

  Eigen::SparseMatrix<double> B_;
  void solve_with_factors(const Vector& b, Vector& x) const;

  SubstitutedRows lu_;
  std::vector<int> rows_, place_;  // place: of each row of B in rows_, or -1
  std::vector<Row> differences_;
  using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  ByRows solved_;  // Y
  ByRows small_;   // 1 + D'Y; as Y with room for more rows
  mutable Matrix inverse_;
  mutable int sign_ = 1;  ///< where the inverse is kept
};

}  // namespace scabo::linalg
