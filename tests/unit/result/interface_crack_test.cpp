// T-stress on either side of an interface crack, from the element to the summary and the log.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scabo/analysis/cracks.hpp"
#include "scabo/result/report.hpp"
#include "scabo/result/summary.hpp"
#include "theory/open_rings.hpp"

namespace scabo::result {
namespace {

using std::numbers::pi;

// The strain e along the crack is the same in both halves, and the stress E' e: 4 times as much above. Left of who
// walks from the mouth to the tip is above.
TEST(InterfaceCrack, HasItsTStressOnEitherSide) {
  const test::Kolosov above(4.0, 0.3, model::Plane::strain), below(1.0, 0.3, model::Plane::strain);
  const double e = 0.3;
  for (const double angle : {0.0, 2.0}) {
    const element::Ring ring = test::cracked_square(1, 12, angle);
    std::vector<element::Mat3> laws;
    for (const double at : test::middle_angles(ring))  // from the right face on
      laws.push_back(test::elasticity(at < pi ? 1.0 : 4.0, 0.3, model::Plane::strain));
    analysis::StaticSolution solution;
    model::Body body;
    body.name = "plate";
    body.cracks.push_back({"flaw", {0, 0}, {-1, 0}, {}});
    solution.model.bodies.push_back(body);
    auto made = std::make_shared<analysis::SolvedSuperElement>();
    made->ring = ring;
    made->sectors.D = element::Elasticity(laws);
    made->solution = element::solve_super_element(ring, made->sectors.D, 1.0);
    solution.super_elements.push_back(made);
    analysis::IncrementResult increment;
    increment.step = increment.increment = 1;
    increment.converged = true;
    increment.displacements = {test::around_tip(ring, [&](double r, double t) {
      return test::interface_crack(above, below, {1.0, 0.5}, 1.0, e, r, t);
    })};
    increment.interior.resize(1);
    increment.cracks = analysis::crack_results(solution, increment);
    solution.increments.push_back(increment);

    const nlohmann::json flaw =
        nlohmann::json::parse(summary_content(solution, {}, false))["increments"][0]["cracks"]["plate.flaw"];
    EXPECT_EQ(flaw["kind"], "interface_crack");
    const double left = 4.0 / 0.91 * e, right = 1.0 / 0.91 * e;
    EXPECT_NEAR(flaw["T_left"].get<double>(), left, 1e-8);
    EXPECT_NEAR(flaw["T_right"].get<double>(), right, 1e-8);
    EXPECT_FALSE(flaw.contains("T"));
    const std::string log = report_cracks(increment);
    EXPECT_NE(log.find("1.31868, 0.32967"), std::string::npos) << log;
  }
}

}  // namespace
}  // namespace scabo::result
