// W and q in other units, scaled by powers of two: every solver does the same, bit by bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "problems.hpp"

namespace scabo::test {
namespace {

Problem scaled(Problem problem, double of_W, double of_q) {
  problem.W = Matrix(of_W * problem.W.dense());
  problem.q *= of_q;
  problem.f *= of_q / of_W;
  problem.cohesion *= of_q / of_W;
  problem.tension *= of_q / of_W;
  return problem;
}

constexpr double large = 0x1p100, small = 0x1p-100;
constexpr double scales[][2] = {{large, 1.0}, {small, 1.0}, {1.0, large}, {1.0, small}, {small, large}, {large, small}};

void expect_same_bits(const Problem& problem, const std::vector<Method>& methods, contact::Judge judge) {
  contact::SolverOptions options;
  options.judge = judge;
  for (const Method method : methods) {
    const Solution first = compare::solve_with(method, problem, {}, options);
    for (const auto& [of_W, of_q] : scales) {
      SCOPED_TRACE(fmt::format("{}, {} pairs, W times {}, q times {}", compare::method_name(method), problem.pairs(),
                               of_W, of_q));
      const Solution other = compare::solve_with(method, scaled(problem, of_W, of_q), {}, options);
      EXPECT_EQ(other.status, first.status) << other.reason;
      EXPECT_EQ(other.iterations, first.iterations);
      EXPECT_EQ(other.states, first.states);
      EXPECT_EQ(other.p, Vector(of_q / of_W * first.p));
      EXPECT_EQ(other.a, Vector(of_q * first.a));
      EXPECT_EQ(other.gap, Vector(of_q * first.gap));
      EXPECT_EQ(other.natural_map_residual, first.natural_map_residual);
      EXPECT_EQ(other.certificate.worst(), first.certificate.worst());
    }
  }
}

std::vector<Method> of_this_library(std::vector<Method> methods) {
  std::erase_if(methods, [](Method method) { return method >= Method::siconos_nsgs; });  // not ours to scale
  return methods;
}

class PowersOfTwo : public testing::TestWithParam<contact::Judge> {};

TEST_P(PowersOfTwo, ChangeNoBitWithFriction) {
  std::mt19937 random(41);
  for (const int dimension : {2, 3})
    for (const int pairs : {1, 5, 12})
      for (const double mu : {0.2, 1.5})
        expect_same_bits(elastic_problem(random, dimension, pairs, mu), of_this_library(frictional_methods(dimension)),
                         GetParam());
}

// A body that contact alone holds, and pairs with strength; motions of the body scale with q.
TEST(RigidPowersOfTwo, ChangeNoBitOfWhatContactAloneHolds) {
  std::mt19937 random(42);
  for (const bool strength : {false, true}) {
    Problem problem = elastic_problem(random, 2, 8, 0.5);
    Matrix G = Matrix::Zero(16, 2);
    for (Eigen::Index i = 0; i < 16; ++i) G(i, i % 2) = 1.0;
    problem.G = G;
    problem.f = Vector::Zero(2);
    problem.f << -3.0, 0.7;
    std::vector<Method> methods = {Method::b_differentiable, Method::newton_only, Method::alart_curnier, Method::tresca,
                                   Method::proximal_point};
    if (strength) {
      problem.cohesion = Vector::Constant(8, 0.25);
      problem.tension = Vector::Constant(8, 0.125);
    } else {
      methods.push_back(Method::trial_and_error);
      methods.push_back(Method::fischer_burmeister);
    }
    expect_same_bits(problem, methods, contact::Judge::certificate);
  }
}

TEST_P(PowersOfTwo, ChangeNoBitWithoutFriction) {
  std::mt19937 random(43);
  for (const int dimension : {2, 3})
    expect_same_bits(elastic_problem(random, dimension, 9, 0.0), {Method::quadratic_programme}, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Judges, PowersOfTwo,
                         testing::Values(contact::Judge::certificate, contact::Judge::natural_map));

}  // namespace
}  // namespace scabo::test
