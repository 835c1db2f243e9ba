#include "scabo/linalg/changed_factor.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/decompositions.hpp"

namespace scabo::linalg {
namespace {

constexpr int side = 24;

/// Stiffness of a square grid of springs with two components at each node, held along one side.
SparseMatrix grid() {
  const int n = side * side;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int i, int j, double stiffness) {
    for (int c = 0; c < 2; ++c) {
      for (const int k : {i, j}) entries.emplace_back(2 * k + c, 2 * k + c, stiffness);
      entries.emplace_back(2 * i + c, 2 * j + c, -stiffness);
      entries.emplace_back(2 * j + c, 2 * i + c, -stiffness);
    }
  };
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < 2; ++c) entries.emplace_back(2 * i + c, 2 * i + c, i < side ? 1.0 : 1e-9);
    for (int c = 0; c < 2; ++c) entries.emplace_back(2 * i + c, 2 * i + 1 - c, i < side ? 0.1 : 1e-10);
    if (i % side + 1 < side) add(i, i + 1, 1.0 + 0.1 * (i % 3));
    if (i + side < n) add(i, i + side, 1.0 + 0.1 * (i % 5));
  }
  SparseMatrix A(2 * n, 2 * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// The grid without some unknowns, stiffer where it is coupled with them, and with others.
struct Changed {
  SparseMatrix A;
  std::vector<int> same;
};
Changed changed(const SparseMatrix& before, const std::vector<int>& gone, int others) {
  std::vector<int> place(static_cast<std::size_t>(before.rows()), 0);
  for (const int i : gone) place[static_cast<std::size_t>(i)] = -1;
  Changed made;
  for (int i = 0; i < before.rows(); ++i) {
    if (place[static_cast<std::size_t>(i)] < 0) continue;
    place[static_cast<std::size_t>(i)] = static_cast<int>(made.same.size());
    made.same.push_back(i);
  }
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> beside;
  for (int j = 0; j < before.cols(); ++j) {
    const int column = place[static_cast<std::size_t>(j)];
    for (SparseMatrix::InnerIterator it(before, j); it; ++it) {
      const int row = place[static_cast<std::size_t>(it.row())];
      if (row >= 0 && column >= 0) entries.emplace_back(row, column, it.value());
      if (row >= 0 && column < 0) entries.emplace_back(row, row, 1.0), beside.push_back(row);
    }
  }
  for (int k = 0; k < others; ++k) {
    const auto other = static_cast<int>(made.same.size());
    made.same.push_back(-1);
    entries.emplace_back(other, other, 3.0);
    for (const int row : {beside[static_cast<std::size_t>(k) % beside.size()], k > 0 ? other - 1 : beside.back()}) {
      entries.emplace_back(other, row, -0.5);
      entries.emplace_back(row, other, -0.5);
    }
  }
  made.A.resize(static_cast<Eigen::Index>(made.same.size()), static_cast<Eigen::Index>(made.same.size()));
  made.A.setFromTriplets(entries.begin(), entries.end());
  return made;
}

/// A rectangle of nodes in the middle.
std::vector<int> in_the_middle() {
  std::vector<int> unknowns;
  for (int y = 10; y < 14; ++y)
    for (int x = 9; x < 15; ++x)
      for (int c = 0; c < 2; ++c) unknowns.push_back(2 * (y * side + x) + c);
  return unknowns;
}

/// The rows and columns of a matrix that are its last ones, behind others that are held.
struct Part {
  explicit Part(const SparseMatrix& A) {
    constexpr int held = 2;
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < held; ++k) {
      place.push_back(-1);
      entries.emplace_back(k, k, 5.0);
      for (const int row : {held + k, held + 3}) entries.emplace_back(row, k, -1.0), entries.emplace_back(k, row, -1.0);
    }
    for (int j = 0; j < A.cols(); ++j) {
      place.push_back(j);
      unknowns.push_back(held + j);
      for (SparseMatrix::InnerIterator it(A, j); it; ++it)
        entries.emplace_back(held + static_cast<int>(it.row()), held + j, it.value());
    }
    matrix.resize(held + A.rows(), held + A.cols());
    matrix.setFromTriplets(entries.begin(), entries.end());
  }
  operator PrincipalPart() const { return {matrix, unknowns, place}; }
  SparseMatrix matrix;
  std::vector<int> unknowns, place;
};

Factorised factorised(const Part& part, const SparseMatrix& A) {
  return {part, std::make_shared<const SymmetricPositiveSolver>(A)};
}

TEST(ChangedFactor, SolvesAsAFactorOfItsOwn) {
  const SparseMatrix before = grid();
  const Changed now = changed(before, in_the_middle(), 31);
  const Part part(before), part_now(now.A);
  const auto factor = factor_by_changes(part_now, factorised(part, before), now.same, {});
  ASSERT_TRUE(factor);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  const auto n = static_cast<int>(now.A.rows());
  const Matrix B = Matrix::NullaryExpr(n, 3, [&] { return entry(random); }), X = test::solve_cholesky(Matrix(now.A), B);
  EXPECT_LT((factor->solve(B) - X).norm(), 1e-11 * X.norm());
  const Vector b = B.col(0);
  std::vector<int> changed_ones, some;  // at its end
  for (int i = n - 31; i < n; i += 4) changed_ones.push_back(i), some.push_back(i);
  some.push_back(7);
  for (const auto& wanted : {changed_ones, some})
    EXPECT_LT((factor->solve_at(factor->begin(b), wanted) - X(wanted, 0)).norm(), 1e-11 * X.col(0).norm());
  const Matrix inverse = test::solve_cholesky(Matrix(now.A), Matrix::Identity(n, n));
  for (const auto& wanted : {changed_ones, some}) {
    const Matrix block = factor->inverse_block(wanted);
    EXPECT_LT((block - inverse(wanted, wanted)).norm(), 1e-11 * block.norm());
    EXPECT_EQ(block, block.transpose());
  }
}

TEST(ChangedFactor, SolvesTheSameMatrix) {
  const SparseMatrix A = grid();
  const Part part(A);
  const Factorised known = factorised(part, A);
  std::vector<int> same(static_cast<std::size_t>(A.rows()));
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<int>(i);
  const Vector b = Vector::LinSpaced(A.rows(), -1.0, 2.0), x = known.factor->solve(b);
  const auto factor = factor_by_changes(part, known, same, {});
  ASSERT_TRUE(factor);
  EXPECT_LT((factor->solve(b) - x).norm(), 1e-13 * x.norm());
  const std::vector<int> near{3, 100, 101};
  const auto with_near = factor_by_changes(part, known, same, near);
  ASSERT_TRUE(with_near);
  const Matrix block = known.factor->inverse_block(near);
  EXPECT_LT((with_near->inverse_block(near) - block).norm(), 1e-12 * block.norm());
}

TEST(ChangedFactor, IsNoneWhereMuchIsDifferent) {
  const SparseMatrix before = grid();
  const Part part(before), twice(2.0 * before);
  const Factorised known = factorised(part, before);
  std::vector<int> same(static_cast<std::size_t>(before.rows()), -1);
  EXPECT_FALSE(factor_by_changes(part, known, same, {}));
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<int>(i);
  EXPECT_FALSE(factor_by_changes(twice, known, same, {}));
  EXPECT_TRUE(factor_by_changes(part, known, same, {}));
}

}  // namespace
}  // namespace scabo::linalg
