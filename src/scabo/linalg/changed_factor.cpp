#include "scabo/linalg/changed_factor.hpp"

#include <lapacke.h>

#include <utility>

namespace scabo::linalg {

namespace {

/// The entries of one column of a part of a matrix.
class Column {
 public:
  Column(const PrincipalPart& of, int unknown)
      : place_(of.place), entry_(of.matrix, of.unknowns[static_cast<std::size_t>(unknown)]) {
    skip();
  }
  explicit operator bool() const { return entry_; }
  void operator++() { ++entry_, skip(); }
  int row() const { return place_[static_cast<std::size_t>(entry_.row())]; }
  double value() const { return entry_.value(); }

 private:
  void skip() {
    while (entry_ && row() < 0) ++entry_;
  }
  const std::vector<int>& place_;
  SparseMatrix::InnerIterator entry_;
};

/// Columns of A that are columns of A_0, entry by entry in their order.
class SameColumns {
 public:
  SameColumns(const PrincipalPart& A, const PrincipalPart& A_0, const std::vector<int>& same)
      : A_(A), A_0_(A_0), same_(same), there_(A.place.size(), outside) {
    for (std::size_t row = 0; row < there_.size(); ++row)
      if (const int place = A.place[row]; place >= 0) there_[row] = same[static_cast<std::size_t>(place)];
  }

  bool is_same(int unknown) const {
    const int before = same_[static_cast<std::size_t>(unknown)];
    if (before < 0) return false;
    SparseMatrix::InnerIterator one(A_.matrix, A_.unknowns[static_cast<std::size_t>(unknown)]),
        other(A_0_.matrix, A_0_.unknowns[static_cast<std::size_t>(before)]);
    for (;; ++one, ++other) {
      while (one && there_[static_cast<std::size_t>(one.row())] == outside) ++one;
      while (other && A_0_.place[static_cast<std::size_t>(other.row())] < 0) ++other;
      if (!one || !other) return !one && !other;
      if (there_[static_cast<std::size_t>(one.row())] != A_0_.place[static_cast<std::size_t>(other.row())] ||
          one.value() != other.value())
        return false;
    }
  }

 private:
  static constexpr int outside = -2;  // rows that are not of the part
  const PrincipalPart &A_, &A_0_;
  const std::vector<int>& same_;
  std::vector<int> there_;  // of every row of A that unknown of A_0 which may be the same one, or -1
};

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

using Entries = std::vector<Eigen::Triplet<double>>;

/// The rows and columns of these unknowns.
Entries entries_of(const PrincipalPart& A, const Numbered& of) {
  Entries entries;
  for (const int j : of.unknowns)
    for (Column entry(A, j); entry; ++entry)
      if (const int row = of.of(entry.row()); row >= 0) entries.emplace_back(row, of.of(j), entry.value());
  return entries;
}

SparseMatrix matrix_of(const Entries& entries, Eigen::Index size) {
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SymmetricPositiveSolver factor_of(const SparseMatrix& A) {
  return A.rows() > 0 ? SymmetricPositiveSolver(A) : SymmetricPositiveSolver();
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
  ChangedFactor(const PrincipalPart& A, const Factorised& before, Numbered near, const std::vector<int>& far,
                const std::vector<int>& same)
      : factor_(before.factor), size_before_(before.A.size()), before_of_(same), near_(std::move(near)) {
    std::vector<char> is_far(static_cast<std::size_t>(before.A.size()), 0);
    for (const int j : far) {
      const int i = same[static_cast<std::size_t>(j)];
      is_far[static_cast<std::size_t>(i)] = 1;
      far_.push_back(j);
      far_before_.push_back(i);
    }
    Numbered near_before = none_of(before.A.size());
    for (int i = 0; i < before.A.size(); ++i)
      if (is_far[static_cast<std::size_t>(i)] == 0) near_before.add(i);
    for (const int j : near_.unknowns) {
      bool reaches = false;
      for (Column entry(A, j); entry && !reaches; ++entry) reaches = near_.of(entry.row()) < 0;
      if (!reaches) continue;
      border_.push_back(near_.of(j));
      border_before_.push_back(same[static_cast<std::size_t>(j)]);
      border_among_.push_back(near_before.of(border_before_.back()));
    }
    Entries entries = entries_of(A, near_);
    N_ = matrix_of(entries, near_.size());
    N_before_ = matrix_of(entries_of(before.A, near_before), near_before.size());
    near_before_ = std::move(near_before.unknowns);
    if (!border_.empty()) {
      flexibility_ = factor_->inverse_block(border_before_);
      stiffness_ = inverse_of(flexibility_);
      stiffness_before_ = inverse_of(factor_of(N_before_).inverse_block(border_among_));
      for (std::size_t j = 0; j < border_.size(); ++j)
        for (std::size_t i = 0; i < border_.size(); ++i) {
          const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
          entries.emplace_back(border_[i], border_[j], stiffness_(row, column) - stiffness_before_(row, column));  // -C
        }
    }
    solver_ = factor_of(matrix_of(entries, near_.size()));
  }

  Matrix solve(const Matrix& B) const override {
    Matrix X(B.rows(), B.cols());
    for (Eigen::Index k = 0; k < B.cols(); ++k) {
      const HalfSolved half = half_solved(B.col(k));
      X(far_, k) = factor_->solve_from(half.begun, half.forces)(far_before_);
      X(near_.unknowns, k) = half.near;
    }
    return X;
  }

  Vector solve_at(const Vector& b, const std::vector<int>& wanted) const override {
    const HalfSolved half = half_solved(b);
    Vector x(static_cast<Eigen::Index>(wanted.size()));
    std::vector<int> far, there;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const int place = near_.of(wanted[i]);
      if (place >= 0)
        x[static_cast<Eigen::Index>(i)] = half.near[place];
      else
        far.push_back(static_cast<int>(i)), there.push_back(before_of_[static_cast<std::size_t>(wanted[i])]);
    }
    if (!far.empty()) x(far) = factor_->solve_at(half.begun + factor_->begin(half.forces), there);
    return x;
  }

  /// Unit forces on far unknowns J move the border by T_bJ in A_0, and are P = G^-1 T_bJ on it in eq. (1).
  Matrix inverse_block(const std::vector<int>& indices) const override {
    std::vector<int> near, far, places = border_, columns(static_cast<std::size_t>(near_.size()), -1), at, all;
    for (std::size_t k = 0; k < border_.size(); ++k)
      columns[static_cast<std::size_t>(border_[k])] = static_cast<int>(k);
    all = border_before_;
    for (std::size_t k = 0; k < indices.size(); ++k) {
      const int place = near_.of(indices[k]);
      if (place < 0) {
        far.push_back(static_cast<int>(k));
        all.push_back(before_of_[static_cast<std::size_t>(indices[k])]);
        continue;
      }
      int& column = columns[static_cast<std::size_t>(place)];
      if (column < 0) column = static_cast<int>(places.size()), places.push_back(place);
      near.push_back(static_cast<int>(k));
      at.push_back(column);
    }
    const Matrix R = solver_.inverse_block(places);  // of N - C
    Matrix block(indices.size(), indices.size());
    block(near, near) = R(at, at);
    if (far.empty()) return block;
    const auto b = static_cast<Eigen::Index>(border_.size()), m = static_cast<Eigen::Index>(far.size());
    const Matrix T = factor_->inverse_block(all), P = stiffness_ * T.topRightCorner(b, m);
    const Matrix across = R(at, Eigen::seqN(0, b)) * P;
    const Matrix among =
        T.bottomRightCorner(m, m) + P.transpose() * (R.topLeftCorner(b, b) * P - T.topRightCorner(b, m));
    block(near, far) = across;
    block(far, near) = across.transpose();
    block(far, far) = 0.5 * (among + among.transpose());
    return block;
  }

 private:
  struct HalfSolved {
    Vector begun;   // of A_0, with r_f
    Vector near;    // x_n
    Vector forces;  // q, on the unknowns of A_0
  };

  /// Eq. (3).
  HalfSolved half_solved(const Vector& r) const {
    HalfSolved half;
    Vector of_far = Vector::Zero(size_before_);
    of_far(far_before_) = r(far_);
    half.begun = factor_->begin(of_far);
    half.near = Vector::Zero(near_.size());
    half.forces = Vector::Zero(size_before_);
    Vector of_near = r(near_.unknowns);
    if (border_.empty()) {
      half.near = solver_.solve(of_near).col(0);
      return half;
    }
    const Vector y = factor_->solve_at(half.begun, near_before_);
    half.near(border_) = y(border_among_);
    of_near(border_) += Vector(N_before_ * y)(border_among_);
    of_near -= N_ * half.near;
    Vector z = solver_.solve(of_near).col(0), q = holding(z(border_));
    // Once more, with what rounding of C has left: flexible bodies bend far by small forces.
    of_near -= N_ * z;
    of_near(border_) += stiffness_before_ * z(border_) - q;
    z += solver_.solve(of_near).col(0);
    half.near += z;
    half.forces(border_before_) = holding(z(border_));
    return half;
  }

  /// G^-1 z, to the rounding of G.
  Vector holding(const Vector& z) const {
    const Vector q = stiffness_ * z;
    return q + stiffness_ * (z - flexibility_ * q);
  }

  std::shared_ptr<const SymmetricPositiveSolver> factor_;  // of A_0
  Eigen::Index size_before_;
  std::vector<int> far_, far_before_;  // in A and in A_0
  std::vector<int> before_of_;         // of every unknown of A that in A_0
  Numbered near_;
  std::vector<int> near_before_;                            // o, in A_0
  std::vector<int> border_, border_before_, border_among_;  // b among the near unknowns of A, in A_0, and among o
  SparseMatrix N_, N_before_;
  Matrix flexibility_, stiffness_, stiffness_before_;  // G, G^-1, H^-1
  SymmetricPositiveSolver solver_;                     // of N - C
};

}  // namespace

std::unique_ptr<SparseFactor> factor_by_changes(const PrincipalPart& A, const Factorised& before,
                                                const std::vector<int>& same, const std::vector<int>& near) {
  constexpr Eigen::Index least_part = 8;  // of all unknowns: larger near ones take as long as a new factor
  std::vector<char> is_near(same.size(), 0);
  for (const int j : near) is_near[static_cast<std::size_t>(j)] = 1;
  std::vector<int> far;
  Numbered changed = none_of(A.size());
  const SameColumns columns(A, before.A, same);
  for (int j = 0; j < A.size(); ++j) {
    const auto unknown = static_cast<std::size_t>(j);
    if (is_near[unknown] == 0 && columns.is_same(j))
      far.push_back(j);
    else
      changed.add(j);
    if (least_part * changed.size() > A.size()) return nullptr;
  }
  try {
    return std::make_unique<ChangedFactor>(A, before, std::move(changed), far, same);
  } catch (const NotPositiveDefinite&) {
    return nullptr;
  }
}

}  // namespace scabo::linalg
