// The plot of the iterations: a picture whatever the numbers, and never larger than a browser likes.
#include "scabo/result/convergence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace scabo::result {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<contact::Iteration> falling(int count) {
  std::vector<contact::Iteration> iterations;
  double residual = 1.0;
  for (int k = 0; k <= count; ++k, residual *= 1e-3)
    iterations.push_back({k, residual, residual * residual, 1.0, 2, "newton"});
  return iterations;
}

std::size_t number_of(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(ConvergencePlot, OneCurveForEachAttemptWithItsName) {
  const std::string plot =
      convergence_plot({{"press 1", falling(4), true}, {"press 2", falling(6), true}}, "Beam <& \"joint\">", 1e-10);
  EXPECT_EQ(number_of(plot, "<polyline"), 2u);
  EXPECT_EQ(number_of(plot, "<circle"), 12u);
  for (const char* word : {"press 1", "press 2", "tolerance", "Beam &lt;&amp; &quot;joint&quot;&gt;"})
    EXPECT_THAT(plot, HasSubstr(word));
  EXPECT_THAT(plot, Not(HasSubstr("stroke-dasharray=\"5 3\"")));
  EXPECT_THAT(plot, HasSubstr(std::string(convergence_plot_mark)));
}

TEST(ConvergencePlot, StagesOfASingleCurveAreNamed) {
  auto iterations = falling(3);
  iterations[2].stage = iterations[3].stage = "gauss_seidel";
  const std::string plot = convergence_plot({{"b_differentiable", iterations, false}}, "", 1e-10);
  EXPECT_THAT(plot, HasSubstr(">newton<"));
  EXPECT_THAT(plot, HasSubstr(">gauss_seidel<"));
  EXPECT_THAT(plot, HasSubstr("stroke-dasharray=\"5 3\""));
}

/// Stages that begin at the same point, as problems of fewer pairs do: one name above the other.
TEST(ConvergencePlot, NamesOfStagesDoNotCoverEachOther) {
  std::vector<contact::Iteration> iterations = {
      {0, 1e-2, 0.0, 0.0, 0, "first"}, {0, 1.1e-2, 0.0, 0.0, 0, "second"}, {0, 0.9e-2, 0.0, 0.0, 0, "third"}};
  const std::string plot = convergence_plot({{"", iterations, true}}, "", 1e-10);
  std::vector<double> heights;
  for (const char* name : {">first<", ">second<", ">third<"}) {
    const std::size_t end = plot.find(name), begin = plot.rfind(" y=\"", end) + 4;
    ASSERT_NE(end, std::string::npos);
    for (double before : heights) EXPECT_GE(std::abs(before - std::stod(plot.substr(begin))), 11.0) << name;
    heights.push_back(std::stod(plot.substr(begin)));
  }
}

TEST(ConvergencePlot, ProblemsOfFewerPairsAreHollowPointsAndExplained) {
  auto iterations = falling(4);
  iterations[0].stage = iterations[1].stage = "newton, 17 pairs";
  const std::string plot = convergence_plot({{"press 1", iterations, true}, {"press 2", falling(2), true}}, "", 1e-10);
  EXPECT_EQ(number_of(plot, "<circle class=\"coarse\""), 3u);  // and the one beside the explanation
  EXPECT_EQ(number_of(plot, "<circle"), 9u);
  EXPECT_THAT(plot, HasSubstr("coarse problem"));
  EXPECT_THAT(convergence_plot({{"press 1", falling(4), true}}, "", 1e-10), Not(HasSubstr("coarse problem")));
}

TEST(ConvergencePlot, OddNumbersStayInsideTheFrame) {
  std::vector<contact::Iteration> odd;
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double residual : {infinity, -infinity, std::nan(""), 0.0, 1e-300, 1e300, 1.0})
    odd.push_back({static_cast<int>(odd.size()), residual, 0.0, 1.0, 0, "newton"});
  const std::string plot = convergence_plot({{"odd", odd, true}, {"none", {}, true}}, "", 1e-10);
  EXPECT_THAT(plot, Not(HasSubstr("nan")));
  EXPECT_THAT(plot, Not(HasSubstr("inf")));
  EXPECT_THAT(convergence_plot(std::vector<ConvergenceCurve>{}, "", 1e-10), HasSubstr("</svg>"));
}

TEST(ConvergencePlot, ThousandsOfIncrementsStaySmall) {
  std::vector<ConvergenceCurve> curves;
  for (int k = 0; k < 5000; ++k) curves.push_back({"press " + std::to_string(k), falling(8), k != 1234});
  const std::string plot = convergence_plot(curves, "", 1e-10);
  EXPECT_LT(plot.size(), 100'000u);
  EXPECT_THAT(plot, HasSubstr("press 1234"));  // the one that did not converge
  EXPECT_THAT(plot, HasSubstr("press 4999"));
  EXPECT_THAT(plot, HasSubstr("more are not drawn"));
}

// A joint that breaks is solved again within the increment: another line, not one that leaps back up.
TEST(ConvergencePlot, EveryStartHasALineOfItsOwn) {
  auto iterations = falling(3);
  for (contact::Iteration at : falling(2)) at.iteration += 3, iterations.push_back(at);
  const std::string plot = convergence_plot({{"press 1", iterations, true}}, "", 1e-10);
  EXPECT_EQ(number_of(plot, "<polyline"), 2u);
  EXPECT_EQ(number_of(plot, "<circle"), 7u);
}

TEST(ConvergencePlot, NamesOfManyFailedAttemptsStayInThePicture) {
  std::vector<ConvergenceCurve> curves;
  for (int k = 0; k < 50; ++k) curves.push_back({"press 1, attempt " + std::to_string(k), falling(3), false});
  const std::string plot = convergence_plot(curves, "", 1e-10);
  EXPECT_LE(number_of(plot, ">press 1, attempt") - 50u, 19u);  // 50 are tool tips
  EXPECT_THAT(plot, HasSubstr("31 more without name"));
  EXPECT_THAT(plot, HasSubstr(">press 1, attempt 49</text>"));
}

TEST(ConvergenceTable, OneLineForEachIterationOfEachAttempt) {
  analysis::IncrementResult increment;
  increment.step = 2;
  increment.increment = 3;
  increment.attempts = {{{{1, 0.5, 0.25, 0.125, 4, "newton"}}, false},
                        {{{1, 1e-12, 0.0, 1.0, 0, "newton, \"soft\""}}, true}};
  EXPECT_EQ(convergence_table_rows(increment),
            "2,3,1,1,newton,0.5,0.25,0.125,4\n2,3,2,1,\"newton, \"\"soft\"\"\",1e-12,0,1,0\n");
  EXPECT_EQ(convergence_table_header,
            "step,increment,attempt,iteration,stage,residual,merit,step_length,states_changed\n");
}

}  // namespace
}  // namespace scabo::result
