// What happens out of the plane: expansion along axis 3, and stress zz where a body is of several materials.
#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "run.hpp"
#include "scabo/result/point_tables.hpp"
#include "scabo/result/recovery.hpp"

namespace scabo::verification {
namespace {

std::string clamped_plate(const std::string& material, const std::string& mesh = "size: 1") {
  return fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{stuff: {}}}
bodies: {{plate: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{{}}}}}}}
supports:
  - {{on: plate.bottom, fix: [x, y]}}
  - {{on: plate.top, fix: [x, y]}}
  - {{on: plate.left, fix: [x, y]}}
  - {{on: plate.right, fix: [x, y]}}
loads: {{warm: {{on: plate, temperature: 50}}}}
)",
                     material, mesh);
}

result::PointResult at_point(const analysis::StaticSolution& solution, const Vec2& x) {
  return result::PointEvaluation(solution, {{"p", 0, x, 0.0}}, 1).at(solution, last(solution)).front();
}

// Clamped all around, and in plane strain out of the plane as well, nothing moves: [s11, s22, s33] = -C [a1, a2, a3] T
// with C the inverse of the compliance in three dimensions; turned by the angle of the axes.
TEST(ThermalStress, OfAClampedOrthotropicBodyInPlaneStrain) {
  const double E1 = 14.0, E2 = 4.0, E3 = 7.0, nu12 = 0.25, nu13 = 0.3, nu23 = 0.15, T = 50.0;
  Eigen::Matrix3d S;
  S << 1 / E1, -nu12 / E1, -nu13 / E1, -nu12 / E1, 1 / E2, -nu23 / E2, -nu13 / E1, -nu23 / E2, 1 / E3;
  const struct {
    const char* text;
    Eigen::Vector3d expansion;
  } expansions[] = {{"[1e-3, 3e-3, 7e-3]", {1e-3, 3e-3, 7e-3}},
                    {"[1e-3, 3e-3]", {1e-3, 3e-3, 3e-3}},  // axes 2 and 3 alike
                    {"2e-3", {2e-3, 2e-3, 2e-3}}};
  for (const auto& [text, expansion] : expansions)
    for (const double degrees : {0.0, 30.0}) {
      const auto solution = run(clamped_plate(
          fmt::format("{{orthotropic: {{E1: {}, E2: {}, E3: {}, nu12: {}, nu13: {}, nu23: {}, G12: 3, angle: {}}}, "
                      "expansion: {}}}",
                      E1, E2, E3, nu12, nu13, nu23, degrees, text)));
      const Eigen::Vector3d s = -S.inverse() * expansion * T;
      const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), n = std::sin(angle);
      const result::PointResult found = at_point(solution, {0.7, 0.4});
      EXPECT_NEAR(found.values.stress[0], c * c * s[0] + n * n * s[1], 1e-11) << text << degrees;
      EXPECT_NEAR(found.values.stress[1], n * n * s[0] + c * c * s[1], 1e-11) << text << degrees;
      EXPECT_NEAR(found.values.stress[2], c * n * (s[0] - s[1]), 1e-11) << text << degrees;
      EXPECT_NEAR(found.stress_zz, s[2], 1e-11) << text << degrees;
      EXPECT_NEAR(found.energy_density, -0.5 * T * s.dot(expansion), 1e-12) << text << degrees;
    }
}

TEST(ThermalStress, OfAClampedIsotropicBodyInPlaneStrain) {  // -E a T / (1 - 2 nu) in all directions
  const double strain = 1e-3 * 50.0, stress = -10.0 * strain / 0.4;
  for (const char* mesh : {"size: 1", "kind: polygons, size: 0.5", "kind: fem, size: 0.5"}) {
    const auto solution = run(clamped_plate("{young: 10, poisson: 0.3, expansion: 1e-3}", mesh));
    const result::PointResult found = at_point(solution, {0.7, 0.4});
    for (const double of_axis : {found.values.stress[0], found.values.stress[1], found.stress_zz})
      EXPECT_NEAR(of_axis, stress, 1e-12) << mesh;
    EXPECT_NEAR(found.values.stress[2], 0.0, 1e-12) << mesh;
    EXPECT_NEAR(found.energy_density, -0.5 * 3.0 * stress * strain, 1e-13) << mesh;
  }
}

// Free in the plane and held across: only the stress -E a T across has energy. In plane stress there is none.
TEST(ThermalStress, EnergyOfABodyThatIsHeldAcross) {
  for (const char* plane : {"strain", "stress"}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: {}}}
materials: {{stuff: {{young: 10, poisson: 0.3, expansion: 1e-3}}}}
bodies: {{plate: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 1}}}}}}
supports: [{{on: plate.bottom_left, fix: [x, y]}}, {{on: plate.bottom_right, fix: y}}]
loads: {{warm: {{on: plate, temperature: 50}}}}
)",
                                          plane));
    const double across = plane == std::string("strain") ? 0.5 * 10.0 * 0.05 * 0.05 : 0.0;
    EXPECT_NEAR(at_point(solution, {0.7, 0.4}).energy_density, across, 1e-13) << plane;
  }
}

const char* const half_and_half = R"(
scabo: 1
analysis: {plane: strain}
materials: {soft: {young: 2, poisson: 0.4}, stiff: {young: 10, poisson: 0.1}}
bodies:
  joint:
    material: soft
    shape: {polygon: {vertices: [[-1, 0], [-1, -1], [1, -1], [1, 0], [1, 1], [-1, 1]]}}
    mesh: {size: 0.5, order: 3, centre: [0, 0]}
    sectors: {edge_1: stiff, edge_2: stiff, edge_3: stiff}
supports: [{on: joint.edge_2, fix: [x, y]}]
loads: {pull: {on: joint.edge_5, traction: [0.3, 1]}}
)";

// In plane strain s_zz = nu (s_xx + s_yy), with the nu of the material at the point.
TEST(StressOutOfThePlane, IsThatOfTheMaterialAtThePoint) {
  const auto solution = run(half_and_half);
  for (const Vec2& x : {Vec2(-0.6, -0.3), Vec2(0.2, -0.8), Vec2(0.7, 0.2), Vec2(-0.1, 0.9), Vec2(-0.4, 0.3)}) {
    const result::PointResult found = at_point(solution, x);
    const double sum = found.values.stress[0] + found.values.stress[1];
    EXPECT_GT(std::abs(sum), 0.1);
    EXPECT_NEAR(found.stress_zz, (x.y() < 0.0 ? 0.1 : 0.4) * sum, 1e-13) << x.transpose();
  }
}

TEST(StressOutOfThePlane, IsThatOfTheMaterialInTheFieldsToo) {
  const auto solution = run(half_and_half);
  const result::Recovery recovery(solution);
  const result::Fields fields = recovery.fields(solution, last(solution).fields);
  int soft = 0, stiff = 0;
  for (std::size_t i = 0; i < recovery.grid().point_count(); ++i) {
    const double y = recovery.grid().points[3 * i + 1], sum = fields.stress[6 * i] + fields.stress[6 * i + 1];
    if (std::abs(y) < 1e-9 || std::abs(sum) < 0.1) continue;  // on the interface there is a point for either material
    EXPECT_NEAR(fields.stress[6 * i + 2], (y < 0.0 ? 0.1 : 0.4) * sum, 1e-6 * std::abs(sum)) << "point " << i;
    ++(y < 0.0 ? stiff : soft);
  }
  EXPECT_GT(soft, 50);
  EXPECT_GT(stiff, 50);
}

}  // namespace
}  // namespace scabo::verification
