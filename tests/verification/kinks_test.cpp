// Kinks of cracks: factors of short real ones, and angles from meshes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "growth.hpp"
#include "scabo/analysis/growth/criteria.hpp"
#include "verification/models.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;
constexpr double degree = pi / 180.0;

/// A crack from -1 to 1 with a kink at its right end: k_1, k_2 over sigma sqrt(pi). In mode I under tension from all
/// sides, in mode II under shear, without T in both.
Vec2 factors_of_kink(double angle, double length, bool shear) {
  const Vec2 end(1.0 + length * std::cos(angle * degree), -length * std::sin(angle * degree));
  CrackedPlate plate;
  plate.kind = "quadtree";
  plate.half_width = 200;
  plate.size = 80;
  plate.xx = plate.yy = shear ? 0.0 : 1.0;
  plate.xy = shear ? 1.0 : 0.0;
  plate.crack("flaw", {{-1, 0}, {1, 0}, end});
  plate.refine_at({end}, length / 4).refine_at({{1, 0}}, length / 8).refine_at({{-1, 0}}, 0.3);
  const auto solution = run(plate.text());
  const element::StressIntensity& factors = factors_at(last(solution), "plate.flaw.end");
  return Vec2(factors.K_I, factors.K_II) / std::sqrt(pi);
}

// Factors F of an infinitesimal kink by real ones of 0.02 and 0.01 half lengths, extrapolated to length 0
// (VERIFICATION, "Cracks that grow").
TEST(Kinks, FactorsOfShortOnesExtrapolatedToLengthZero) {
  const struct {
    double angle, F11, F21, F12, F22;
  } rows[] = {{30, .901738, -.240249, .729842, .797161},
              {60, .655670, -.369250, 1.167992, .307871},
              {70.529, .554370, -.378112, 1.223318, .117709}};
  for (const auto& row : rows)
    for (const bool shear : {false, true}) {
      const Vec2 F = 2.0 * factors_of_kink(row.angle, 0.01, shear) - factors_of_kink(row.angle, 0.02, shear);
      EXPECT_NEAR(F[0] / (shear ? row.F12 : row.F11), 1.0, 1e-3) << row.angle;
      EXPECT_NEAR(F[1] / (shear ? row.F22 : row.F21), 1.0, 1e-3) << row.angle;
    }
}

/// A crack from -1 to 1 in a wide plate in plane strain under tension `yy`, `xx` and shear: the state in which it would
/// begin to grow.
analysis::GrowthResult at_begin(const std::string& growth, double yy, double shear, double xx = 0.0) {
  const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 200e9, poisson: 0.3}}}}
bodies:
  plate:
    material: steel
    shape: {{rectangle: {{corner: [-100, -100], size: [200, 200]}}}}
    mesh: {{kind: quadtree, size: 20, order: 3}}
    cracks: [{{path: [[-1, 0], [1, 0]], name: flaw}}]
supports: [{{on: plate.bottom_left, fix: [x, y]}}, {{on: plate.bottom_right, fix: [y]}}]
loads:
  up: {{on: plate.top, traction: [{1}, {0}]}}
  down: {{on: plate.bottom, traction: [-{1}, -{0}]}}
  right: {{on: plate.right, traction: [{2}, {1}]}}
  left: {{on: plate.left, traction: [-{2}, -{1}]}}
steps: [{{growth: {{{3}, toughness: {{K_Ic: 1e6}}, step: 0.1, until: {{load_factor: 1e-9}}}}}}]
)",
                                        yy * 1e6, shear * 1e6, xx * 1e6, growth));
  return growth_at(solution, 0);
}

// From K_II/K_I = 0.1 to pure shear, by all criteria, from the factors of a mesh.
TEST(Kinks, AnglesFromAMesh) {
  const struct {
    double yy, shear, hoop_stress, strain_energy_density, zero_K_II, energy_release;  // degrees
  } rows[] = {{1, 0.1, 11.2029, 11.0695, 11.2515, 11.2514},
              {1, 0.5, 40.2078, 37.6272, 42.1259, 42.0294},
              {1, 1, 53.1301, 51.9067, 56.9580, 56.5654},
              {1e-4, 1, 70.5288, 82.3377, 77.3301, 75.7568}};  // in pure shear the faces touch
  for (const auto& row : rows)
    for (const auto& [criterion, angle] :
         {std::pair("hoop_stress", row.hoop_stress), std::pair("strain_energy_density", row.strain_energy_density),
          std::pair("zero_K_II", row.zero_K_II), std::pair("energy_release", row.energy_release)}) {
      const auto at = at_begin(fmt::format("criterion: {}", criterion), row.yy, row.shear);
      for (const analysis::TipResult& tip : at.tips) EXPECT_NEAR(std::abs(tip.kink) / degree, angle, 0.1) << criterion;
    }
}

// With the T-stress at a distance r: K_I = sigma (pi a)^1/2 and T = sigma_x - sigma_y of the crack under tension on two
// sides.
TEST(Kinks, WithTheTStress) {
  const double r = 0.02, yy = 1.0, shear = 0.5;
  for (const double xx : {0.0, 3.0}) {
    const auto at = at_begin(fmt::format("distance: {}", r), yy, shear, xx);
    const analysis::TipFactors K{Vec2(yy, shear) * std::sqrt(pi), (xx - yy) * std::sqrt(2.0 * pi * r)};
    const analysis::Kink kink = analysis::kink_of(model::GrowthCriterion::hoop_stress, K, 1.8);
    EXPECT_NEAR(std::abs(at.tips.at(1).kink) / degree, std::abs(kink.angle) / degree, 0.1);
    EXPECT_NEAR(at.load_factor * kink.equivalent, 1.0, 2e-3);
  }
}

// Straight wings of length l at the tips of a closed crack under compression, by friction and length: k_1 and k_2 of a
// crack that is closed everywhere (VERIFICATION, "Cracks that grow"). Here it opens beside its wings, which changes
// k_2.
TEST(Kinks, WingsByFrictionAndLength) {
  const struct {
    double friction, length;
    Vec2 k;
  } rows[] = {{0.3, 0.02, {.37755, -.06038}}, {0.0, 0.1, {.44461, -.06795}}, {0.0, 0.5, {.24796, .03905}}};
  for (const auto& row : rows) {
    const double turn = (45.0 + 70.529) * degree;
    const Vec2 end = Vec2::Constant(std::sqrt(0.5)), tip = end + row.length * Vec2(std::cos(turn), std::sin(turn));
    CrackedPlate plate{.kind = "quadtree", .order = 2, .yy = -1};
    plate.crack("flaw", {-tip, -end, end, tip}).refine_at({-tip, -end, end, tip}, 0.25 * row.length);
    plate.contacts = fmt::format("faces: {{between: [plate.flaw.left, plate.flaw.right], friction: {}}}", row.friction);
    const auto solution = run(plate.text());
    const element::StressIntensity& factors = factors_at(last(solution), "plate.flaw.end");
    EXPECT_NEAR(factors.K_I / std::sqrt(pi) / row.k[0], 1.0, 6e-3) << row.length;
    EXPECT_NEAR(factors.K_II / std::sqrt(pi), row.k[1], 8e-3) << row.length;
  }
}

}  // namespace
}  // namespace scabo::verification
