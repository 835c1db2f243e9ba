// Cracks that grow: loads against closed forms, paths against their twins and against what was published.
#include "growth.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scabo/result/report.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

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

/// The double cantilever opened by end forces, cells of `size`.
std::string end_forces(double size, const std::string& growth) {
  return fmt::format(R"(scabo: 1
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
steps: [{{growth: {{toughness: {{G_c: 10}}, {}}}}}]
)",
                     size, growth);
}

/// The load at which it grows from 4.
double end_force(double size) {
  return growth_at(run(end_forces(size, "step: 0.5, until: {steps: 1}")), 1).load_factor;
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
  EXPECT_EQ(result::report_growth(solution),
            "Growth is unstable under a given load in increments 1 to 3: the next one needs less\n"
            "Several tips are critical at once in increments 1 to 3: they grow together, the symmetric one of several "
            "ways\nGrowth ended: the crack of 'plate.flaw.start' has the length 2.6\n");
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
    mesh: {kind: quadtree, size: 20, order: 3}
    cracks: [{path: [[0, 1], [0, -1]], name: flaw}]
contacts: {faces: {between: [plate.flaw.left, plate.flaw.right], friction: 0.5}}
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads: {water: {in: faces, water: {level: 3, unit_weight: 1e4}}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.4, until: {steps: 2}}}]
)");
  ASSERT_EQ(last(solution).increment, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = 1.0 + 0.2 * static_cast<double>(k), depth = 2.0 + a;
    const analysis::GrowthResult& at = growth_at(solution, k);
    EXPECT_NEAR(at.load_factor * std::sqrt(pi * a) * 1e4 * (depth + 0.5 * a) / 1e6, 1.0, 2e-3);
    EXPECT_TRUE(!at.tips.at(0).grows && at.tips.at(1).grows);
    EXPECT_NEAR(at.tips[0].load_factor / at.load_factor, (depth + 0.5 * a) / (depth - 0.5 * a), 5e-3);
    if (k == 0) continue;
    // The pressure also opens the faces beside the old tip against each other:
    const analysis::GrowthEnergy& energy = at.energy.value();
    expect_balance(energy);
    EXPECT_NEAR(energy.released / energy.integral, 1.0, 4e-3);
  }
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

// What growth releases by the energies of the body, between the old and the new tip on one mesh, is the integral of G
// by the factors of the tips; behind the kink their difference falls faster than with the square of the step. What the
// new mesh takes before is less than that.
TEST(Growth, ReleasedIsTheIntegralOfG) {
  std::vector<double> differences;
  for (const double step : {0.16, 0.08, 0.04}) {
    const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{stone: {{young: 30e9, poisson: 0.2}}}}
bodies:
  plate:
    material: stone
    shape: {{rectangle: {{corner: [0, 0], size: [1, 2]}}}}
    mesh: {{kind: quadtree, size: 0.25, order: 4}}
    cracks: [{{path: [[0, 0.8], [0.25, 1]], name: flaw}}]
supports: [{{on: plate.bottom, fix: [x, y]}}]
loads: {{pull: {{on: plate.top, traction: [0, 1e6]}}}}
steps: [{{growth: {{toughness: {{K_Ic: 1e6}}, step: {}, until: {{steps: 2}}}}}}]
)",
                                          step));
    last(solution);
    const analysis::GrowthEnergy& energy = growth_at(solution, 2).energy.value();
    expect_balance(energy);
    differences.push_back(std::abs(energy.released / energy.integral - 1.0));
    EXPECT_LT(std::abs(energy.remeshing / energy.integral), 1e-5);
  }
  EXPECT_LT(differences[0], 5e-3);
  EXPECT_LT(differences[1], differences[0] / 4.0);
  EXPECT_LT(differences[2], differences[1] / 4.0);
  EXPECT_LT(differences[2], 2e-5);
}

// A double cantilever under end forces that grows by a fiftieth of its crack: both to 1e-3 of each other, and what the
// new mesh takes below that.
TEST(Growth, ReleasedOverAFiftiethOfTheCrack) {
  const auto solution = run(end_forces(0.25, "step: 0.08, until: {steps: 3}"));
  ASSERT_EQ(last(solution).increment, 4);
  for (std::size_t k = 1; k < 4; ++k) {
    const analysis::GrowthEnergy& energy = growth_at(solution, k).energy.value();
    EXPECT_NEAR(energy.released / energy.integral, 1.0, 1e-3);
    EXPECT_NEAR(energy.released / 0.8, 1.0, 0.02);  // G_c da under the load that grows it, which falls
    EXPECT_LT(std::abs(energy.remeshing / energy.integral), 1e-3);
    expect_balance(energy);
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

// Within a tenth of a step; polygons also turned.
TEST(Growth, ByPolygonsOrFinerOrWithHalfTheStepThePathIsTheSame) {
  const Vec2 end = inclined_for_a_quarter("kind: quadtree, size: 0.125", 0.125).back();
  EXPECT_NEAR((inclined_for_a_quarter("kind: polygons, size: 0.125", 0.125).back() - end).norm(), 0.0, 0.0125);
  const Vec2 turned = inclined_for_a_quarter("kind: polygons, size: 0.125", 0.125, true).back();
  EXPECT_NEAR((turned - Vec2(-end.y(), end.x())).norm(), 0.0, 0.0125);
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

// Two cracks that face each other, one in a region of the same stiffness that resists twice as much: it waits, and
// would be critical at twice the load.
TEST(Growth, EveryMaterialHasItsToughness) {
  for (const char* weak : {"stone: 1e6, core: 2e6", "stone: 2e6, core: 1e6"}) {
    const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{stone: {{young: 30e9, poisson: 0.2}}, core: {{young: 30e9, poisson: 0.2}}}}
bodies:
  strip:
    material: stone
    shape: {{rectangle: {{corner: [0, 0], size: [2, 2]}}}}
    regions: {{right: {{material: core, shape: {{rectangle: {{corner: [1, 0], size: [1, 2]}}}}}}}}
    mesh: {{kind: quadtree, size: 0.25}}
    cracks: [{{path: [[0, 1], [0.25, 1]], name: left}}, {{path: [[2, 1], [1.75, 1]], name: right}}]
supports: [{{on: strip.bottom, fix: [y]}}, {{on: strip.bottom_left, fix: [x]}}]
loads: {{pull: {{on: strip.top, traction: [0, 1e6]}}}}
steps: [{{growth: {{toughness: {{K_Ic: {{{}}}}}, step: 0.1, until: {{steps: 1}}}}}}]
)",
                                          weak));
    ASSERT_EQ(last(solution).increment, 2);
    const analysis::GrowthResult& first = growth_at(solution, 0);
    const std::size_t leads = weak == std::string("stone: 1e6, core: 2e6") ? 0 : 1;
    EXPECT_TRUE(first.tips.at(leads).grows && !first.tips.at(1 - leads).grows);
    EXPECT_NEAR(first.tips[1 - leads].load_factor / first.load_factor, 2.0, 1e-3);
    EXPECT_NEAR(growth_at(solution, 1).tips[leads].length, 0.35, 1e-12);
  }
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

/// Two edge cracks towards a bore, in a strip whose top is moved.
analysis::StaticSolution towards_a_bore(const std::string& until, const std::string& conditions) {
  return run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{stone: {{young: 30e9, poisson: 0.2}}}}
bodies:
  strip:
    material: stone
    shape: {{rectangle: {{corner: [0, 0], size: [1, 2]}}}}
    holes: {{bore: {{circle: {{centre: [0.55, 1], radius: 0.1}}}}}}
    mesh: {{kind: quadtree, size: 0.25}}
    cracks: [{{path: [[0, 1], [0.3, 1]], name: left}}, {{path: [[1, 1], [0.85, 1]], name: right}}]
{}
steps: [{{growth: {{toughness: {{K_Ic: 1e6}}, step: 0.05, until: {{{}}}}}}}]
)",
                         conditions, until));
}

// Until it breaks: where one crack has met the bore, the other one goes on, with more load, until the strip is in two.
TEST(Growth, OneCrackGoesOnWhereTheOtherHasEnded) {
  const std::string moved =
      "supports: [{on: strip.bottom, fix: [y]}, {on: strip.bottom_left, fix: [x]}, {on: strip.top, displacement: "
      "[null, 1e-4], name: pull}]";
  const auto one = towards_a_bore("", moved), all = towards_a_bore("break: true", moved);
  last(one), last(all);
  EXPECT_FALSE(one.grown->broken);
  EXPECT_TRUE(all.grown->broken);
  ASSERT_EQ(all.grown->paths.size(), 2u);
  EXPECT_NEAR(all.grown->paths[0].points.back().x(), 0.45, 1e-6);
  EXPECT_NEAR(all.grown->paths[1].points.back().x(), 0.65, 1e-6);
  const std::size_t met = one.increments.size() - 1;
  ASSERT_GT(all.increments.size(), met + 2);
  EXPECT_TRUE(growth_at(all, met).tips.at(0).meets.has_value());
  ASSERT_EQ(growth_at(all, met + 1).tips.size(), 1u);
  EXPECT_EQ(growth_at(all, met + 1).tips[0].name, "strip.right.end");
  EXPECT_GT(growth_at(all, met + 1).load_factor, 1.5 * growth_at(all, met).load_factor);
  EXPECT_FALSE(growth_at(all, met + 1).energy.has_value());
  EXPECT_TRUE(growth_at(all, met + 2).energy.has_value());
}

// The area under the load over its displacement is the work of the load; of the reaction of a support that moves, over
// its displacement.
TEST(Growth, LoadAndDisplacementEncloseTheWork) {
  const auto pulled = towards_a_bore("load_factor: 1e-9",
                                     "supports: [{on: strip.bottom, fix: [x, y]}]\nloads: {pull: "
                                     "{on: strip.top, traction: [0, 1e6]}}");
  last(pulled);
  const analysis::GrowthResult& first = growth_at(pulled, 0);
  ASSERT_TRUE(first.displacement && !first.reaction);
  EXPECT_NEAR(0.5 * first.load_factor * *first.displacement / increment_at(pulled, 0).energy.elastic, 1.0, 1e-9);
  EXPECT_GT(first.tips.at(1).opening, 0.0);
  EXPECT_LT(first.tips[1].opening, first.tips[0].opening);
  const auto moved = towards_a_bore("steps: 1",
                                    "supports: [{on: strip.bottom, fix: [x, y]}, {on: strip.top, "
                                    "displacement: [null, 1e-4], name: pull}]");
  last(moved);
  const analysis::GrowthResult& at = growth_at(moved, 1);
  ASSERT_TRUE(at.reaction && !at.displacement);
  EXPECT_NEAR(0.5 * at.load_factor * *at.reaction / increment_at(moved, 1).energy.elastic, 1.0, 1e-9);
}

}  // namespace
}  // namespace scabo::verification
