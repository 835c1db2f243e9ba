// The block of Raous, Chabrand and Lebon (SSNV128) with little and much friction, 32 to 256 pairs, finite elements and
// super-element: at most ten iterations, those on the problems of fewer pairs that make the start included; and its
// discrete problem with r over six decades: the same answer.
#include <fmt/format.h>

#include "models.hpp"
#include "run.hpp"
#include "scabo/contact/solve.hpp"

namespace scabo::verification {
namespace {

std::string block(int pairs, double friction, const char* kind) {
  return block_of_raous(fmt::format("size: {}, kind: {}", 0.08 / pairs, kind), friction);
}

struct Solved {
  analysis::StaticSolution solution;
  analysis::DiscreteProblem problem;
};

Solved solve_block(int pairs, double friction) {
  Solved result;
  analysis::Options options;
  options.on_problems = [&](const analysis::IncrementResult&, const std::vector<analysis::DiscreteProblem>& problems) {
    result.problem = problems.back();
  };
  result.solution =
      analysis::solve_static(input::parse_model(block(pairs, friction, "superelement"), "test.yaml", {}), options);
  last(result.solution);  // otherwise there is no problem to return
  return result;
}

class RaousFriction : public testing::TestWithParam<std::tuple<int, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Pairs, RaousFriction,
                         testing::Combine(testing::Values(32, 64, 128, 256), testing::Values("fem", "superelement")),
                         [](const auto& test) {
                           return fmt::format("{}_{}", std::get<0>(test.param), std::get<1>(test.param));
                         });

TEST_P(RaousFriction, IsSolvedAtOnce) {
  const auto [pairs, kind] = GetParam();
  for (double friction : {0.3, 1.0, 3.0}) {
    const auto solution = run(block(pairs, friction, kind));
    const auto& increment = last(solution);
    EXPECT_GE(static_cast<int>(increment.contacts.front().pairs.size()), pairs);
    EXPECT_EQ(increment.halvings, 0) << "mu " << friction;
  }
}

TEST(RaousProblem, TheSameAnswerWithROverSixDecades) {
  for (double friction : {0.3, 1.0, 3.0}) {
    const Solved solved = solve_block(64, friction);
    const contact::Problem& problem = solved.problem.problem;
    contact::SolverOptions options;
    options.force_scale = solved.problem.force_scale;
    const contact::Solution reference = contact::solve(problem, solved.problem.start, options);
    ASSERT_EQ(reference.status, contact::Status::solved) << reference.reason;
    for (double factor : {1e-3, 1e-2, 0.1, 10.0, 1e2, 1e3}) {
      options.r_factor = factor;
      const contact::Solution solution = contact::solve(problem, solved.problem.start, options);
      ASSERT_EQ(solution.status, contact::Status::solved) << "mu " << friction << ", r times " << factor;
      EXPECT_LT((solution.p - reference.p).cwiseAbs().maxCoeff(), 1e-9 * reference.p.cwiseAbs().maxCoeff())
          << "mu " << friction << ", r times " << factor;
    }
  }
}

}  // namespace
}  // namespace scabo::verification
