// Closed form: a block on an incline slips exactly when tan(angle) > mu.
#include "incline.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

std::string with_friction(double mu) { return fmt::format("friction: {}", mu); }

class Incline : public testing::TestWithParam<double> {};

TEST_P(Incline, RestsBelowTheAngleOfFriction) {
  const double limit = std::tan(GetParam() * std::numbers::pi / 180.0);
  const auto solution = run(incline(GetParam(), with_friction(limit * (1.0 + 1e-6))));
  const analysis::ContactResult& contact = last(solution).contacts.front();
  EXPECT_NEAR(contact.tangential_force / contact.normal_force, -limit, 1e-9);
}

TEST_P(Incline, SlidesAboveTheAngleOfFriction) {
  const double limit = std::tan(GetParam() * std::numbers::pi / 180.0);
  const auto solution = run(incline(GetParam(), with_friction(limit * (1.0 - 1e-6))));
  EXPECT_EQ(solution.outcome, analysis::Outcome::mechanism);
  EXPECT_NE(solution.reason.find("mechanism: body 'block': translation along (1, 0)"), std::string::npos)
      << solution.reason;
}

INSTANTIATE_TEST_SUITE_P(Degrees, Incline, testing::Values(5.0, 17.0, 30.0, 44.0));

TEST(Incline, SteepPlaneTipsTheBlockBeforeItSlides) {
  // 2 x 1 m: it tips about its lower corner when tan(angle) > 2.
  EXPECT_EQ(run(incline(63.0, with_friction(2.0))).outcome, analysis::Outcome::solved);
  const auto tipped = run(incline(64.0, with_friction(2.5)));
  EXPECT_EQ(tipped.outcome, analysis::Outcome::mechanism);
  EXPECT_NE(tipped.reason.find("mechanism: body 'block': rotation about (2, "), std::string::npos) << tipped.reason;
}

}  // namespace
}  // namespace scabo::verification
