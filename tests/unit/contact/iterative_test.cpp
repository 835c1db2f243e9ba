// Large problems whose W is known by its products alone: GMRES on the generalised Jacobian against dense LU.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "scabo/contact/gmres.hpp"
#include "scabo/contact/pair_operator.hpp"
#include "scabo/contact/solve.hpp"
#include "unit/contact/layer.hpp"

namespace scabo::contact {
namespace {

TEST(Gmres, EndsOnNumbersThatAreNone) {
  const auto copy = [](const Vector& x, Vector& result) { result = x; };
  const Vector b = Vector::Constant(3, std::numeric_limits<double>::quiet_NaN());
  Vector x = Vector::Zero(3);
  EXPECT_FALSE(gmres(copy, copy, b, x, {}) < 1.0);
  const auto overflow = [](const Vector& v, Vector& result) { result = 1e308 * (1e308 * v); };
  x.setZero();
  EXPECT_FALSE(gmres(overflow, overflow, Vector::Ones(3), x, {}) < 1e-3);
}

TEST(IterativeDirections, AgreeWithDenseOnesOnTwoThousandPairs) {
  for (double mu : {0.5}) {
    const Problem by_products = test::layer_problem(2000, 6, mu);
    Problem dense = by_products;
    dense.W = Delassus(by_products.W.dense());
    ASSERT_FALSE(by_products.W.is_dense());
    const Solution iterative = solve(by_products), direct = solve(dense);
    ASSERT_EQ(iterative.status, Status::solved) << iterative.reason;
    ASSERT_EQ(direct.status, Status::solved) << direct.reason;
    EXPECT_LE(iterative.certificate.worst(), 1e-10);
    EXPECT_LT((iterative.p - direct.p).lpNorm<Eigen::Infinity>(), 1e-9 * direct.p.lpNorm<Eigen::Infinity>());
    int open = 0, stick = 0, slip = 0;
    for (ContactState state : direct.states)
      ++(state == ContactState::open ? open : state == ContactState::stick ? stick : slip);
    EXPECT_GT(open, 100);
    EXPECT_GT(stick, 100);
    EXPECT_GT(slip, 100);
  }
}

/// The layer under a free rigid plate of weight `weight`, which may rise, move along and turn about its middle; it is
/// pulled along.
Problem plate_on_layer(int pairs, double weight) {
  Problem problem = test::layer_problem(pairs, 6, 0.5);
  Matrix G = Matrix::Zero(2 * pairs, 3);
  for (int i = 0; i < pairs; ++i) {
    G(2 * i, 0) = 1.0;
    G(2 * i + 1, 1) = 1.0;
    G(2 * i, 2) = 2.0 * i / (pairs - 1.0) - 1.0;
  }
  problem.G = G;
  problem.f = Eigen::Vector3d(-weight, 0.2 * weight, 0.1 * weight);
  return problem;
}

// A body that contact alone holds, above the size of a dense factorisation: it had no direction at all.
TEST(IterativeDirections, OfAFreeBodyHoldIt) {
  constexpr int pairs = 1300;
  const Problem by_products = plate_on_layer(pairs, 300.0);
  const Solution solution = solve(by_products);
  ASSERT_EQ(solution.status, Status::solved) << solution.reason;
  EXPECT_LE(solution.certificate.worst(), 1e-10);
  EXPECT_LE(solution.iterations, 25);
  // Equilibrium of the plate, outside of Scabo's own judge.
  Eigen::Vector3d resultant = Eigen::Vector3d::Zero();
  int open = 0;
  for (int i = 0; i < pairs; ++i) {
    resultant +=
        Eigen::Vector3d(solution.p[2 * i], solution.p[2 * i + 1], solution.p[2 * i] * (2.0 * i / (pairs - 1.0) - 1.0));
    open += solution.states[static_cast<std::size_t>(i)] == ContactState::open;
  }
  EXPECT_LT((resultant - Eigen::Vector3d(300.0, -60.0, -30.0)).norm(), 1e-8 * 300.0);
  ASSERT_GT(open, 100);  // so that the matrix itself, of fewer than 2,500 unknowns, is factorised
  Problem dense = by_products;
  dense.W = Delassus(by_products.W.dense());
  const Solution direct = solve(dense);
  ASSERT_EQ(direct.status, Status::solved) << direct.reason;
  EXPECT_LT((solution.p - direct.p).lpNorm<Eigen::Infinity>(), 1e-9 * direct.p.lpNorm<Eigen::Infinity>());
}

/// Holds pairs by a dense W whose entries have errors of 1e-4.
class ByDense final : public PairHolder {
 public:
  ByDense(const Matrix& W, const Matrix& G) : W_(W), G_(G) { W_.diagonal() *= 1.0 + 1e-4; }
  double operations() const override { return 0.0; }
  std::unique_ptr<HeldPairs> hold(const std::vector<int>& rows) const override {
    class Held final : public HeldPairs {
     public:
      Held(const Matrix& W, const Matrix& G, const std::vector<int>& rows) {
        const auto size = static_cast<Eigen::Index>(rows.size()), m = G.cols();
        Matrix A = Matrix::Zero(size + m, size + m);
        A.topLeftCorner(size, size) = W(rows, rows);
        A.topRightCorner(size, m) = G(rows, Eigen::all);
        A.bottomLeftCorner(m, size) = A.topRightCorner(size, m).transpose();
        solver_.compute(A);
      }
      void solve(const Vector& u, const Vector& z, Vector& p, Vector& a) const override {
        Vector right(u.size() + z.size());
        right << u, z;
        const Vector x = solver_.solve(right);
        p = x.head(u.size());
        a = x.tail(z.size());
      }

     private:
      Eigen::PartialPivLU<Matrix> solver_;
    };
    ++times_;
    return std::make_unique<Held>(W_, G_, rows);
  }
  int times() const { return times_; }

 private:
  Matrix W_, G_;
  mutable int times_ = 0;
};

// Pairs open, stick and slip; in units in which W is a million times smaller as well, since the solver scales W.
TEST(HeldDirections, AgreeWithDenseOnes) {
  for (const bool floating : {false, true})
    for (const double unit : {1.0, 1e-6}) {
      constexpr int pairs = 150;
      Problem dense = floating ? plate_on_layer(pairs, 40.0) : test::layer_problem(pairs, 6, 0.5);
      dense.W = Delassus(Matrix(unit * dense.W.dense()));
      dense.q *= unit;
      const Solution direct = solve(dense);
      ASSERT_EQ(direct.status, Status::solved) << direct.reason;
      Problem held = dense;
      const auto holder = std::make_shared<const ByDense>(dense.W.dense(), dense.G.dense());
      const linalg::SparseMatrix unit_stiffness = [] {
        linalg::SparseMatrix one(2 * pairs, 2 * pairs);
        one.setIdentity();
        return one;
      }();
      const Eigen::SparseMatrix<double> root = Matrix(dense.W.dense().llt().matrixU()).sparseView();
      held.W =
          Delassus(std::make_shared<const linalg::SymmetricPositiveSolver>(unit_stiffness), root).with_holder(holder);
      ASSERT_FALSE(held.W.is_dense());
      const Solution solution = solve(held);
      ASSERT_EQ(solution.status, Status::solved) << solution.reason;
      EXPECT_GE(holder->times(), 2);
      EXPECT_LE(solution.iterations, 12);
      EXPECT_LT((solution.p - direct.p).lpNorm<Eigen::Infinity>(), 1e-8 * direct.p.lpNorm<Eigen::Infinity>());
    }
}

}  // namespace
}  // namespace scabo::contact
