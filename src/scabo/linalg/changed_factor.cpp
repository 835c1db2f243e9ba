#include "scabo/linalg/changed_factor.hpp"

#include <lapacke.h>

#include <utility>

namespace scabo::linalg {

namespace {

/// Whether column j of A is column i of A_0, entry by entry in its order.
bool is_same_column(const SparseMatrix& A, int j, const SparseMatrix& A_0, int i, const std::vector<int>& same) {
  const int *const starts = A.outerIndexPtr(), *const starts_0 = A_0.outerIndexPtr();
  const int count = starts[j + 1] - starts[j];
  if (count != starts_0[i + 1] - starts_0[i]) return false;
  const int *const rows = A.innerIndexPtr() + starts[j], *const rows_0 = A_0.innerIndexPtr() + starts_0[i];
  const double *const values = A.valuePtr() + starts[j], *const values_0 = A_0.valuePtr() + starts_0[i];
  for (int k = 0; k < count; ++k)
    if (same[static_cast<std::size_t>(rows[k])] != rows_0[k] || values[k] != values_0[k]) return false;
  return true;
}

/// Unknowns by their numbers, and the other way round.
struct Numbered {
  std::vector<int> unknowns;
  std::vector<int> place;  // -1: not among them
  void add(int unknown) {
    place[static_cast<std::size_t>(unknown)] = static_cast<int>(unknowns.size());
    unknowns.push_back(unknown);
  }
  int of(int unknown) const { return place[static_cast<std::size_t>(unknown)]; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(unknowns.size()); }
};

Numbered none_of(Eigen::Index all) { return {{}, std::vector<int>(static_cast<std::size_t>(all), -1)}; }

/// The rows and columns of these unknowns.
std::vector<Eigen::Triplet<double>> entries_of(const SparseMatrix& A, const Numbered& of) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const int j : of.unknowns)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it)
      if (const int row = of.of(static_cast<int>(it.row())); row >= 0) entries.emplace_back(row, of.of(j), it.value());
  return entries;
}

SymmetricPositiveSolver factor_of(const std::vector<Eigen::Triplet<double>>& entries, Eigen::Index size) {
  if (size == 0) return SymmetricPositiveSolver();
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return SymmetricPositiveSolver(matrix);
}

/// Of a symmetric positive definite matrix.
Matrix inverse_of(Matrix A) {
  const auto n = static_cast<lapack_int>(A.rows());
  if (LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, A.data(), n) != 0 ||
      LAPACKE_dpotri(LAPACK_COL_MAJOR, 'L', n, A.data(), n) != 0)
    throw NotPositiveDefinite();
  return A.selfadjointView<Eigen::Lower>();
}

class ChangedFactor final : public SparseFactor {
 public:
  ChangedFactor(const SparseMatrix& A, const Factorised& before, Numbered near, const std::vector<int>& far,
                const std::vector<int>& same)
      : factor_(before.factor), size_before_(before.A.rows()), near_(std::move(near)) {
    Numbered near_before = none_of(before.A.rows());
    std::vector<char> is_far(static_cast<std::size_t>(before.A.rows()), 0);
    for (const int j : far) {
      const int i = same[static_cast<std::size_t>(j)];
      is_far[static_cast<std::size_t>(i)] = 1;
      far_.push_back(j);
      far_before_.push_back(i);
    }
    for (int i = 0; i < before.A.rows(); ++i)
      if (is_far[static_cast<std::size_t>(i)] == 0) near_before.add(i);
    std::vector<int> border;  // b among the near unknowns of A_0
    for (const int j : near_.unknowns) {
      bool reaches = false;
      for (SparseMatrix::InnerIterator it(A, j); it && !reaches; ++it)
        reaches = near_.of(static_cast<int>(it.row())) < 0;
      if (!reaches) continue;
      border_.push_back(near_.of(j));
      border_before_.push_back(same[static_cast<std::size_t>(j)]);
      border.push_back(near_before.of(border_before_.back()));
    }
    std::vector<Eigen::Triplet<double>> entries = entries_of(A, near_);
    if (!border.empty()) {
      stiffness_ = inverse_of(factor_->inverse_block(border_before_));
      const Matrix less =
          stiffness_ -
          inverse_of(factor_of(entries_of(before.A, near_before), near_before.size()).inverse_block(border));  // -(2)
      for (std::size_t j = 0; j < border_.size(); ++j)
        for (std::size_t i = 0; i < border_.size(); ++i)
          entries.emplace_back(border_[i], border_[j],
                               less(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
    solver_ = factor_of(entries, near_.size());
  }

  Matrix solve(const Matrix& B) const override {
    Matrix X(B.rows(), B.cols());
    for (Eigen::Index k = 0; k < B.cols(); ++k) {
      const HalfSolved half = half_solved(B.col(k));
      X(far_, k) = factor_->solve_from(half.begun, held(half))(far_before_);
      X(near_.unknowns, k) = half.near;
    }
    return X;
  }

  Vector solve_at(const Vector& b, const std::vector<int>& wanted) const override {
    Vector x(static_cast<Eigen::Index>(wanted.size()));
    const HalfSolved half = half_solved(b);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const int place = near_.of(wanted[i]);
      if (place < 0) return solve(b)(wanted, 0);
      x[static_cast<Eigen::Index>(i)] = half.near[place];
    }
    return x;
  }

  Matrix inverse_block(const std::vector<int>& indices) const override {
    std::vector<int> places;
    for (const int i : indices)
      if (const int place = near_.of(i); place >= 0) places.push_back(place);
    if (places.size() == indices.size()) return solver_.inverse_block(places);
    const auto m = static_cast<Eigen::Index>(indices.size());
    Matrix block(m, m);
    for (Eigen::Index k = 0; k < m; ++k)
      block.col(k) = solve(Vector::Unit(static_cast<Eigen::Index>(near_.place.size()),
                                        indices[static_cast<std::size_t>(k)]))(indices, 0);
    return 0.5 * (block + block.transpose());
  }

 private:
  struct HalfSolved {
    Vector begun;   // with r_f
    Vector forces;  // G^-1 y_b
    Vector near;    // x_n
  };

  HalfSolved half_solved(const Vector& r) const {
    HalfSolved half;
    Vector of_far = Vector::Zero(size_before_);
    of_far(far_before_) = r(far_);
    half.begun = factor_->begin(of_far);
    Vector of_near = r(near_.unknowns);
    half.forces = Vector::Zero(static_cast<Eigen::Index>(border_.size()));
    if (!border_.empty()) half.forces = stiffness_ * factor_->solve_at(half.begun, border_before_);
    of_near(border_) += half.forces;
    half.near = solver_.solve(of_near).col(0);
    return half;
  }

  /// q of eq. (3), on the unknowns of A_0.
  Vector held(const HalfSolved& half) const {
    Vector q = Vector::Zero(size_before_);
    if (!border_.empty()) q(border_before_) = stiffness_ * half.near(border_) - half.forces;
    return q;
  }

  std::shared_ptr<const SymmetricPositiveSolver> factor_;  // of A_0
  Eigen::Index size_before_;
  std::vector<int> far_, far_before_;  // in A and in A_0
  Numbered near_;
  std::vector<int> border_, border_before_;  // b among the near unknowns of A, and in A_0
  Matrix stiffness_;                         // G^-1
  SymmetricPositiveSolver solver_;           // of N - C
};

}  // namespace

std::unique_ptr<SparseFactor> factor_by_changes(const SparseMatrix& A, const Factorised& before,
                                                const std::vector<int>& same, const std::vector<int>& near) {
  constexpr Eigen::Index least_part = 8;  // of all unknowns: larger near ones take as long as a new factor
  std::vector<char> is_near(same.size(), 0);
  for (const int j : near) is_near[static_cast<std::size_t>(j)] = 1;
  std::vector<int> far;
  Numbered changed = none_of(A.rows());
  for (int j = 0; j < A.cols(); ++j) {
    const auto unknown = static_cast<std::size_t>(j);
    const bool is_far =
        is_near[unknown] == 0 && same[unknown] >= 0 && is_same_column(A, j, before.A, same[unknown], same);
    if (is_far)
      far.push_back(j);
    else
      changed.add(j);
    if (least_part * changed.size() > A.cols()) return nullptr;
  }
  try {
    return std::make_unique<ChangedFactor>(A, before, std::move(changed), far, same);
  } catch (const NotPositiveDefinite&) {
    return nullptr;
  }
}

}  // namespace scabo::linalg
