// A torque on a circle, and bodies repeated around a centre: a ring that is held inside and twisted at its rim, whole
// and of sectors that are bonded to each other.
#include <fmt/format.h>

#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

constexpr double inside = 0.5, outside = 1.0, of_torque = 3e4, ring_young = 2e9, ring_poisson = 0.25,
                 ring_thickness = 0.2;

/// Rotation of the rim: u / r of the displacement along it, M / (4 pi G t) (1 / a^2 - 1 / b^2).
double rotation_of_rim() {
  const double G = ring_young / (2.0 * (1.0 + ring_poisson));
  return of_torque / (4.0 * std::numbers::pi * G * ring_thickness) *
         (1.0 / (inside * inside) - 1.0 / (outside * outside));
}

/// Largest and smallest rotation about the origin of the nodes of a body at the radius of the rim.
std::pair<double, double> rotations_of_rim(const analysis::StaticSolution& solution, std::size_t body) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  const std::vector<Vec2>& nodes = solution.mesh.bodies[body].nodes;
  const Vector& u = last(solution).fields.displacements[body];
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].norm() < outside * (1.0 - 1e-9)) continue;
    const double rotation = cross(nodes[i], u.segment<2>(static_cast<Eigen::Index>(2 * i))) / nodes[i].squaredNorm();
    least = std::min(least, rotation);
    most = std::max(most, rotation);
  }
  return {least, most};
}

TEST(Torque, OfARingTurnsItsRim) {
  const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{stuff: {{young: {}, poisson: {}}}}}
bodies:
  ring:
    material: stuff
    shape: {{circle: {{centre: [0, 0], radius: {}}}}}
    holes: {{bore: {{circle: {{centre: [0, 0], radius: {}}}}}}}
    mesh: {{kind: polygons, size: 0.12, order: 3}}
supports: [{{on: ring.bore, fix: [x, y]}}]
loads: {{twist: {{on: ring.rim, moment: {}}}}}
)",
                                        ring_thickness, ring_young, ring_poisson, outside, inside, of_torque));
  const auto [least, most] = rotations_of_rim(solution, 0);
  EXPECT_NEAR(least, rotation_of_rim(), 1e-3 * rotation_of_rim());
  EXPECT_NEAR(most, rotation_of_rim(), 1e-3 * rotation_of_rim());
  EXPECT_LT(last(solution).reactions[0].norm(), 1e-9 * of_torque);
  EXPECT_NEAR(last(solution).energy.elastic, 0.5 * of_torque * rotation_of_rim(), 1e-3 * of_torque * rotation_of_rim());
}

// The same of eight sectors around the centre, each with an eighth of the torque.
TEST(Repeat, AroundACentreMakesARingOfSectors) {
  std::string supports, loads;
  for (int i = 1; i <= 8; ++i) {
    supports += fmt::format("  - {{on: sector_{}.foot, fix: [x, y]}}\n", i);
    loads += fmt::format("  twist_{0}: {{on: sector_{0}.rim, moment: {1}}}\n", i, of_torque / 8.0);
  }
  const double c = std::sqrt(0.5);
  const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{stuff: {{young: {}, poisson: {}}}}}
bodies:
  sector:
    material: stuff
    shape:
      outline:
        - {{line: {{from: [{}, 0], to: [{}, 0]}}}}
        - {{arc: {{to: [{:.17g}, {:.17g}], centre: [0, 0]}}, name: rim}}
        - {{line: {{to: [{:.17g}, {:.17g}]}}}}
        - {{arc: {{to: [{}, 0], centre: [0, 0], direction: clockwise}}, name: foot}}
    mesh: {{kind: polygons, size: 0.12, order: 3}}
    repeat: {{count: 8, centre: [0, 0], angle: 45}}
supports:
{}loads:
{}contacts: {{joints: {{between: all, bond: true}}}}
)",
                                        ring_thickness, ring_young, ring_poisson, inside, outside, c * outside,
                                        c * outside, c * inside, c * inside, inside, supports, loads));
  EXPECT_EQ(last(solution).contacts.size(), 8u);
  for (std::size_t body = 0; body < 8; ++body) {
    const auto [least, most] = rotations_of_rim(solution, body);
    EXPECT_NEAR(least, rotation_of_rim(), 2e-3 * rotation_of_rim()) << body;
    EXPECT_NEAR(most, rotation_of_rim(), 2e-3 * rotation_of_rim()) << body;
  }
}

}  // namespace
}  // namespace scabo::verification
