// Large problems whose W is known by its products alone: GMRES on the generalised Jacobian against dense LU.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scabo/contact/gmres.hpp"
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

}  // namespace
}  // namespace scabo::contact
