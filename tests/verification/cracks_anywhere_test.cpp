// Cracks in bodies of polygons and of quadtrees, and other published numbers on meshes of many cells. Cracks of more
// shapes: crack_paths_test.cpp.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "scabo/base/error.hpp"
#include "verification/models.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

const double degree = std::numbers::pi / 180.0;

class CracksAnywhere : public testing::TestWithParam<const char*> {
 protected:
  std::string kind() const { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Kinds, CracksAnywhere, testing::Values("polygons", "quadtree"),
                         [](const auto& kind) { return std::string(kind.param); });

// Plate with a crack from its edge, h/W = 1, a/W = 1/2: 2.82546 (docs/verification.md). What counts is the order, not
// how small the cell at the tip is.
TEST_P(CracksAnywhere, SingleEdgeCrack) {
  for (const auto& [order, size, bound] :
       {std::tuple(2, 0.1, 1e-3), std::tuple(4, 0.25, 1e-5), std::tuple(8, 0.25, 1e-5)}) {
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{steel: {{young: 200, poisson: 0.3}}}}
bodies:
  plate:
    material: steel
    shape: {{rectangle: {{corner: [0, -1], size: [1, 2]}}}}
    cracks: [{{name: flaw, path: [[0, 0], [0.5, 0]]}}]
    mesh: {{kind: {}, size: {}, order: {}}}
supports: [{{on: plate.bottom_left, fix: [x, y]}}, {{on: plate.bottom_right, fix: [y]}}]
loads: {{up: {{on: plate.top, traction: [0, 1]}}, down: {{on: plate.bottom, traction: [0, -1]}}}}
)",
                                          kind(), size, order));
    const element::StressIntensity& tip = factors_at(last(solution), "plate.flaw.end");
    const double exact = 2.82546 * std::sqrt(0.5 * std::numbers::pi);
    EXPECT_NEAR(tip.K_I / exact, 1.0, bound) << "order " << order;
    EXPECT_NEAR(tip.K_II / exact, 0.0, bound) << "order " << order;
  }
}

/// Of half width 100 under tension along y, and `sideways` along x.
std::string wide_plate(const std::string& kind, const std::string& cracks, const std::string& refine, double sideways,
                       const std::string& more = "") {
  return CrackedPlate{.kind = kind, .xx = sideways, .cracks = cracks, .refine = refine, .body = more}.text();
}

// K_I = sigma sqrt(pi a) cos^2 b, K_II = sigma sqrt(pi a) sin b cos b; the finite width adds 1.4e-4.
TEST_P(CracksAnywhere, InclinedCrackInAWidePlate) {
  for (const double angle : {30.0, 60.0}) {
    const double c = std::cos(angle * degree), s = std::sin(angle * degree);
    const auto solution = run(
        wide_plate(kind(), fmt::format("{{name: flaw, path: [[{0}, {1}], [{2}, {3}]]}}", -c, -s, c, s),
                   fmt::format("{{near: [{0}, {1}], size: 0.3}}, {{near: [{2}, {3}], size: 0.3}}", -c, -s, c, s), 0.0));
    for (const char* end : {"plate.flaw.start", "plate.flaw.end"}) {
      const element::StressIntensity& tip = factors_at(last(solution), end);
      EXPECT_NEAR(tip.K_I, std::sqrt(std::numbers::pi) * c * c, 3e-4);
      EXPECT_NEAR(tip.K_II, std::sqrt(std::numbers::pi) * s * c, 3e-4);
    }
  }
}

// Two cracks of length 2 that cross, under tension from all sides: 0.8636 sqrt(pi) (Rooke, Sneddon 1969).
TEST_P(CracksAnywhere, CracksThatCross) {
  const auto solution =
      run(wide_plate(kind(), "{name: h, path: [[-1, 0], [1, 0]]}, {name: v, path: [[0, -1], [0, 1]]}",
                     "{near: [-1, 0], size: 0.2}, {near: [1, 0], size: 0.2}, {near: [0, 1], size: 0.2}, "
                     "{near: [0, -1], size: 0.2}",
                     1.0));
  ASSERT_EQ(last(solution).cracks.size(), 4);
  for (const analysis::CrackResult& tip : last(solution).cracks) {
    EXPECT_NEAR(tip.factors.K_I / std::sqrt(std::numbers::pi), 0.8636, 2e-4) << tip.name;
    EXPECT_NEAR(tip.factors.K_II, 0.0, 1e-5) << tip.name;
  }
}

// A short kink at the end of a crack under tension from all sides, for which T = 0: K_I = F_11 sqrt(pi), K_II = F_21
// sqrt(pi), with the series in the angle m (over pi) of Amestoy, Leblond, Int. J. Solids Struct. 29 (1992) 465-501. A
// kink of 1e-3 of the half length adds about 5e-4, the plate 1.4e-4.
TEST_P(CracksAnywhere, KinkAtTheEndOfACrack) {
  const double pi = std::numbers::pi, length = 1e-3;
  for (const double angle : {15.0, 45.0, 70.0}) {
    const double m = angle / 180.0, s = m * m;
    const double first =
        1.0 + s * (-3.0 * std::pow(pi, 2) / 8.0 +
                   s * (std::pow(pi, 2) - 5.0 * std::pow(pi, 4) / 128.0 +
                        s * (std::pow(pi, 2) / 9.0 - 11.0 * std::pow(pi, 4) / 72.0 + 119.0 * std::pow(pi, 6) / 15360.0 +
                             s * (5.07790 + s * (-2.88312 + s * (-0.0925 + s * (2.996 - s * 4.059)))))));
    const double second =
        m * (pi / 2.0 + s * (-4.0 * pi / 3.0 - std::pow(pi, 3) / 48.0 +
                             s * (-2.0 * pi / 3.0 + 13.0 * std::pow(pi, 3) / 30.0 - 59.0 * std::pow(pi, 5) / 3840.0 +
                                  s * (-6.176023 + s * (4.44112 + s * (-1.5340 + s * (-2.0700 + s * 4.684)))))));
    const double x = 1.0 + length * std::cos(angle * degree), y = length * std::sin(angle * degree);
    const auto solution = run(wide_plate(
        kind(), fmt::format("{{name: flaw, path: [[-1, 0], [1, 0], [{}, {}]]}}", x, y),
        fmt::format("{{near: [-1, 0], size: 0.3}}, {{near: [1, 0], size: {0}}}, {{near: [{1}, {2}], size: {0}}}",
                    0.3 * length, x, y),
        1.0));
    const element::StressIntensity& tip = factors_at(last(solution), "plate.flaw.end");
    std::cout << kind() << ", kink of " << angle << " degrees, " << 2 * solution.mesh.nodes()
              << " dofs: " << tip.K_I / std::sqrt(pi) - first << ", " << tip.K_II / std::sqrt(pi) - second << "\n";
    EXPECT_NEAR(tip.K_I / std::sqrt(pi), first, 1e-3) << angle;
    EXPECT_NEAR(tip.K_II / std::sqrt(pi), second, 1e-3) << angle;
  }
}

// Three branches of length 1 under tension from all sides: equal factors, pure mode I, and J from the whole field is G.
TEST_P(CracksAnywhere, StarOfThreeBranches) {
  const double h = std::sqrt(0.75);
  std::string refine = "{near: [0, 0], size: 0.1}";
  for (const auto& [x, y] : {std::pair(0.0, 1.0), std::pair(h, -0.5), std::pair(-h, -0.5)})
    refine += fmt::format(", {{near: [{}, {}], size: 0.1}}", x, y);
  const auto solution = run(wide_plate(
      kind(),
      fmt::format("{{name: bent, path: [[0, 1], [0, 0], [{0}, -0.5]]}}, {{name: branch, path: [[0, 0], [-{0}, -0.5]]}}",
                  h),
      refine, 1.0));
  ASSERT_EQ(last(solution).cracks.size(), 3);
  const double K = last(solution).cracks[0].factors.K_I;
  std::cout << kind() << ", star: " << K / std::sqrt(std::numbers::pi) << "\n";
  for (const analysis::CrackResult& tip : last(solution).cracks) {
    EXPECT_NEAR(tip.factors.K_I / K, 1.0, 1e-6) << tip.name;
    EXPECT_NEAR(tip.factors.K_II / K, 0.0, 1e-6) << tip.name;
    ASSERT_TRUE(tip.factors.J.has_value() && tip.factors.G.has_value());
    EXPECT_NEAR(*tip.factors.J / *tip.factors.G, 1.0, 1e-5) << tip.name;
  }
}

// A crack through the border of a region of the same material is a crack in one material.
TEST_P(CracksAnywhere, ThroughTheBorderOfARegion) {
  const auto solution = run(wide_plate(
      kind(), "{name: flaw, path: [[-1, 0], [1, 0]]}", "{near: [-1, 0], size: 0.3}, {near: [1, 0], size: 0.3}", 0.0,
      "regions: {core: {material: steel, shape: {circle: {centre: [-0.6, 0.3], radius: 0.8}}}}"));
  for (const char* end : {"plate.flaw.start", "plate.flaw.end"}) {
    EXPECT_NEAR(factors_at(last(solution), end).K_I, std::sqrt(std::numbers::pi), 3e-4);
    EXPECT_NEAR(factors_at(last(solution), end).K_II, 0.0, 1e-5);
  }
}

// L-shaped body, re-entrant corner at the origin; energy by one super-element with that corner as its scaling centre,
// order 14 and 16: 4.98789291788. Cells near the corner are as small as `refine` says, on straight edges of any length.
TEST_P(CracksAnywhere, CellsNearAPointReachTheirSize) {
  const auto error = [&](double size) {
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{steel: {{young: 1, poisson: 0.3}}}}
bodies:
  body:
    material: steel
    shape: {{polygon: {{vertices: [[0, 0], [0, -1], [1, -1], [1, 1], [-1, 1], [-1, 0]]}}}}
    mesh: {{kind: {}, order: 4, size: 0.125, refine: [{{near: [0, 0], size: {}}}]}}
supports: [{{on: body.edge_5, fix: x}}, {{on: body.edge_2, fix: y}}]
loads: {{right: {{on: body.edge_3, traction: [1, 0]}}, up: {{on: body.edge_4, traction: [0, 0.5]}}}}
)",
                                          kind(), size));
    return std::sqrt(std::abs(last(solution).energy.elastic / 4.98789291788 - 1.0));
  };
  EXPECT_LT(error(1e-4), 1.5e-3);
  EXPECT_LT(error(1e-8), 2e-5);
}

// A crack from side to side leaves two bodies.
TEST_P(CracksAnywhere, ThatDivideTheirBodyAreRefused) {
  const auto message_of = [&](const char* path) {
    try {
      run(wide_plate(kind(), fmt::format("{{name: flaw, path: {}}}", path), "", 0.0));
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
    return std::string("no error");
  };
  for (const char* path : {"[[-100, 0], [100, 0]]", "[[-50, 0], [50, 0], [0, 50], [-50, 0]]"})
    EXPECT_THAT(message_of(path), testing::HasSubstr("divide body 'plate' into 2 pieces")) << path;
}

// NAFEMS CGS-4: a block drawn over a wedge of tan(alpha) = 0.1 with mu = 0.3 needs (tan a + mu) / (1 - mu tan a) of its
// weight, over meshes that do not match.
TEST(ManyCellsInContact, FrictionPatch) {
  for (const auto& [wedge, block] : {std::pair("kind: polygons, size: 0.2", "kind: polygons, size: 0.17"),
                                     std::pair("kind: quadtree, size: 0.2, order: 3", "kind: polygons, size: 0.17"),
                                     std::pair("kind: fem, size: 0.3", "kind: quadtree, size: 0.2, order: 1")}) {
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{steel: {{young: 206e3, poisson: 0.3}}}}
bodies:
  wedge: {{material: steel, shape: {{polygon: {{vertices: [[0, -1], [6, -1], [6, 0.6], [0, 0]]}}}}, mesh: {{{}}}}}
  block: {{material: steel, shape: {{polygon: {{vertices: [[1, 0.1], [5, 0.5], [5, 2.5], [1, 2.1]]}}}}, mesh: {{{}}}}}
supports: [{{on: wedge.edge_1, fix: [x, y]}}, {{on: block.edge_2, displacement: [0.001, null], name: pull}}]
loads: {{weight: {{on: block, body_force: [0, -2]}}}}
contacts: {{joint: {{between: [wedge.edge_3, block.edge_1], friction: 0.3}}}}
steps: [{{loads: {{weight: 1}}}}, {{loads: {{pull: 1}}}}, {{loads: {{pull: 5}}}}]
)",
                                          wedge, block));
    EXPECT_NEAR(last(solution).reactions[1].x() / 16.0, 0.4 / 0.97, 1e-10);
  }
}

// The double cantilever beam as two quadtrees that do not match.
TEST(ManyCellsInContact, DoubleCantileverBeam) {
  const std::string text = double_cantilever("kind: quadtree, size: 0.15", "kind: polygons, size: 0.12");
  const auto solution = run(text), other = run(text, {"contacts.joint.between=[upper.bottom, lower.top]"});
  const double force = contact_of(last(solution)).normal_force;
  EXPECT_NEAR(force / double_cantilever_force, 1.0, 1e-3);
  EXPECT_NEAR(contact_of(last(other)).normal_force / force, 1.0, 1e-12);
  EXPECT_NEAR(std::abs(contact_of(last(solution)).tangential_force) / force, 0.2, 1e-10);
}

}  // namespace
}  // namespace scabo::verification
