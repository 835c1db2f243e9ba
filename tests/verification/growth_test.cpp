// Cracks that grow: loads against closed forms, paths against their twins and against what was published.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/run.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

/// The increment with the state of growth `index`, from 0.
const analysis::GrowthResult& growth_at(const analysis::StaticSolution& solution, std::size_t index) {
  const auto& growth = increment_at(solution, index).growth;
  if (!growth) throw std::runtime_error("the increment has no growing crack");
  return *growth;
}

const std::vector<Vec2>& path_of(const analysis::StaticSolution& solution) {
  if (!solution.grown || solution.grown->paths.empty()) throw std::runtime_error("no crack has grown");
  return solution.grown->paths.front().points;
}

/// Work is stored, taken by contacts or released, to rounding.
void expect_balance(const analysis::GrowthEnergy& energy) {
  EXPECT_NEAR(energy.external - energy.elastic - energy.contact - energy.released, 0.0,
              1e-9 * (std::abs(energy.external) + std::abs(energy.elastic)));
}

// Double cantilever under moments M at the ends of its arms, of height h: G = 12 M^2 / (E' h^3) per unit width, at any
// length, so that the moment at which the crack grows is (E' G_c h^3 / 12)^1/2. The crack goes straight on.
TEST(Growth, ADoubleCantileverUnderEndMoments) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  beam:
    material: steel
    shape: {polygon: {vertices: [[0, -1], [12, -1], [12, 1], [0, 1], [0, 0]]}}
    mesh: {kind: quadtree, size: 0.25, order: 3}
    cracks: [{path: [[0, 0], [4, 0]], name: flaw}]
supports: [{on: beam.vertex_2, fix: [x, y]}, {on: beam.vertex_3, fix: [x]}]
loads:
  upper: {on: beam.edge_4, moment: -1e3}
  lower: {on: beam.edge_5, moment: 1e3}
steps: [{growth: {toughness: {G_c: 10}, step: 0.5, until: {steps: 3}}}]
)");
  ASSERT_EQ(last(solution).increment, 4);
  const double moment = std::sqrt(200e9 / (1.0 - 0.09) * 10.0 / 12.0);
  for (std::size_t k = 0; k < 4; ++k) {
    const analysis::GrowthResult& at = growth_at(solution, k);
    EXPECT_NEAR(at.load_factor * 1e3 / moment, 1.0, 1e-3);
    EXPECT_NEAR(at.tips.at(0).length, 4.0 + 0.5 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(at.tips[0].G.value(), 10.0, 1e-3);
    EXPECT_NEAR(at.tips[0].kink, 0.0, 1e-4);
    if (k == 0) continue;
    ASSERT_TRUE(at.energy.has_value());  // 5 = 10 over a length of 0.5
    EXPECT_NEAR(at.energy->released, 5.0, 5e-3);
    EXPECT_NEAR(at.energy->integral, 5.0, 5e-3);
    expect_balance(*at.energy);
  }
  EXPECT_EQ(solution.grown->ended, "3 growth steps done");
}

/// The double cantilever opened by end forces P, cells of `size`: the load at which it grows from 4.
double end_force(double size) {
  return growth_at(run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 200e9, poisson: 0.3}}}}
bodies:
  beam:
    material: steel
    shape: {{polygon: {{vertices: [[0, -1], [12, -1], [12, 1], [0, 1], [0, 0]]}}}}
    mesh: {{kind: quadtree, size: {}, order: 3}}
    cracks: [{{path: [[0, 0], [4, 0]], name: flaw}}]
supports: [{{on: beam.vertex_2, fix: [x, y]}}, {{on: beam.vertex_3, fix: [x]}}]
loads:
  upper: {{on: beam.edge_4, traction: [0, 1e3]}}
  lower: {{on: beam.edge_5, traction: [0, -1e3]}}
steps: [{{growth: {{toughness: {{G_c: 10}}, step: 0.5, until: {{steps: 1}}}}}}]
)",
                                   size)),
                   1)
      .load_factor;
}

TEST(Growth, ADoubleCantileverUnderEndForcesAndTwiceAsFine) {
  EXPECT_NEAR(end_force(0.25) / end_force(0.125), 1.0, 5e-3);
}

// Central crack under remote tension, in a plate 100 times as wide: both tips are critical at once and grow together,
// at sigma = K_Ic / (pi a)^1/2 with a half of the length.
TEST(Growth, BothTipsOfACentralCrackGrowStraight) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: stress}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  plate:
    material: steel
    shape: {rectangle: {corner: [-100, -100], size: [200, 200]}}
    mesh: {kind: quadtree, size: 20, order: 3}
    cracks: [{path: [[-1, 0], [1, 0]], name: flaw}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads:
  up: {on: plate.top, traction: [0, 1e6]}
  down: {on: plate.bottom, traction: [0, -1e6]}
steps: [{growth: {toughness: {K_Ic: 2e6}, step: 0.2, until: {length: 2.6}}}]
)");
  ASSERT_EQ(last(solution).increment, 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const double a = 1.0 + 0.1 * static_cast<double>(k);
    const analysis::GrowthResult& at = growth_at(solution, k);
    EXPECT_NEAR(at.load_factor * 1e6 * std::sqrt(pi * a) / 2e6, 1.0, 1e-3);
    ASSERT_EQ(at.tips.size(), 2u);
    EXPECT_TRUE(at.tips[0].grows && at.tips[1].grows);
  }
  const std::vector<Vec2>& path = path_of(solution);
  EXPECT_NEAR((path.front() - Vec2(-1.3, 0)).norm(), 0.0, 1e-4);
  EXPECT_NEAR((path.back() - Vec2(1.3, 0)).norm(), 0.0, 1e-4);
}

// The same crack opened by water of the same pressure on its faces, which follows it: the same factors.
TEST(Growth, PressureFollowsTheCrack) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: stress}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  plate:
    material: steel
    shape: {rectangle: {corner: [-100, -100], size: [200, 200]}}
    mesh: {kind: quadtree, size: 20, order: 3}
    cracks: [{path: [[-1, 0], [1, 0]], name: flaw}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads:
  left: {on: plate.flaw.left, pressure: 1e6}
  right: {on: plate.flaw.right, pressure: 1e6}
steps: [{growth: {toughness: {K_Ic: 2e6}, step: 0.2, until: {length: 2.6}}}]
)");
  ASSERT_EQ(last(solution).increment, 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const double a = 1.0 + 0.1 * static_cast<double>(k);
    EXPECT_NEAR(growth_at(solution, k).load_factor * 1e6 * std::sqrt(pi * a) / 2e6, 1.0, 1e-3);
  }
}

// Water in a vertical crack, its surface 3 above the middle: K_I at the lower end is (pi a)^1/2 g (depth of the middle
// + a / 2). The crack grows down, and the water follows.
TEST(Growth, WaterFollowsTheCrackDown) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: stress}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  plate:
    material: steel
    shape: {rectangle: {corner: [-100, -100], size: [200, 200]}}
    mesh: {kind: quadtree, size: 20, order: 2}
    cracks: [{path: [[0, 1], [0, -1]], name: flaw}]
contacts: {faces: {between: [plate.flaw.left, plate.flaw.right], friction: 0.5}}
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads: {water: {in: faces, water: {level: 3, unit_weight: 1e4}}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.4, until: {steps: 1}}}]
)");
  ASSERT_EQ(last(solution).increment, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const double a = 1.0 + 0.2 * static_cast<double>(k), depth = 2.0 + a;
    const analysis::GrowthResult& at = growth_at(solution, k);
    EXPECT_NEAR(at.load_factor * std::sqrt(pi * a) * 1e4 * (depth + 0.5 * a) / 1e6, 1.0, 2e-3);
    EXPECT_TRUE(!at.tips.at(0).grows && at.tips.at(1).grows);
    EXPECT_NEAR(at.tips[0].load_factor / at.load_factor, (depth + 0.5 * a) / (depth - 0.5 * a), 5e-3);
  }
  expect_balance(growth_at(solution, 1).energy.value());
}

/// An inclined edge crack under tension; `sign`: mirrored at x = 0; lengths in metres times `length`, forces in newtons
/// times `force`.
analysis::StaticSolution inclined(double sign, double length, double force, const std::string& criterion) {
  const double stress = force / (length * length);
  const auto point = [&](double x, double y) { return fmt::format("[{}, {}]", sign * x * length, y * length); };
  return run(fmt::format(
      R"(scabo: 1
analysis: {{plane: strain, thickness: {}}}
materials: {{stone: {{young: {}, poisson: 0.2}}}}
bodies:
  plate:
    material: stone
    shape: {{rectangle: {{corner: {}, size: [{}, {}]}}}}
    mesh: {{kind: quadtree, size: {}}}
    cracks: [{{path: [{}, {}], name: flaw}}]
supports: [{{on: plate.bottom, fix: [x, y]}}]
loads: {{pull: {{on: plate.top, traction: [0, {}]}}}}
steps: [{{growth: {{criterion: {}, toughness: {{K_Ic: {}}}, step: {}, until: {{steps: 3}}}}}}]
)",
      length, 30e9 * stress, sign > 0.0 ? "[0, 0]" : fmt::format("[{}, 0]", -length), length, 2.0 * length,
      0.125 * length, point(0, 0.8), point(0.25, 1.0), 1e6 * stress, criterion, 1e6 * stress * std::sqrt(length),
      0.125 * length));
}

TEST(Growth, MirroredAndInOtherUnitsThePathIsTheSame) {
  for (const char* criterion : {"hoop_stress", "energy_release", "strain_energy_density", "zero_K_II"}) {
    const auto first = inclined(1.0, 1.0, 1.0, criterion), mirrored = inclined(-1.0, 1.0, 1.0, criterion),
               other = inclined(1.0, 1e3, 1e-3, criterion);
    const std::vector<Vec2>& path = path_of(first);
    ASSERT_EQ(path.size(), 5u);
    EXPECT_GT(std::abs(growth_at(first, 0).tips[0].kink), 0.1);
    ASSERT_EQ(path_of(mirrored).size(), 5u);
    ASSERT_EQ(path_of(other).size(), 5u);
    for (std::size_t k = 0; k < path.size(); ++k) {
      EXPECT_NEAR((path_of(mirrored)[k] - Vec2(-path[k].x(), path[k].y())).norm(), 0.0, 1e-6);
      EXPECT_NEAR((path_of(other)[k] / 1e3 - path[k]).norm(), 0.0, 1e-6);
    }
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(growth_at(other, k).load_factor / growth_at(first, k).load_factor, 1.0, 1e-6);
  }
}

/// The same crack for 0.25 on, of step `step`; `turned`: everything by 90 degrees counter-clockwise, (x, y) -> (-y, x).
std::vector<Vec2> inclined_for_a_quarter(const std::string& mesh, double step, bool turned = false) {
  const auto solution = run(fmt::format(
      R"(scabo: 1
analysis: {{plane: strain}}
materials: {{stone: {{young: 30e9, poisson: 0.2}}}}
bodies:
  plate:
    material: stone
    shape: {{rectangle: {{corner: {}, size: {}}}}}
    mesh: {{{}}}
    cracks: [{{path: {}, name: flaw}}]
supports: [{{on: plate.{}, fix: [x, y]}}]
loads: {{pull: {{on: plate.{}, traction: {}}}}}
steps: [{{growth: {{toughness: {{K_Ic: 1e6}}, step: {}, until: {{steps: {}}}}}}}]
)",
      turned ? "[-2, 0]" : "[0, 0]", turned ? "[2, 1]" : "[1, 2]", mesh,
      turned ? "[[-0.8, 0], [-1, 0.25]]" : "[[0, 0.8], [0.25, 1]]", turned ? "right" : "bottom",
      turned ? "left" : "top", turned ? "[-1e6, 0]" : "[0, 1e6]", step, std::lround(0.25 / step)));
  last(solution);
  return path_of(solution);
}

TEST(Growth, TurnedByNinetyDegreesThePathIsTheSame) {
  const auto path = inclined_for_a_quarter("kind: quadtree, size: 0.125", 0.125),
             other = inclined_for_a_quarter("kind: quadtree, size: 0.125", 0.125, true);
  ASSERT_EQ(path.size(), other.size());
  for (std::size_t k = 0; k < path.size(); ++k)
    EXPECT_NEAR((other[k] - Vec2(-path[k].y(), path[k].x())).norm(), 0.0, 1e-6);
}

// Within a tenth of a step.
TEST(Growth, ByPolygonsOrFinerOrWithHalfTheStepThePathIsTheSame) {
  const Vec2 end = inclined_for_a_quarter("kind: quadtree, size: 0.125", 0.125).back();
  EXPECT_NEAR((inclined_for_a_quarter("kind: polygons, size: 0.125", 0.125).back() - end).norm(), 0.0, 0.0125);
  EXPECT_NEAR((inclined_for_a_quarter("kind: quadtree, size: 0.0625", 0.125).back() - end).norm(), 0.0, 0.0125);
  EXPECT_NEAR((inclined_for_a_quarter("kind: quadtree, size: 0.125", 0.0625).back() - end).norm(), 0.0, 0.0125);
}

// Two cracks beside each other under tension: their inner tips first turn away from each other, and where they have
// passed, towards the other crack. By symmetry one path is the other, turned by half a turn.
TEST(Growth, TwoCracksPassEachOtherAndHook) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: stress}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  plate:
    material: steel
    shape: {rectangle: {corner: [-10, -10], size: [20, 20]}}
    mesh: {kind: quadtree, size: 2}
    cracks: [{path: [[-2.2, -0.2], [-0.4, -0.2]], name: left}, {path: [[0.4, 0.2], [2.2, 0.2]], name: right}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads: {up: {on: plate.top, traction: [0, 1e6]}, down: {on: plate.bottom, traction: [0, -1e6]}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.2, cracks: [plate.left.end, plate.right.start], until: {steps: 8}}}]
)");
  last(solution);
  const std::vector<Vec2>&left = solution.grown->paths.at(0).points, &right = solution.grown->paths.at(1).points;
  ASSERT_EQ(left.size(), 10u);
  ASSERT_EQ(right.size(), 10u);
  double lowest = 0.0;
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR((left[k] + right[9 - k]).norm(), 0.0, 1e-4);
    if (left[k].x() < 0.0) lowest = std::min(lowest, left[k].y());
  }
  EXPECT_LT(lowest, -0.205);
  EXPECT_GT(left.back().y(), -0.1);
}

// Two cracks that share every step reach the length that is wanted in whole steps.
TEST(Growth, TwoCracksReachTheirLengthTogether) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2}}
bodies:
  strip:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [2, 2]}}
    mesh: {kind: quadtree, size: 0.25}
    cracks: [{path: [[0, 1], [0.25, 1]], name: left}, {path: [[2, 1], [1.75, 1]], name: right}]
supports: [{on: strip.bottom, fix: [y]}, {on: strip.bottom_left, fix: [x]}]
loads: {pull: {on: strip.top, traction: [0, 1e6]}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.2, until: {length: 0.5}}}]
)");
  ASSERT_EQ(last(solution).increment, 4);
  for (const analysis::TipResult& tip : growth_at(solution, 3).tips) EXPECT_NEAR(tip.length, 0.5, 1e-9);
}

// Loads that stay: under a tension that stays and one that is scaled, on the same edge, their sum is that of the scaled
// one alone.
TEST(Growth, LoadsThatStayCount) {
  const auto load = [](const std::string& loads, const std::string& steps, std::size_t increment) {
    return growth_at(run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{stone: {{young: 30e9, poisson: 0.2}}}}
bodies:
  plate:
    material: stone
    shape: {{rectangle: {{corner: [0, 0], size: [1, 2]}}}}
    mesh: {{kind: quadtree, size: 0.125}}
    cracks: [{{path: [[0, 0.8], [0.25, 1]], name: flaw}}]
supports: [{{on: plate.bottom, fix: [x, y]}}]
loads: {}
steps: {}
)",
                                     loads, steps)),
                     increment)
        .load_factor;
  };
  const std::string pull = "{pull: {on: plate.top, traction: [0, 1e6]}",
                    growth = "growth: {toughness: {K_Ic: 2e6}, step: 0.125, until: {steps: 1}}";
  const double alone = load(pull + "}", "[{" + growth + "}]", 0);
  const double rest = load(pull + ", stays: {on: plate.top, traction: [0, 2e5]}}",
                           "[{loads: {stays: 1}}, {loads: {pull: 1}, " + growth + "}]", 1);
  EXPECT_NEAR(rest + 0.2, alone, 1e-9 * alone);
}

/// An inclined crack at the middle of a wide plate under compression along y, friction 0.3: K_II = 0.35 sqrt(pi) at
/// unit stress, by the stress on its line.
analysis::StaticSolution closed_crack(const std::string& growth) {
  return run(fmt::format(R"(scabo: 1
analysis: {{plane: stress}}
materials: {{stone: {{young: 200, poisson: 0.3}}}}
bodies:
  plate:
    material: stone
    shape: {{rectangle: {{corner: [-50, -50], size: [100, 100]}}}}
    mesh: {{kind: quadtree, size: 10, order: 2, refine: [{{near: [0.7, 0.7], size: 0.025}}, {{near: [-0.7, -0.7], size: 0.025}}]}}
    cracks: [{{path: [[-0.70710678118654752, -0.70710678118654752], [0.70710678118654752, 0.70710678118654752]], name: flaw}}]
contacts: {{faces: {{between: [plate.flaw.left, plate.flaw.right], friction: 0.3}}}}
supports: [{{on: plate.bottom_left, fix: [x, y]}}, {{on: plate.bottom_right, fix: [y]}}]
loads:
  up: {{on: plate.top, traction: [0, -1]}}
  down: {{on: plate.bottom, traction: [0, 1]}}
steps: [{{growth: {{{}}}}}]
)",
                         growth));
}
const double K_II_of_closed_crack = 0.35 * std::sqrt(pi);

// Wing cracks: the tips of a closed crack that slides are in pure mode II, and kink by 70.5 degrees of the hoop stress,
// at K_II = (3/4)^1/2 K_Ic. The wings need more load the longer they are, and turn towards it.
TEST(Growth, AClosedCrackGrowsWings) {
  const auto solution = closed_crack("toughness: {K_Ic: 1}, step: 0.1, until: {steps: 2}");
  ASSERT_EQ(last(solution).increment, 3);
  const analysis::GrowthResult& first = growth_at(solution, 0);
  ASSERT_EQ(first.tips.size(), 2u);
  EXPECT_NEAR(first.load_factor * K_II_of_closed_crack / std::sqrt(0.75), 1.0, 2e-3);
  for (const analysis::TipResult& tip : first.tips) {
    EXPECT_TRUE(tip.grows);
    EXPECT_NEAR(tip.kink * 180.0 / pi, 70.5288, 0.1);
    EXPECT_NEAR(tip.K_I, 0.0, 1e-3);
  }
  EXPECT_GT(growth_at(solution, 1).load_factor, 1.1 * first.load_factor);
  EXPECT_GT(growth_at(solution, 2).load_factor, 1.1 * growth_at(solution, 1).load_factor);
  const std::vector<Vec2>& path = path_of(solution);
  ASSERT_EQ(path.size(), 6u);
  const auto from_load = [&](std::size_t k) {  // angle of a segment from the y axis
    const Vec2 along = path[k + 1] - path[k];
    return std::atan2(std::abs(along.x()), along.y());
  };
  EXPECT_LT(from_load(4), 0.9 * from_load(3));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((path[k] + path[5 - k]).norm(), 0.0, 1e-3);
  for (const std::size_t k : {1u, 2u}) {
    const analysis::GrowthResult& at = growth_at(solution, k);
    for (const analysis::TipResult& tip : at.tips) EXPECT_LT(std::abs(tip.K_II), 0.05 * tip.K_I);
    ASSERT_TRUE(at.energy.has_value());
    expect_balance(*at.energy);
    EXPECT_NEAR(at.energy->released / at.energy->integral, 1.0, 0.015);
    const double friction = increment_at(solution, k).energy.friction - increment_at(solution, k - 1).energy.friction;
    EXPECT_GT(friction, 0.0);
    EXPECT_NEAR(at.energy->contact / friction, 1.0, 0.02);
  }
}

// In shear, where the criterion says so: straight on at G = G_c.
TEST(Growth, AClosedCrackGrowsInShear) {
  const auto solution = closed_crack("criterion: straight, toughness: {G_c: 0.005}, step: 0.4, until: {steps: 1}");
  ASSERT_EQ(last(solution).increment, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const double a = 1.0 + 0.2 * static_cast<double>(k);
    EXPECT_NEAR(growth_at(solution, k).load_factor * K_II_of_closed_crack * std::sqrt(a), 1.0, 2e-3);
  }
  EXPECT_NEAR((path_of(solution).back() - Vec2::Constant(1.2 * std::sqrt(0.5))).norm(), 0.0, 1e-9);
}

// A crack whose faces stick has no factors, whatever the load.
TEST(Growth, AClosedCrackThatSticksDoesNotGrow) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2}}
bodies:
  plate:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [1, 2]}}
    mesh: {kind: quadtree, size: 0.25}
    cracks: [{path: [[0, 0.8], [0.25, 1]], name: flaw}]
contacts: {faces: {between: [plate.flaw.left, plate.flaw.right], friction: 2}}
supports: [{on: plate.bottom, fix: [x, y]}]
loads: {push: {on: plate.top, traction: [0, -1e6]}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.125}}]
)");
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("no factor of the scaled loads makes a tip critical"), std::string::npos)
      << solution.reason;
}

// A crack that runs through its body ends the run, broken; one that ends in a hole leaves the body in one piece.
TEST(Growth, ABodyThatIsSplitIsBroken) {
  const auto through = [](const std::string& holes) {
    return run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{stone: {{young: 30e9, poisson: 0.2}}}}
bodies:
  strip:
    material: stone
    shape: {{rectangle: {{corner: [0, 0], size: [1, 2]}}}}
    {}
    mesh: {{kind: quadtree, size: 0.25}}
    cracks: [{{path: [[0, 1], [0.4, 1]], name: flaw}}]
supports: [{{on: strip.bottom, fix: [y]}}, {{on: strip.bottom_left, fix: [x]}}]
loads: {{pull: {{on: strip.top, traction: [0, 1e6]}}}}
steps: [{{growth: {{toughness: {{K_Ic: 1e6}}, step: 0.2}}}}]
)",
                           holes));
  };
  const auto whole = through(""), hollow = through("holes: {bore: {circle: {centre: [0.75, 1], radius: 0.1}}}");
  ASSERT_TRUE(whole.grown && hollow.grown);
  EXPECT_TRUE(whole.grown->broken);
  EXPECT_EQ(path_of(whole).back().x(), 1.0);
  EXPECT_NE(whole.grown->ended.find("meets edge 'right' at"), std::string::npos) << whole.grown->ended;
  EXPECT_FALSE(hollow.grown->broken);
  EXPECT_NE(hollow.grown->ended.find("meets edge 'bore'"), std::string::npos) << hollow.grown->ended;
}

// A crack that its load closes is no result.
TEST(Growth, AClosedCrackWithoutContactEndsTheRunWithASentence) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2}}
bodies:
  plate:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [1, 2]}}
    mesh: {kind: quadtree, size: 0.125}
    cracks: [{path: [[0, 0.8], [0.25, 1]], name: flaw}]
supports: [{on: plate.bottom, fix: [x, y]}]
loads: {push: {on: plate.top, traction: [0, -1e6]}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.125}}]
)");
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("close the crack at its tip 'plate.flaw.end'"), std::string::npos) << solution.reason;
}

// A crack through a bent plate, open at its growing end and overlapping at the other.
TEST(Growth, FacesThatOverlapElsewhereEndTheRunWithASentence) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2}}
bodies:
  plate:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [4, 1]}}
    mesh: {kind: quadtree, size: 0.25}
    cracks: [{path: [[2, 0.2], [2, 0.85]], name: flaw}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads: {left: {on: plate.left, moment: 1e3}, right: {on: plate.right, moment: -1e3}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.05, cracks: [plate.flaw.end]}}]
)");
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("the faces of crack 'plate.flaw' overlap by"), std::string::npos) << solution.reason;
}

/// An edge crack of length 0.2 in a strip under cycles of tension, and what else the growth says.
analysis::StaticSolution cycled(const std::string& growth, const std::string& more = "") {
  return run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 200e9, poisson: 0.3}}}}
bodies:
  strip:
    material: steel
    shape: {{rectangle: {{corner: [0, 0], size: [1, 3]}}}}
    mesh: {{kind: quadtree, size: 0.25, order: 3}}
    cracks: [{{path: [[0, 1.5], [0.2, 1.5]], name: flaw}}]
supports: [{{on: strip.bottom, fix: [y]}}, {{on: strip.bottom_left, fix: [x]}}]
loads: {{pull: {{on: strip.top, traction: [0, 50e6]}}{}}}
steps: [{{growth: {{{}}}}}]
)",
                         more, growth));
}

// Life of an edge crack by Paris' law against Simpson's rule over every second state, from the ranges that the run
// reports.
TEST(FatigueGrowth, LifeIsTheIntegralOverTheRangesOfTheRun) {
  const double C = 1e-29, m = 3.0, step = 0.02;
  const auto solution =
      cycled("law: paris, C: 1e-29, m: 3, between: [{pull: 0.1}, {pull: 1}], step: 0.02, until: {length: 0.4}");
  last(solution);
  ASSERT_EQ(solution.increments.size(), 11u);
  double life = 0.0;
  for (std::size_t k = 0; k + 2 < 11; k += 2) {
    const auto slowness = [&](std::size_t i) {
      return 1.0 / (C * std::pow(growth_at(solution, i).tips.at(0).range.value(), m));
    };
    life += 2.0 * step / 6.0 * (slowness(k) + 4.0 * slowness(k + 1) + slowness(k + 2));
  }
  EXPECT_NEAR(growth_at(solution, 10).cycles.value() / life, 1.0, 1e-3);
  const analysis::TipResult& first = growth_at(solution, 0).tips[0];
  EXPECT_NEAR(first.range.value() / (0.9 * first.K_I), 1.0, 1e-9);
  EXPECT_EQ(growth_at(solution, 0).cycles.value(), 0.0);
}

// 105,199.70 cycles (VERIFICATION: Paris' law in the infinite plate, a from 10 to 20 mm, range 100 MPa).
TEST(FatigueGrowth, ACentralCrackByParis) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: stress}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  plate:
    material: steel
    shape: {rectangle: {corner: [-2, -2], size: [4, 4]}}
    mesh: {kind: quadtree, size: 0.4, order: 3}
    cracks: [{path: [[-0.01, 0], [0.01, 0]], name: flaw}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads:
  up: {on: plate.top, traction: [0, 100e6]}
  down: {on: plate.bottom, traction: [0, -100e6]}
steps: [{growth: {law: paris, C: 1e-29, m: 3, between: [{up: 0, down: 0}, {up: 1, down: 1}], step: 2e-3,
         until: {length: 0.04}}}]
)");
  last(solution);
  EXPECT_NEAR(growth_at(solution, solution.increments.size() - 1).cycles.value() / 105199.70, 1.0, 1e-3);
}

TEST(FatigueGrowth, ABreakEndsIt) {
  const auto solution = cycled(
      "law: walker, C: 1e-29, m: 3, gamma: 0.5, between: [{pull: 0.5}, {pull: 1}], step: 0.05, toughness: {K_Ic: "
      "100e6}");
  last(solution);
  EXPECT_NE(solution.grown->ended.find("the body breaks at 'strip.flaw.end' after"), std::string::npos)
      << solution.grown->ended;
}

TEST(FatigueGrowth, CyclesThatNoLawKnowsEndTheRunWithASentence) {
  const std::string law = "law: paris, C: 1e-29, m: 3, step: 0.02, until: {steps: 1}, between: ";
  const auto reason = [&](const std::string& between, const std::string& more = "") {
    const auto solution = cycled(law + between, more);
    EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
    return solution.reason;
  };
  EXPECT_NE(reason("[{pull: 1}, {pull: 0.1}]").find("exchange the two"), std::string::npos);
  EXPECT_NE(reason("[{pull: -0.5}, {pull: 1}]").find("overlap by"), std::string::npos);
  EXPECT_NE(reason("[{pull: 0.5, drag: 0}, {pull: 1, drag: 1}]", ", drag: {on: strip.top, traction: [20e6, 0]}")
                .find("turns within a cycle"),
            std::string::npos);
}

// Bittencourt, Wawrzynek, Ingraffea, Sousa (1996): beam of 20 x 8 with three holes of radius .25 in three-point
// bending. From a notch 1 deep at 6 from the middle the crack passes the lowest hole and ends in the middle one.
TEST(Growth, TheBeamOfBittencourt) {
  const auto solution = run(R"(scabo: 1
analysis: {plane: strain}
materials: {plexiglas: {young: 29e6, poisson: 0.3}}
bodies:
  beam:
    material: plexiglas
    shape: {polygon: {vertices: [[-10,0],[-9,0],[9,0],[10,0],[10,8],[0,8],[-10,8]]}}
    holes:
      low: {circle: {centre: [-4, 2.75], radius: 0.25}}
      mid: {circle: {centre: [-4, 4.75], radius: 0.25}}
      top: {circle: {centre: [-4, 6.75], radius: 0.25}}
    mesh: {kind: quadtree, size: 0.6, refine: [{on: low, size: 0.12}, {on: mid, size: 0.12}]}
    cracks: [{path: [[-6, 0], [-6, 1]], name: notch}]
supports: [{on: beam.vertex_2, fix: [x, y]}, {on: beam.vertex_3, fix: [y]}]
loads: {P: {on: beam.vertex_6, force: [0, -1]}}
steps: [{growth: {toughness: {K_Ic: 1000}, step: 0.3}}]
)");
  last(solution);
  EXPECT_LT(solution.grown->ended.find("meets edge 'mid'"), 100u) << solution.grown->ended;
  const std::vector<Vec2>& path = path_of(solution);
  ASSERT_EQ(path.size(), 16u);  // 13 steps, and the point on the hole
  // With quarter steps, on another mesh:
  const Vec2 finer[] = {{-5.5022, 2.4109}, {-5.0634, 3.1963}, {-4.6109, 3.9741}};
  const std::size_t points[] = {6, 9, 12};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((path[points[k]] - finer[k]).norm(), 0.0, 0.01);
}

}  // namespace
}  // namespace scabo::verification
