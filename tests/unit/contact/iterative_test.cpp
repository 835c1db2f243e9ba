// Large problems whose W is known by its products alone: GMRES on the generalised Jacobian against dense LU.
#include <gtest/gtest.h>

#include "scabo/contact/solve.hpp"
#include "unit/contact/layer.hpp"

namespace scabo::contact {
namespace {

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
