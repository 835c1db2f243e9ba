#include "scabo/linalg/substituted_rows.hpp"

#include "scabo/base/error.hpp"

namespace scabo::linalg {

namespace {

using Index = Eigen::Index;

}  // namespace

/// Rows of one entry first: rows of two may follow them.
void SubstitutedRows::find_substitutions(const Eigen::SparseMatrix<double>& A, Index most) {
  struct Few {
    int entries = 0, other = -1;
    double diagonal = 0.0, factor = 0.0;
  };
  std::vector<Few> rows(static_cast<std::size_t>(n_));
  const auto candidates = static_cast<std::size_t>(most);
  for (Index column = 0; column < n_; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, column); it; ++it) {
      Few& row = rows[static_cast<std::size_t>(it.row())];
      ++row.entries;
      if (it.row() == column)
        row.diagonal = it.value();
      else
        row.other = static_cast<int>(column), row.factor = it.value();
    }
  std::vector<char> is_substituted(rows.size(), 0);
  substituted_.clear();
  kept_.clear();
  for (std::size_t i = 0; i < candidates; ++i) {
    if (rows[i].entries != 1 || rows[i].diagonal == 0.0) continue;
    substituted_.push_back({static_cast<int>(i), -1, rows[i].diagonal, 0.0, false});
    is_substituted[i] = 1;
  }
  // Of rows of two entries those whose other unknown is kept or known: not one that itself follows another.
  for (std::size_t i = 0; i < candidates; ++i) {
    const Few& row = rows[i];
    if (row.entries != 2 || row.diagonal == 0.0) continue;
    const Few& other = rows[static_cast<std::size_t>(row.other)];
    const bool known = is_substituted[static_cast<std::size_t>(row.other)] == 1;
    if (!known && static_cast<Index>(row.other) < most && other.entries == 2 && other.diagonal != 0.0) continue;
    substituted_.push_back({static_cast<int>(i), row.other, row.diagonal, row.factor, !known});
    is_substituted[i] = 2;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (is_substituted[i] == 0) kept_.push_back(static_cast<int>(i));
}

bool SubstitutedRows::factorise(const Eigen::SparseMatrix<double>& A, Index may_be_substituted,
                                const std::function<OrderedBlocks(const std::vector<int>& kept)>& blocks) {
  ensure(A.rows() == A.cols() && A.isCompressed(), "SubstitutedRows: a square matrix in compressed columns is wanted");
  n_ = A.rows();
  find_substitutions(A, may_be_substituted);
  std::vector<int> place(static_cast<std::size_t>(n_), -1);  // among those kept
  for (std::size_t k = 0; k < kept_.size(); ++k) place[static_cast<std::size_t>(kept_[k])] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double>> kept, substituted;
  kept.reserve(static_cast<std::size_t>(A.nonZeros()));
  for (std::size_t k = 0; k < kept_.size(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, kept_[k]); it; ++it)
      if (const int row = place[static_cast<std::size_t>(it.row())]; row >= 0)
        kept.emplace_back(row, static_cast<int>(k), it.value());
  for (std::size_t s = 0; s < substituted_.size(); ++s) {
    const Substitution& by = substituted_[s];
    const int follows = by.other_kept ? place[static_cast<std::size_t>(by.other)] : -1;
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, by.unknown); it; ++it) {
      const int row = place[static_cast<std::size_t>(it.row())];
      if (row < 0) continue;
      substituted.emplace_back(row, static_cast<int>(s), it.value());
      if (follows >= 0) kept.emplace_back(row, follows, -by.factor / by.diagonal * it.value());
    }
  }
  const auto count = static_cast<Index>(kept_.size());
  kept_matrix_.resize(count, count);
  kept_matrix_.setFromTriplets(kept.begin(), kept.end());
  of_substituted_.resize(count, static_cast<Index>(substituted_.size()));
  of_substituted_.setFromTriplets(substituted.begin(), substituted.end());
  return lu_.factorise(kept_matrix_, blocks ? std::function<OrderedBlocks()>([&] { return blocks(kept_); }) : nullptr);
}

void SubstitutedRows::solve(const Matrix& B, Matrix& X) const {
  ensure(B.rows() == n_, "SubstitutedRows: matrix and right-hand side differ in size");
  X.setZero(n_, B.cols());
  Matrix right = B(kept_, Eigen::all), found;
  for (Index column = 0; column < B.cols(); ++column)
    for (std::size_t s = 0; s < substituted_.size(); ++s) {
      const Substitution& by = substituted_[s];
      double value = B(by.unknown, column);
      if (by.other >= 0 && !by.other_kept) value -= by.factor * X(by.other, column);
      if (value == 0.0) continue;
      value /= by.diagonal;
      X(by.unknown, column) = value;
      for (Eigen::SparseMatrix<double>::InnerIterator it(of_substituted_, static_cast<Index>(s)); it; ++it)
        right(it.row(), column) -= it.value() * value;
    }
  lu_.solve(right, found);
  X(kept_, Eigen::all) = found;
  for (const Substitution& by : substituted_)
    if (by.other_kept) X.row(by.unknown) -= by.factor / by.diagonal * X.row(by.other);
}

}  // namespace scabo::linalg
