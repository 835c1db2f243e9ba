#include "scabo/base/interruption.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseCore>
#include <atomic>
#include <random>

#include "scabo/linalg/cholesky_factor.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/linalg/parallel.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "support/random.hpp"

namespace scabo::linalg {
namespace {

struct Ended {};

/// Counts how often it is asked, and ends the work at the `last` time and after it.
class Asked {
 public:
  explicit Asked(int last = 1 << 30)
      : last_(last), ask_([this] {
          if (++times_ >= last_) throw Ended{};
        }) {}
  const Interruptible::Ask* ask() const { return &ask_; }
  int times() const { return times_; }

 private:
  int last_;
  std::atomic<int> times_{0};
  Interruptible::Ask ask_;
};

/// Of `work` without an end.
template <typename Work>
int points_in(const Work& work) {
  const Asked asked;
  const Interruptible here(asked.ask());
  work();
  return asked.times();
}

template <typename Work>
void expect_that_it_ends(const Work& work, int last) {
  const Asked asked(last);
  const Interruptible here(asked.ask());
  EXPECT_THROW(work(), Ended);
}

Matrix random_matrix(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 random(7);
  Matrix A(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) A(i, j) = test::uniform(random, -1.0, 1.0);
  return A;
}

Matrix definite(Eigen::Index n) { return 2.0 * static_cast<double>(n) * Matrix::Identity(n, n) + Matrix::Ones(n, n); }

TEST(Interruption, NothingIsAskedWhereNobodyAsks) {
  interruption_point();
  const Asked outer(1);
  const Interruptible here(outer.ask());
  {
    const Interruptible nobody(nullptr);
    interruption_point();
  }
  EXPECT_EQ(outer.times(), 0);
  EXPECT_THROW(interruption_point(), Ended);
}

TEST(Interruption, EveryTaskOfEveryThreadAsks) {
  for (const int threads : {1, 3}) {
    std::atomic<int> done = 0;
    EXPECT_EQ(points_in([&] { parallel_for(50, threads, [&](int) { ++done; }); }), 50);
    EXPECT_EQ(done, 50);
    done = 0;
    expect_that_it_ends([&] { parallel_for(50, threads, [&](int) { ++done; }); }, 11);
    EXPECT_EQ(done, 10);
  }
  parallel_for(4, 3, [](int) { interruption_point(); });  // nobody asks any more
}

TEST(Interruption, WithinADenseFactorisation) {
  CholeskyFactor factor;
  const auto factorise = [&] {
    factor.A = definite(640);
    ASSERT_TRUE(factor.factorise());
  };
  EXPECT_EQ(points_in(factorise), 20);  // blocks of 32
  EXPECT_THROW(
      {
        const Asked asked(20);
        const Interruptible here(asked.ask());
        factorise();
      },
      Ended);
}

TEST(Interruption, WithinTheSweepOverASparseFactor) {
  constexpr int n = 40;  // n x n points with five neighbours
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n * n; ++i) {
    entries.emplace_back(i, i, 4.01);
    for (const int j : {i + 1, i + n})
      if (j < n * n && (j != i + 1 || j % n != 0)) entries.emplace_back(i, j, -1.0), entries.emplace_back(j, i, -1.0);
  }
  SparseMatrix A(n * n, n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  const SymmetricPositiveSolver solver(A);
  const std::vector<int> corner = {0, 1, 2};
  const auto sweep = [&] { solver.inverse_block(corner); };
  const int points = points_in(sweep);  // one for each supernode on the way to the root
  EXPECT_GE(points, 3);
  expect_that_it_ends(sweep, points);
}

// Products of more than 1e10 operations are made in pieces.
TEST(Interruption, PiecesOfLargeProductsAreTheProduct) {
  const Matrix A = random_matrix(2000, 2600);
  const Vector x = random_matrix(2000, 1), y = random_matrix(2600, 1);
  Matrix C = Matrix::Identity(2000, 2000);
  EXPECT_EQ(points_in([&] { subtract_square(A, C); }), 2);
  const Vector expected = x - A * (A.transpose() * x);
  EXPECT_LT((C.selfadjointView<Eigen::Lower>() * x - expected).norm(), 1e-12 * expected.norm());

  Matrix product;
  EXPECT_EQ(points_in([&] { product = multiply_transposed(A.leftCols(1500), A); }), 1);  // 7.8e9
  EXPECT_EQ(points_in([&] { product = multiply_transposed(A, A); }), 2);
  const Vector of_y = A.transpose() * (A * y);
  EXPECT_LT((product * y - of_y).norm(), 1e-12 * of_y.norm());
}

TEST(Interruption, PiecesOfALargeDivisionAreTheQuotient) {
  CholeskyFactor L;
  L.A = definite(1500);
  ASSERT_TRUE(L.factorise());
  const Matrix B = random_matrix(6000, 1500);
  Matrix X = B;
  EXPECT_GE(points_in([&] { L.divide(X); }), 2);
  const Vector x = random_matrix(1500, 1);
  const Vector Lx = L.A.triangularView<Eigen::Lower>().transpose() * x;
  EXPECT_LT((X * Lx - B * x).norm(), 1e-11 * (B * x).norm());
}

}  // namespace
}  // namespace scabo::linalg
