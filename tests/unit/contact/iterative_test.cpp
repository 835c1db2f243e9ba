// Large problems whose W is known by its products alone: GMRES on the generalised Jacobian against dense LU.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/contact/kkt/gmres.hpp"
#include "scabo/contact/kkt/preconditioners.hpp"
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

// Tridiagonal, 2 and -1: the steps, and the one at which they end, do not depend on the units of the right-hand side.
TEST(Gmres, UnitsOfTheRightHandSideChangeNoBit) {
  const auto copy = [](const Vector& x, Vector& result) { result = x; };
  const auto multiply = [](const Vector& x, Vector& result) {
    result = 2.0 * x;
    result.head(x.size() - 1) -= x.tail(x.size() - 1);
    result.tail(x.size() - 1) -= x.head(x.size() - 1);
  };
  const Vector b = Vector::LinSpaced(20, 1.0, 3.0);
  Vector x = Vector::Zero(20), image;
  EXPECT_LE(gmres(multiply, copy, b, x, {}), 1e-11);
  multiply(x, image);
  EXPECT_LE((image - b).norm(), 1e-10 * b.norm());
  for (const double unit : {0x1p100, 0x1p-100, 0x1p37}) {
    Vector scaled = Vector::Zero(20);
    EXPECT_LE(gmres(multiply, copy, unit * b, scaled, {}), 1e-11) << unit;
    EXPECT_EQ(scaled, Vector(unit * x)) << unit;
  }
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

// Directions by halves of joints, from 1,200 unknowns on, with and without a free body: the forces are those that LU
// finds for the states of the pairs.
TEST(DirectionsAlongJoints, LeadToTheForcesThatLUFindsForTheirStates) {
  constexpr int pairs = 1400;
  constexpr double mu = 0.5;
  for (const bool floating : {false, true}) {
    Problem problem = floating ? plate_on_layer(pairs, 300.0) : test::layer_problem(pairs, 6, mu);
    problem.W = Delassus(problem.W.dense());
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::solved) << solution.reason;
    EXPECT_LE(solution.certificate.worst(), 1e-10);
    const Eigen::Index m = problem.G.cols(), n = 2 * pairs + m;
    Matrix A = Matrix::Zero(n, n);
    A.topLeftCorner(2 * pairs, 2 * pairs) = problem.W.matrix();
    A.topRightCorner(2 * pairs, m) = problem.G.dense();
    A.bottomLeftCorner(m, 2 * pairs) = problem.G.dense().transpose();
    Vector b(n);
    b << -problem.q, -problem.f;
    int unknowns = 0, slip = 0;
    const auto prescribe = [&](int row, double of_normal) {  // p_t = of_normal p_n, or p = 0
      A.row(row).setZero();
      A(row, row) = 1.0;
      if (of_normal != 0.0) A(row, row - 1) = -of_normal;
      b[row] = 0.0;
    };
    for (int i = 0; i < pairs; ++i) {
      const ContactState state = solution.states[static_cast<std::size_t>(i)];
      if (state == ContactState::open) prescribe(2 * i, 0.0), prescribe(2 * i + 1, 0.0);
      if (state == ContactState::slip) prescribe(2 * i + 1, solution.slip_increment[i] > 0.0 ? -mu : mu), ++slip;
      unknowns += state == ContactState::open ? 0 : state == ContactState::slip ? 1 : 2;
    }
    EXPECT_GT(unknowns, 1200);
    EXPECT_GT(slip, 50);
    const Vector by_lu = A.partialPivLu().solve(b);
    EXPECT_LT((by_lu.head(2 * pairs) - solution.p).lpNorm<Eigen::Infinity>(),
              1e-8 * solution.p.lpNorm<Eigen::Infinity>());
  }
}

TEST(DirectionsAlongJoints, HaveAPreconditionerThatIsNearlyTheInverse) {
  constexpr int pairs = 700;
  Problem problem = plate_on_layer(pairs, 200.0);
  problem.W = Delassus(problem.W.dense()).scaled(3.0);
  SaddleRows rows;  // the first half slips with 0.3, the second sticks, every seventh is open
  std::vector<Eigen::Triplet<double>> of_L, of_C;
  rows.resize(2 * pairs);
  int size = 0;
  const auto add = [&](int pair, int component, double scale, double slope) {
    rows.pair[static_cast<std::size_t>(size)] = pair;
    rows.L(component, size) = scale;
    rows.C(component, size) = 1.0;
    of_L.emplace_back(size, 2 * pair + component, scale);
    of_C.emplace_back(2 * pair + component, size, 1.0);
    if (slope > 0.0) rows.C(1, size) = slope, of_C.emplace_back(2 * pair + 1, size, slope);
    ++size;
  };
  for (int i = 0; i < pairs; ++i) {
    if (i % 7 == 0) continue;
    const bool slips = 2 * i < pairs;
    add(i, 0, 2.0, slips ? 0.3 : 0.0);
    if (!slips) add(i, 1, 1.5, 0.0);
  }
  rows.pair.resize(static_cast<std::size_t>(size));
  rows.D.setConstant(0.01);
  Eigen::SparseMatrix<double> L(size, 2 * pairs), C(2 * pairs, size);
  L.setFromTriplets(of_L.begin(), of_L.end());
  C.setFromTriplets(of_C.begin(), of_C.end());
  Matrix A = Matrix::Zero(size + 3, size + 3);
  A.topLeftCorner(size, size) = L * (3.0 * problem.W.matrix() * Matrix(C));
  A.diagonal().head(size).array() += 0.01;
  A.topRightCorner(size, 3) = L * problem.G.dense();
  A.bottomLeftCorner(3, size) = problem.G.dense().transpose() * C;
  LinePreconditioner preconditioner;
  ASSERT_TRUE(preconditioner.factorise(problem, rows));
  const Vector b = Vector::LinSpaced(size + 3, -1.0, 1.0), exact = A.partialPivLu().solve(b);
  Vector x;
  preconditioner.solve(b, x);
  EXPECT_LT((x - exact).norm(), 1e-5 * exact.norm());
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
  Matrix flexibility(const std::vector<int>& rows) const override { return W_(rows, rows); }
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
      held.W = Delassus(std::make_shared<const FactorisedPairs>(unit_stiffness, root, 2)).with_holder(holder);
      ASSERT_FALSE(held.W.is_dense());
      const Solution solution = solve(held);
      ASSERT_EQ(solution.status, Status::solved) << solution.reason;
      EXPECT_GE(holder->times(), 2);
      EXPECT_LT((solution.p - direct.p).lpNorm<Eigen::Infinity>(), 1e-8 * direct.p.lpNorm<Eigen::Infinity>());
    }
}

}  // namespace
}  // namespace scabo::contact
