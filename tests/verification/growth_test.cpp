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
  }
  EXPECT_EQ(solution.grown->ended, "3 growth steps done");
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

// A crack that its load closes is no result.
TEST(Growth, AClosedCrackEndsTheRunWithASentence) {
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
