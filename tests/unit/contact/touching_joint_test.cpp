// A joint with cohesion that touches without pressure: neither in contact nor apart, and yet sheared.
#include <gtest/gtest.h>

#include "scabo/contact/laws/cohesive.hpp"
#include "scabo/contact/laws/coulomb.hpp"
#include "scabo/contact/laws/evolution.hpp"
#include "scabo/contact/laws/tresca.hpp"

namespace scabo::contact {
namespace {

constexpr double w = 0.01, area = 0.5, cohesion = 60.0, strength = cohesion * area;

/// One pair on springs of flexibility w that touches and is moved along itself until they pull by `shear`.
Evolution sheared(const std::shared_ptr<const Law>& law, double shear, int dimension = 2,
                  const PairHistory& history = {}) {
  Problem problem;
  problem.dimension = dimension;
  problem.W = Matrix(w * Matrix::Identity(dimension, dimension));
  problem.q = Vector::Zero(dimension);
  problem.q.tail(dimension - 1).setConstant(w * shear / std::sqrt(dimension - 1.0));
  problem.G.resize(dimension, 0);
  return evolve(problem, {{law}, Vector::Constant(1, area)}, {history}, {}, {});
}

std::shared_ptr<const Law> touching(double tension) {
  const std::shared_ptr<const Law> friction = std::make_shared<Coulomb>(0.3);
  return std::make_shared<Cohesive>(friction, cohesion, tension);
}

// Without pressure and without tensile strength the pair counts as open; at c A its joint breaks all the same, and
// with no pressure there is no friction left.
TEST(TouchingJoint, BreaksByShearAtItsCohesion) {
  for (const int dimension : {2, 3}) {
    const Evolution holds = sheared(touching(0.0), strength * (1.0 - 1e-6), dimension);
    ASSERT_EQ(holds.solution.status, Status::solved) << holds.solution.reason;
    EXPECT_NEAR(holds.solution.p.tail(dimension - 1).norm(), strength * (1.0 - 1e-6), 1e-9);
    EXPECT_FALSE(holds.history[0].broken);
    const double beyond = strength * (1.0 + 1e-6);
    const Evolution breaks = sheared(touching(0.0), beyond, dimension);
    ASSERT_EQ(breaks.solution.status, Status::solved) << breaks.solution.reason;
    EXPECT_TRUE(breaks.history[0].broken) << dimension;
    EXPECT_NEAR(breaks.solution.p.norm(), 0.0, 1e-9) << dimension;
    EXPECT_NEAR(breaks.solution.slip_increment.norm(), w * beyond, 1e-12) << dimension;
    // What is broken stays so, under less shear as well.
    const Evolution after = sheared(touching(0.0), 0.5 * strength, dimension, breaks.history[0]);
    EXPECT_NEAR(after.solution.p.norm(), 0.0, 1e-9) << dimension;
  }
}

TEST(TouchingJoint, WithTensileStrengthItBreaksAtTheSameShear) {
  for (const double factor : {1.0 - 1e-6, 1.0 + 1e-6})
    EXPECT_EQ(sheared(touching(20.0), strength * factor).history[0].broken, factor > 1.0);
}

// A prescribed bound of the shear is no strength that is lost.
TEST(TouchingJoint, APrescribedShearStrengthStays) {
  const Evolution slides = sheared(std::make_shared<Tresca>(cohesion), 2.0 * strength);
  ASSERT_EQ(slides.solution.status, Status::solved) << slides.solution.reason;
  EXPECT_NEAR(slides.solution.p[1], -strength, 1e-9);
  EXPECT_FALSE(slides.history[0].broken);
}

}  // namespace
}  // namespace scabo::contact
