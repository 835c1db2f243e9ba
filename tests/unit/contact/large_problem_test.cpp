// Ten thousand pairs by a sparse factorisation, and the three kinds of W.
#include <gtest/gtest.h>

#include <cmath>

#include "scabo/contact/files/global_problem.hpp"
#include "scabo/contact/solve.hpp"
#include "support/decompositions.hpp"

namespace scabo::contact {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Motions without contact that press, open and shear along the interface.
Vector waves(Eigen::Index pairs, int d, double size) {
  Vector q(d * pairs);
  for (Eigen::Index i = 0; i < pairs; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(pairs);
    q[d * i] = size * (std::cos(40.0 * s) - 0.4);
    q[d * i + 1] = size * 0.6 * std::sin(27.0 * s);
    if (d == 3) q[d * i + 2] = size * 0.4 * std::cos(55.0 * s);
  }
  return q;
}

// Every pair is coupled with its three neighbours on both sides.
TEST(LargeProblem, TenThousandPairsWithSparseW) {
  for (int d : {2, 3}) {
    const Eigen::Index pairs = 10000;
    Triplets entries;
    for (Eigen::Index i = 0; i < pairs; ++i)
      for (Eigen::Index j = std::max<Eigen::Index>(0, i - 3); j <= std::min(pairs - 1, i + 3); ++j) {
        const double coupling = std::pow(0.3, std::abs(static_cast<double>(i - j)));
        for (int k = 0; k < d; ++k) entries.emplace_back(d * i + k, d * j + k, coupling);
        if (i != j) continue;
        entries.emplace_back(d * i, d * i + 1, 0.1);
        entries.emplace_back(d * i + 1, d * i, 0.1);
      }
    Eigen::SparseMatrix<double> W(d * pairs, d * pairs);
    W.setFromTriplets(entries.begin(), entries.end());
    Problem problem;
    problem.dimension = d;
    problem.W = Delassus(W);
    problem.q = waves(pairs, d, 1.0);
    problem.mu = Vector::Constant(pairs, 0.4);
    problem.G.resize(d * pairs, 0);
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::solved) << solution.reason;
    EXPECT_LE(solution.certificate.worst(), 1e-10);
    EXPECT_LE(solution.natural_map_residual, 1e-10);
  }
}

/// W by its products.
class Products final : public PairOperator {
 public:
  explicit Products(Matrix W) : W_(std::move(W)) {}
  Eigen::Index size() const override { return W_.rows(); }
  Vector times(const Vector& p) const override { return W_ * p; }
  Matrix diagonal_blocks() const override {
    Matrix blocks(2, W_.rows());
    for (Eigen::Index i = 0; i < W_.rows(); i += 2) blocks.middleCols<2>(i) = W_.block<2, 2>(i, i);
    return blocks;
  }

 private:
  Matrix W_;
};

// The same operator in its four kinds.
TEST(Delassus, DenseSparseAndCondensedAgree) {
  const Triplets entries = {{0, 0, 4.0},  {1, 1, 5.0},  {2, 2, 6.0}, {3, 3, 7.0},
                            {0, 1, -1.0}, {1, 0, -1.0}, {2, 3, 2.0}, {3, 2, 2.0}};
  linalg::SparseMatrix K(4, 4);
  K.setFromTriplets(entries.begin(), entries.end());
  Matrix B_dense(4, 4);
  B_dense << 1, 0, 0, 1, 0, 1, 0, 0, -1, 0, 1, 0, 0, -1, 0, 1;
  const Matrix W = B_dense.transpose() * test::solve_lu(Matrix(K), B_dense);
  const Delassus condensed(std::make_shared<const FactorisedPairs>(K, B_dense.sparseView(), 2));
  const Vector p = Eigen::Vector4d(1.0, -2.0, 0.5, 3.0);
  for (const Delassus& kind : {Delassus(W), Delassus(Eigen::SparseMatrix<double>(W.sparseView())), condensed,
                               Delassus(std::make_shared<const Products>(W))}) {
    EXPECT_EQ(kind.size(), 4);
    EXPECT_LT((kind.times(p) - W * p).norm(), 1e-14);
    EXPECT_LT((kind.dense() - W).norm(), 1e-14);
    EXPECT_LT((kind.diagonal() - W.diagonal()).norm(), 1e-14);
    const Delassus scaled = kind.scaled(3.0);
    EXPECT_LT((scaled.times(p) - 3.0 * W * p).norm(), 1e-13);
    EXPECT_LT((scaled.times(Matrix(p)) - 3.0 * W * p).norm(), 1e-13);
    EXPECT_LT((scaled.dense() - 3.0 * W).norm(), 1e-13);
    EXPECT_LT((scaled.diagonal() - 3.0 * W.diagonal()).norm(), 1e-13);
    EXPECT_LT((scaled.diagonal_blocks(2) - 3.0 * kind.diagonal_blocks(2)).norm(), 1e-13);
    EXPECT_LT((scaled.scaled(2.0).dense() - 6.0 * W).norm(), 1e-13);
    for (int i = 0; i < 2; ++i)
      EXPECT_LT((kind.diagonal_blocks(2).middleCols<2>(2 * i) - W.block<2, 2>(2 * i, 2 * i)).norm(), 1e-14);
  }
}

// A matrix of 3.2 GB has no room for a copy.
TEST(Delassus, AFactorTakesNoCopy) {
  const Delassus W(Matrix(Matrix::Random(6, 6)));
  const Delassus scaled = W.scaled(2.0);
  EXPECT_EQ(scaled.matrix().data(), W.matrix().data());
  EXPECT_EQ(scaled.factor(), 2.0);
  EXPECT_EQ(scaled.dense(), Matrix(2.0 * W.dense()));
}

}  // namespace
}  // namespace scabo::contact
