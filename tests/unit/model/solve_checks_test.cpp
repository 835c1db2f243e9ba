// The analysis refuses an invalid model, whoever built it.
#include <gtest/gtest.h>

#include "scabo/analysis/modal/modal_analysis.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "unit/model/models.hpp"

namespace scabo::analysis {
namespace {

template <typename Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SolveStatic, SolvesASoundModelBuiltInCode) {
  const StaticSolution solution = solve_static(test::whole_model());
  EXPECT_EQ(solution.outcome, Outcome::solved) << solution.reason;
  ASSERT_EQ(solution.increments.size(), 1u);
}

TEST(Analyses, RefuseAnInvalidModelWithItsPath) {
  model::Model model = test::whole_model();
  model.bodies[1].mesh.size = -1.0;
  const std::string expected = "model: bodies.upper.mesh.size: must be greater than 0, not -1";
  EXPECT_EQ(message_of([&] { check(model); }), expected);
  EXPECT_EQ(message_of([&] { solve_static(model); }), expected);
  model.analysis.type = model::AnalysisType::modal;
  EXPECT_EQ(message_of([&] { solve_modal(model); }), expected);
}

}  // namespace
}  // namespace scabo::analysis
