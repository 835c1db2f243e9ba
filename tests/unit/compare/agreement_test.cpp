// Where the solution is unique, all solvers that report it as solved have it, and those that should not fail do not.
#include <gtest/gtest.h>

#include <map>

#include "problems.hpp"

namespace scabo::test {
namespace {

/// Failures of the solvers that may fail, of every 60: those without a line search, and Siconos's at our
/// tolerance.
const std::map<Method, int> may_fail = {{Method::trial_and_error, 10}, {Method::siconos_nsgs, 60},
                                        {Method::siconos_lemke, 60},   {Method::siconos_nsn_ac, 60},
                                        {Method::siconos_nsn_fb, 60},  {Method::newton_only, 6}};

void expect_agreement(int dimension, double mu, int cases) {
  std::mt19937 random(17);
  std::map<Method, int> failures;
  for (int k = 0; k < cases; ++k) {
    const Problem problem = elastic_problem(random, dimension, 1 + k % 12, mu);
    Vector reference;
    for (Method method : frictional_methods(dimension)) {
      const Solution solution = compare::solve_with(method, problem);
      if (solution.status != Status::solved) {
        EXPECT_FALSE(solution.reason.empty());
        ++failures[method];
        continue;
      }
      EXPECT_LT(solution.certificate.worst(), 1e-10);
      EXPECT_LT(solution.natural_map_residual, 1e-8) << compare::method_name(method);
      if (reference.size() == 0) reference = solution.p;
      EXPECT_LT((solution.p - reference).norm(), 1e-7 * (1.0 + reference.norm()))
          << compare::method_name(method) << ", problem " << k;
    }
  }
  for (const auto& [method, count] : failures) {
    const auto allowed = may_fail.find(method);
    EXPECT_LE(count, allowed == may_fail.end() ? 0 : allowed->second * cases / 60) << compare::method_name(method);
  }
}

TEST(AllSolvers, AgreeInThePlane) { expect_agreement(2, 0.2, 60); }
TEST(AllSolvers, AgreeInSpace) { expect_agreement(3, 0.2, 60); }
TEST(AllSolvers, AgreeWithoutFriction) {
  expect_agreement(2, 0.0, 30);
  expect_agreement(3, 0.0, 30);
}

TEST(QuadraticProgramme, IsTheFrictionlessSolution) {
  std::mt19937 random(5);
  for (int k = 0; k < 60; ++k) {
    const Problem problem = elastic_problem(random, 2 + k % 2, 1 + k, 0.0);
    const Solution exact = compare::solve_with(Method::quadratic_programme, problem);
    const Solution newton = compare::solve_with(Method::alart_curnier, problem);
    ASSERT_EQ(exact.status, Status::solved) << exact.reason;
    ASSERT_EQ(newton.status, Status::solved) << newton.reason;
    EXPECT_LT((exact.p - newton.p).norm(), 1e-8 * (1.0 + exact.p.norm()));
  }
}

TEST(Solvers, HaveNamesThatLeadBack) {
  for (const std::string& name : compare::method_names())
    EXPECT_EQ(compare::method_name(*compare::method_named(name)), name);
  EXPECT_FALSE(compare::method_named("magic"));
  EXPECT_EQ(compare::method_names().front(), "b_differentiable");
}

}  // namespace
}  // namespace scabo::test
