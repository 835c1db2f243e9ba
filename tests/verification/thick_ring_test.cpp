// A thick ring filled with a heavy liquid and floating in another: linear traction on both rims, against Michell's
// series.
#include <fmt/format.h>

#include <cmath>

#include "run.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

constexpr double inner = 1.0, outer = 2.0, poisson = 0.3;
constexpr double liquid_outside = 3.0, liquid_inside = liquid_outside * outer * outer / (inner * inner);
constexpr double level = 5.0;  // of both, above all of the ring

/// Stress xx, yy, xy in plane stress at the polar coordinates r, angle. Pressure p = liquid (level - y) on both rims,
/// of which the resultants pi a^2 liquid are in balance. The mean is Lame's; the part with sin(angle) = s, cos(angle) =
/// c has the stress function A r^3 s + B s / r + C r ln(r) s + F r angle c,
///   rr = (2 A r - 2 B / r^3 + (C - 2 F) / r) s,  tt = (6 A r + 2 B / r^3 + C / r) s,
///   rt = (-2 A r + 2 B / r^3 - C / r) c,
/// and displacements that return to themselves around the hole for C = F (1 - nu) / 2. The resultant gives
/// -2 F = liquid r^2; the rims without shear give A and B.
element::Vec3 michell(double r, double angle) {
  const double F = -0.5 * liquid_outside * outer * outer, C = 0.5 * F * (1.0 - poisson);
  // A r - B / r^3 = -C / (2 r) on both rims.
  const double a = inner, b = outer;
  const double A = -0.5 * C / (a * a + b * b), B = A * std::pow(a, 4) + 0.5 * C * a * a;
  const double p = liquid_inside * level, q = liquid_outside * level;
  const double mean = (p * a * a - q * b * b) / (b * b - a * a), part = (p - q) * a * a * b * b / (b * b - a * a);
  const double s = std::sin(angle), c = std::cos(angle), cube = r * r * r;
  const double rr = mean - part / (r * r) + (2.0 * A * r - 2.0 * B / cube + (C - 2.0 * F) / r) * s;
  const double tt = mean + part / (r * r) + (6.0 * A * r + 2.0 * B / cube + C / r) * s;
  const double rt = (-2.0 * A * r + 2.0 * B / cube - C / r) * c;
  return {c * c * rr + s * s * tt - 2.0 * s * c * rt, s * s * rr + c * c * tt + 2.0 * s * c * rt,
          s * c * (rr - tt) + (c * c - s * s) * rt};
}

struct RingCase {
  const char* mesh;
  double bound;  // largest error of the stress over the largest stress
};
class ThickRing : public testing::TestWithParam<RingCase> {};

TEST_P(ThickRing, UnderLinearTractionHasMichellsStress) {
  const auto solution =
      run(fmt::format(R"(
scabo: 1
materials: {{steel: {{young: 1e6, poisson: {}}}}}
bodies:
  ring:
    material: steel
    shape: {{circle: {{centre: [0, 0], radius: {}}}}}
    holes: {{bore: {{circle: {{centre: [0, 0], radius: {}}}}}}}
    mesh: {{{}}}
supports:
  - {{on: ring.rim_start, fix: [x, y], name: pin}}
  - {{on: {{body: ring, near: [-{}, 0]}}, fix: y, name: roller}}
loads:
  outside: {{on: ring.rim, water: {{level: {}, unit_weight: {}}}}}
  inside: {{on: ring.bore, water: {{level: {}, unit_weight: {}}}}}
)",
                      poisson, outer, inner, GetParam().mesh, outer, level, liquid_outside, level, liquid_inside));
  const double weight = 3.14159 * outer * outer * liquid_outside;  // of the liquid displaced
  for (const Vec2& reaction : last(solution).reactions) EXPECT_LT(reaction.norm(), GetParam().bound * weight);
  double error = 0.0, largest = 0.0;
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.1 + 0.2618 * i, r = 1.06 + 0.88 * ((7 * i) % 24) / 23.0;
    const Vec2 x(r * std::cos(angle), r * std::sin(angle));
    const auto values = result::value_at(solution, last(solution).fields, 0, x);
    ASSERT_TRUE(values);
    error = std::max(error, (values->stress - michell(r, angle)).norm());
    largest = std::max(largest, michell(r, angle).norm());
  }
  EXPECT_LT(error / largest, GetParam().bound);
}

INSTANTIATE_TEST_SUITE_P(Meshes, ThickRing,
                         testing::Values(RingCase{"size: 0.5, order: 6", 2e-5},
                                         RingCase{"kind: polygons, size: 0.3, order: 5", 2e-5},
                                         RingCase{"kind: quadtree, size: 0.4, order: 4", 2e-4},
                                         RingCase{"kind: fem, size: 0.15", 1e-2}));

}  // namespace
}  // namespace scabo::verification
