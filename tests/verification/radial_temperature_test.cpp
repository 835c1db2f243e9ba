// A thick ring whose temperature falls with the radius, as heat flows through it: Lame's thermal stresses (Boley and
// Weiner, Theory of Thermal Stresses, 1960, section 9.10; Timoshenko and Goodier, Theory of Elasticity, section 135).
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification::hot_ring {
namespace {

constexpr double inner = 1.0, outer = 2.0, young = 200e9, poisson = 0.3, expansion = 1.2e-5, hot = 80.0;
constexpr double thickness = 0.1;

/// T(r) = T_a ln(b / r) / ln(b / a), by points so near to each other that the lines between them are as good.
std::string logarithmic_table(int parts) {
  std::string at, values;
  for (int i = 0; i <= parts; ++i) {
    const double r = inner + (outer - inner) * i / parts;
    at += fmt::format("{}{:.17g}", i == 0 ? "" : ", ", r);
    values += fmt::format("{}{:.17g}", i == 0 ? "" : ", ", hot * std::log(outer / r) / std::log(outer / inner));
  }
  return fmt::format("at: [{}], values: [{}]", at, values);
}

struct RadialStress {
  double rr, tt;
};
/// In plane stress; in plane strain E / (1 - nu) stands for E.
RadialStress lame(double r, bool strain) {
  const double a2 = inner * inner, b2 = outer * outer, ratio = std::log(outer / inner), to_r = std::log(outer / r);
  const double level = young / (strain ? 1.0 - poisson : 1.0) * expansion * hot / (2.0 * ratio);
  return {level * (-to_r - a2 / (b2 - a2) * (1.0 - b2 / (r * r)) * ratio),
          level * (1.0 - to_r - a2 / (b2 - a2) * (1.0 + b2 / (r * r)) * ratio)};
}

analysis::StaticSolution ring(const std::string& mesh, const Vec2& centre, bool strain) {
  return run(fmt::format(R"(
scabo: 1
analysis: {{plane: {}, thickness: {}}}
materials: {{steel: {{young: {}, poisson: {}, expansion: {}}}}}
bodies:
  ring:
    material: steel
    shape: {{circle: {{centre: [{}, {}], radius: {}}}}}
    holes: {{bore: {{circle: {{centre: [{}, {}], radius: {}}}}}}}
    mesh: {{{}}}
supports:
  - {{on: ring.rim_start, fix: [x, y], name: pin}}
  - {{on: {{body: ring, near: [{}, {}]}}, fix: y, name: roller}}
loads: {{heat: {{on: ring, temperature: {{over: radius, centre: [{}, {}], {}}}}}}}
)",
                         strain ? "strain" : "stress", thickness, young, poisson, expansion, centre.x(), centre.y(),
                         outer, centre.x(), centre.y(), inner, mesh, centre.x() - outer, centre.y(), centre.x(),
                         centre.y(), logarithmic_table(200)));
}

/// Largest error of the stress at points inside, over the largest stress.
double error_of(const analysis::StaticSolution& solution, const Vec2& centre, bool strain) {
  const double largest = std::abs(lame(inner, strain).tt);
  double error = 0.0;
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.1 + 0.2618 * i, r = 1.06 + 0.88 * ((7 * i) % 24) / 23.0;
    const double c = std::cos(angle), s = std::sin(angle);
    const auto values = result::value_at(solution, last(solution).fields, 0, centre + r * Vec2(c, s));
    if (!values) throw std::runtime_error("a point of the ring has no stress");
    const RadialStress at = lame(r, strain);
    const element::Vec3 exact(c * c * at.rr + s * s * at.tt, s * s * at.rr + c * c * at.tt, s * c * (at.rr - at.tt));
    error = std::max(error, (values->stress - exact).norm() / largest);
  }
  return error;
}

struct HotRing {
  const char* name;
  const char* mesh;
  double size;
  double bound;
};
class RadialTemperature : public testing::TestWithParam<HotRing> {};

TEST_P(RadialTemperature, OfAThickRingHasLamesStress) {
  for (const bool strain : {false, true})
    for (const Vec2& centre : {Vec2(0.0, 0.0), Vec2(30.0, -7.0)}) {
      const auto solution = ring(fmt::format("{}, size: {}", GetParam().mesh, GetParam().size), centre, strain);
      EXPECT_LT(error_of(solution, centre, strain), GetParam().bound);
      for (const Vec2& reaction : last(solution).reactions)
        EXPECT_LT(reaction.norm(), 1e-9 * young * expansion * hot * thickness);
    }
}

TEST_P(RadialTemperature, HasAnErrorThatFallsWithTheSizeOfTheCells) {
  const auto error = [](double size) {
    return error_of(ring(fmt::format("{}, size: {}", GetParam().mesh, size), Vec2::Zero(), false), Vec2::Zero(), false);
  };
  const double coarse = error(2.0 * GetParam().size), fine = error(0.5 * GetParam().size);
  RecordProperty("errors", fmt::format("{} {}", coarse, fine));
  EXPECT_LT(fine, 0.1 * coarse);  // second order: 1/16
}

INSTANTIATE_TEST_SUITE_P(Meshes, RadialTemperature,
                         testing::Values(HotRing{"polygons", "kind: polygons", 0.15, 2e-2},
                                         HotRing{"quadtree", "kind: quadtree", 0.1, 2e-2},
                                         HotRing{"fem", "kind: fem", 0.1, 2e-2}),
                         [](const auto& info) { return std::string(info.param.name); });

// The rim moves by b times the mean of alpha T over the area, and the energy is that of Lame's stresses.
TEST(RadialTemperature, WidensTheRingAndStoresTheEnergyOfItsStress) {
  const auto solution = ring("kind: fem, size: 0.05", Vec2::Zero(), false);
  double mean = 0.0, energy = 0.0;
  constexpr int parts = 2000;
  for (int i = 0; i < parts; ++i) {
    const double r = inner + (outer - inner) * (i + 0.5) / parts, dr = (outer - inner) / parts;
    mean += 2.0 * hot * std::log(outer / r) / std::log(outer / inner) * r * dr / (outer * outer - inner * inner);
    const RadialStress at = lame(r, false);
    energy += (at.rr * at.rr + at.tt * at.tt - 2.0 * poisson * at.rr * at.tt) / (2.0 * young) * 2.0 * std::numbers::pi *
              r * dr * thickness;
  }
  const auto right = result::value_at(solution, last(solution).fields, 0, Vec2(outer, 0.0));
  const auto left = result::value_at(solution, last(solution).fields, 0, Vec2(-outer, 0.0));
  ASSERT_TRUE(right && left);
  EXPECT_NEAR(0.5 * (right->displacement.x() - left->displacement.x()), outer * expansion * mean,
              1e-3 * outer * expansion * mean);
  EXPECT_NEAR(last(solution).energy.elastic, energy, 5e-3 * energy);
}

// A table of one value is a uniform temperature: no stress anywhere, in any mesh.
TEST(RadialTemperature, ThatIsTheSameEverywhereLeavesNoStress) {
  for (const char* mesh : {"size: 0.5, order: 3", "kind: polygons, size: 0.3", "kind: fem, size: 0.3"}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{steel: {{young: {}, poisson: {}, expansion: {}}}}}
bodies: {{block: {{material: steel, shape: {{rectangle: {{corner: [-1, -1], size: [2, 2]}}}}, mesh: {{{}}}}}}}
supports: [{{on: block.bottom_left, fix: [x, y]}}, {{on: block.bottom_right, fix: y}}]
loads: {{heat: {{temperature: {{over: radius, centre: [0.2, 0.1], at: [0, 1], values: [20, 20]}}}}}}
)",
                                          young, poisson, expansion, mesh));
    const auto values = result::value_at(solution, last(solution).fields, 0, Vec2(0.3, 0.4));
    ASSERT_TRUE(values);
    EXPECT_LT(values->stress.norm(), 1e-9 * young * expansion * 20.0) << mesh;
    EXPECT_NEAR(values->displacement.x(), expansion * 20.0 * 1.3, 1e-8 * expansion * 20.0) << mesh;
  }
}

}  // namespace
}  // namespace scabo::verification::hot_ring
