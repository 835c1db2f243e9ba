// One pair, by hand: open, stick, slip, in the plane and in space; every solver must find it.
#include <gtest/gtest.h>

#include "problems.hpp"

namespace scabo::test {
namespace {

class OnePair : public testing::TestWithParam<int> {
 protected:
  /// W = diag(2, 1[, 1]), q = [q_n, q_t along a fixed direction].
  Problem problem(double q_n, double q_t, double mu) const {
    const int d = GetParam();
    Matrix W = Matrix::Identity(d, d);
    W(0, 0) = 2.0;
    Vector q = Vector::Zero(d);
    q[0] = q_n;
    q.tail(d - 1) = q_t * direction();
    return one_pair(W, q, mu);
  }
  Vector direction() const { return GetParam() == 2 ? Vector(Vector::Ones(1)) : Vector(Vec2(0.6, -0.8)); }
  void expect(const Problem& given, double p_n, double p_t) const {
    Vector p(GetParam());
    p << p_n, p_t * direction();
    for (Method method : frictional_methods(GetParam())) {
      if (method == Method::siconos_nsn_fb && given.mu[0] == 0.0)
        continue;  // its Jacobian is singular without friction
      const Solution solution = compare::solve_with(method, given);
      EXPECT_EQ(solution.status, Status::solved) << compare::method_name(method) << ": " << solution.reason;
      EXPECT_LT((solution.p - p).norm(), 1e-10) << compare::method_name(method);
      EXPECT_LT(solution.natural_map_residual, 1e-10) << compare::method_name(method);
    }
  }
};

TEST_P(OnePair, IsOpenWhereItsGapStaysPositive) { expect(problem(1.0, 3.0, 0.5), 0.0, 0.0); }
TEST_P(OnePair, SticksBelowTheBound) { expect(problem(-4.0, 0.5, 0.5), 2.0, -0.5); }  // p = -W^-1 q
TEST_P(OnePair, SlipsAtTheBoundAgainstTheMotion) { expect(problem(-4.0, 3.0, 0.5), 2.0, -1.0); }
TEST_P(OnePair, TouchesWithoutForce) { expect(problem(0.0, 0.0, 0.5), 0.0, 0.0); }
TEST_P(OnePair, HasNormalForceAloneWithoutFriction) {
  const Problem given = problem(-4.0, 3.0, 0.0);
  expect(given, 2.0, 0.0);
  const Solution solution = compare::solve_with(Method::quadratic_programme, given);
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_DOUBLE_EQ(solution.p[0], 2.0);
}

INSTANTIATE_TEST_SUITE_P(PlaneAndSpace, OnePair, testing::Values(2, 3));

TEST(OnePairInSpace, SlipsSidewaysWhereNormalAndTangentAreCoupled) {
  // p_t turns away from q_t: checked against the law, not a formula.
  Matrix W(3, 3);
  W << 2.0, 0.5, -0.3, 0.5, 1.5, 0.4, -0.3, 0.4, 1.0;
  const Problem given = one_pair(W, Eigen::Vector3d(-3.0, 1.0, 2.0), 0.3);
  for (Method method : frictional_methods(3)) {
    const Solution solution = compare::solve_with(method, given);
    ASSERT_EQ(solution.status, Status::solved) << compare::method_name(method) << ": " << solution.reason;
    const Vector u = W * solution.p + given.q;
    const Vec2 p_t = solution.p.tail<2>(), u_t = u.tail<2>();
    EXPECT_NEAR(u[0], 0.0, 1e-10);
    EXPECT_NEAR(p_t.norm(), 0.3 * solution.p[0], 1e-10);
    EXPECT_NEAR(p_t.dot(u_t), -p_t.norm() * u_t.norm(), 1e-9) << compare::method_name(method);
  }
}

}  // namespace
}  // namespace scabo::test
