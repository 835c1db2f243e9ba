// Bodies that contact alone holds, and pairs with cohesion and tension, by the solvers that handle them.
#include <gtest/gtest.h>

#include "problems.hpp"

namespace scabo::test {
namespace {

const Method with_both[] = {Method::newton_only, Method::alart_curnier, Method::tresca, Method::proximal_point};

TEST(FloatingBody, RestsOnItsPairs) {
  // Pressed down by 3 on three pairs, pulled along by 0.5 < mu 3: forces balance the loads.
  for (int d : {2, 3}) {
    std::mt19937 random(11);
    Problem problem = elastic_problem(random, d, 3, 0.4);
    problem.q.setZero();
    Matrix G = Matrix::Zero(3 * d, 2);
    for (int i = 0; i < 3; ++i) G(d * i, 0) = G(d * i + 1, 1) = 1.0;
    problem.G = G;
    problem.f = Vec2(-3.0, 0.5);
    std::vector<Method> methods(std::begin(with_both), std::end(with_both));
    methods.insert(methods.end(), {Method::fischer_burmeister, Method::trial_and_error});
    for (Method method : methods) {
      const Solution solution = compare::solve_with(method, problem);
      EXPECT_EQ(solution.status, Status::solved) << compare::method_name(method) << ": " << solution.reason;
      EXPECT_LT((problem.G.transpose() * solution.p + problem.f).norm(), 1e-9) << compare::method_name(method);
    }
  }
}

TEST(Strength, TensionHoldsToItsLimitAndCohesionAddsToFriction) {
  const Matrix W = Vec2(2.0, 1.0).asDiagonal();
  for (Method method : with_both) {
    const auto forces = [&](double q_n, double q_t) {
      Problem problem = one_pair(W, Vec2(q_n, q_t), 0.5);
      problem.cohesion = Vector::Constant(1, 0.3);
      problem.tension = Vector::Constant(1, 0.25);
      const Solution solution = compare::solve_with(method, problem);
      EXPECT_EQ(solution.status, Status::solved) << compare::method_name(method) << ": " << solution.reason;
      return solution.p;
    };
    EXPECT_LT((forces(0.4, 0.1) - Vec2(-0.2, -0.1)).norm(), 1e-9) << compare::method_name(method);   // held
    EXPECT_LT((forces(1.0, 0.1) - Vec2(-0.25, -0.1)).norm(), 1e-9) << compare::method_name(method);  // opens
    EXPECT_LT((forces(-4.0, 3.0) - Vec2(2.0, -1.3)).norm(), 1e-9) << compare::method_name(method);   // slips
  }
}

TEST(Strength, BondedPairIsAnEquation) {
  const Matrix W = Vec2(2.0, 1.0).asDiagonal();
  for (Method method : {Method::newton_only, Method::alart_curnier, Method::tresca, Method::proximal_point}) {
    Problem problem = one_pair(W, Vec2(4.0, 3.0), 0.0);
    problem.cohesion = Vector::Constant(1, 100.0);
    problem.tension = Vector::Constant(1, HUGE_VAL);
    const Solution solution = compare::solve_with(method, problem);
    EXPECT_EQ(solution.status, Status::solved) << compare::method_name(method) << ": " << solution.reason;
    EXPECT_LT((solution.p - Vec2(-2.0, -3.0)).norm(), 1e-9) << compare::method_name(method);
  }
}

}  // namespace
}  // namespace scabo::test
