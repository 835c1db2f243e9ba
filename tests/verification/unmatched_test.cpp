// Contacts whose sides are divided differently: nothing of what must be exact is lost, and published numbers are met.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "models.hpp"
#include "run.hpp"

namespace scabo::verification {
namespace {

// ---- patch tests -----------------------------------------------------------------------------------------

/// Two blocks of one material under uniform pressure, 2 wide, 1 and 1.5 high.
std::string pressed(const std::string& lower, const std::string& upper, double friction, bool swap = false) {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 30e9, poisson: 0.2}}}}
bodies:
  lower: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {}}}
  upper: {{material: m, shape: {{rectangle: {{corner: [0, 1], size: [2, 1.5]}}}}, mesh: {}}}
supports:
  - {{on: lower.bottom, fix: [y]}}
  - {{on: lower.bottom_left, fix: [x]}}
loads:
  weight: {{on: upper.top, pressure: 1e6}}
contacts:
  joint: {{between: {}, friction: {}}}
)",
                     lower, upper, swap ? "[upper.bottom, lower.top]" : "[lower.top, upper.bottom]", friction);
}

/// Largest deviation of pressures from 1e6, relative, and of displacements from x nu p / E, -y p / E, relative to the
/// largest of them.
struct Deviation {
  double pressure = 0.0, displacement = 0.0;
};
Deviation deviation_of(const analysis::StaticSolution& solution, double height) {
  const analysis::IncrementResult& increment = last(solution);
  Deviation deviation;
  for (const analysis::ContactResult& contact : increment.contacts) {
    EXPECT_EQ(contact.open, 0);
    for (const analysis::PairResult& pair : contact.pairs)
      deviation.pressure = std::max(deviation.pressure, std::abs(pair.pressure / 1e6 - 1.0));
  }
  // Without friction an upper body is free to slide as a whole: its least-moved position is not determined, so that
  // displacements along x are compared relative to its first node.
  for (std::size_t b = 0; b < solution.mesh.bodies.size(); ++b) {
    const std::vector<Vec2>& nodes = solution.mesh.bodies[b].nodes;
    const Vector& u = increment.fields.displacements[b];
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(2 * i);
      const double x = 0.2 * (nodes[i].x() - nodes[0].x()) * 1e6 / 30e9 - (u[k] - u[0]);
      const double y = -nodes[i].y() * 1e6 / 30e9 - u[k + 1];
      deviation.displacement = std::max({deviation.displacement, std::abs(x), std::abs(y)});
    }
  }
  deviation.displacement /= height * 1e6 / 30e9;
  return deviation;
}

const std::vector<std::string>& meshes() {
  static const std::vector<std::string> all{"{size: 0.25, order: 1}",
                                            "{size: 0.21, order: 2}",
                                            "{size: 0.35, order: 3}",
                                            "{size: 0.3, kind: polygons, order: 1}",
                                            "{size: 0.27, kind: polygons, order: 2}",
                                            "{size: 0.35, kind: quadtree, order: 1}",
                                            "{size: 0.23, kind: fem}",
                                            "{size: 0.3, kind: quadtree, order: 3}"};
  return all;
}

class UnmatchedPatch : public testing::TestWithParam<int> {};

TEST_P(UnmatchedPatch, UniformPressureOverAnyPairOfMeshes) {
  const auto i = static_cast<std::size_t>(GetParam());
  for (std::size_t j = 0; j < meshes().size(); ++j)
    for (const double friction : {0.0, 0.5}) {
      SCOPED_TRACE(meshes()[i] + " below " + meshes()[j] + fmt::format(", friction {}", friction));
      const Deviation deviation = deviation_of(run(pressed(meshes()[i], meshes()[j], friction, (i + j) % 2 == 1)), 2.5);
      // The last two lose one more digit to rounding, also where sizes are equal (3e-12 between two equal
      // quadtrees).
      const double rounding = i < 6 && j < 6 ? 1e-12 : 2e-11;
      EXPECT_LT(deviation.pressure, rounding);
      EXPECT_LT(deviation.displacement, 0.2 * rounding + 0.8e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(Lower, UnmatchedPatch, testing::Range(0, 8));

// Three blocks on each other; the middle one of another order. And one block under two: their weight is uniform too.
TEST(UnmatchedPatch, StackAndTwoOnOne) {
  const std::string materials = R"(
scabo: 1
materials: {m: {young: 30e9, poisson: 0.2}}
)";
  const std::string stack = materials + R"(
bodies:
  lower: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.27, order: 2}}
  middle: {material: m, shape: {rectangle: {corner: [0, 1], size: [2, 0.5]}}, mesh: {size: 0.35, order: 1}}
  upper: {material: m, shape: {rectangle: {corner: [0, 1.5], size: [2, 1]}}, mesh: {size: 0.4, order: 3}}
supports:
  - {on: lower.bottom, fix: [y]}
  - {on: lower.bottom_left, fix: [x]}
loads:
  weight: {on: upper.top, pressure: 1e6}
contacts:
  first: {between: [lower.top, middle.bottom], friction: 0.5}
  second: {between: [middle.top, upper.bottom], friction: 0.5}
)";
  const std::string two = materials + R"(
bodies:
  lower: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.27, order: 2}}
  left: {material: m, shape: {rectangle: {corner: [0, 1], size: [0.7, 1.5]}}, mesh: {size: 0.3, order: 1}}
  right: {material: m, shape: {rectangle: {corner: [0.7, 1], size: [1.3, 1.5]}}, mesh: {size: 0.31, order: 3}}
supports:
  - {on: lower.bottom, fix: [y]}
  - {on: lower.bottom_left, fix: [x]}
loads:
  weight: {on: left.top, pressure: 1e6}
  other: {on: right.top, pressure: 1e6}
contacts:
  first: {between: [lower.top, left.bottom], friction: 0.5}
  second: {between: [right.bottom, lower.top], friction: 0.5}
)";
  for (const std::string& model : {stack, two}) {
    const Deviation deviation = deviation_of(run(model), 2.5);
    EXPECT_LT(deviation.pressure, 4e-12);  // rounding at nodes of cubic elements; 2e-12 where sizes are equal
    EXPECT_LT(deviation.displacement, 1e-12);
  }
}

// A short block on a longer one, whose pressure is not uniform: the total is the load, and swapped sides give the same
// numbers.
TEST(Unmatched, ABlockOnALongerOne) {
  const std::string text = R"(
scabo: 1
materials: {m: {young: 30e9, poisson: 0.2}}
bodies:
  lower: {material: m, shape: {rectangle: {corner: [0, 0], size: [3, 1]}}, mesh: {size: 0.27, order: 2}}
  upper: {material: m, shape: {rectangle: {corner: [0.87, 1], size: [1.3, 1]}}, mesh: {size: 0.23, order: 3}}
supports:
  - {on: lower.bottom, fix: [x, y]}
loads:
  weight: {on: upper.top, pressure: 1e6}
  push: {on: upper.left, traction: [2e5, 0]}
contacts:
  joint: {between: [lower.top, upper.bottom], friction: 0.3}
)";
  const auto solution = run(text), other = run(text, {"contacts.joint.between=[upper.bottom, lower.top]"});
  const analysis::ContactResult &a = last(solution).contacts[0], &b = last(other).contacts[0];
  EXPECT_NEAR(a.normal_force / 1.3e6, 1.0, 1e-12);
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t k = 0; k < a.pairs.size(); ++k) {
    EXPECT_NEAR(a.pairs[k].pressure, b.pairs[k].pressure, 1e-12 * 1e6 * 10);
    EXPECT_EQ(a.pairs[k].state, b.pairs[k].state);
  }
}

// ---- published numbers -----------------------------------------------------------------------------------

// The double cantilever beam of example 01, 20 against 29 elements. Total force 53.669 kN; pressures of 240 quadratic
// elements on each side (which differ from those of 120 by at most 0.02 % at these places), in kPa.
TEST(Unmatched, DoubleCantileverBeam) {
  const std::string text = double_cantilever("size: 0.3", "size: 0.2068965517241379");
  const std::vector<std::array<double, 2>> fine{
      {5.45, 49022},  {5.475, 52200}, {5.5, 55377},   {5.525, 58539}, {5.55, 61698},  {5.575, 64830}, {5.6, 67954},
      {5.625, 71035}, {5.65, 74104},  {5.675, 77109}, {5.7, 80097},   {5.725, 83000}, {5.75, 85879},  {5.775, 88652},
      {5.8, 91397},   {5.825, 94016}, {5.85, 96603},  {5.875, 99048}, {5.9, 101456}};
  for (const char* swap :
       {"contacts.joint.between=[lower.top, upper.bottom]", "contacts.joint.between=[upper.bottom, lower.top]"}) {
    const auto solution = run(text, {swap});
    const analysis::ContactResult& joint = last(solution).contacts[0];
    EXPECT_NEAR(joint.normal_force, 53669.4, 1e-4 * 53669.4);
    int compared = 0;
    for (std::size_t k = 0; k < joint.pairs.size(); ++k) {
      const double x = joint.pairs[k].position.x();
      for (std::size_t m = 0; m + 1 < fine.size(); ++m) {
        if (x < fine[m][0] || x >= fine[m + 1][0]) continue;
        const double expected = std::lerp(fine[m][1], fine[m + 1][1], (x - fine[m][0]) / (fine[m + 1][0] - fine[m][0]));
        EXPECT_NEAR(joint.pairs[k].pressure, expected, 0.008 * expected) << x;
        ++compared;
      }
    }
    EXPECT_GE(compared, 6);
  }
}

// Hertz: cylinder of 50 mm radius (210 GPa) on a block (70 GPa), plane strain, 35 kN/mm (NAFEMS CGS-1): largest
// pressure 3585.4 MPa, half width 6.2146 mm. The two meshes have nothing in common.
TEST(Unmatched, HertzOnPolygonsAndAQuadtree) {
  const auto solution = run(R"(
scabo: 1
analysis: {plane: strain}
materials: {steel: {young: 210e3, poisson: 0.3}, aluminium: {young: 70e3, poisson: 0.3}}
bodies:
  block:
    material: aluminium
    shape: {rectangle: {corner: [-100, -200], size: [200, 200]}}
    mesh: {size: 16, kind: quadtree, refine: [{near: [0, 0], size: 0.7}]}
  roller:
    material: steel
    shape:
      outline:
        - {line: {from: [50, 50], to: [-50, 50]}, name: top}
        - {arc: {to: [50, 50], centre: [0, 50]}, name: rim}
    mesh: {size: 10, kind: polygons, refine: [{near: [0, 0], size: 0.6}]}
supports:
  - {on: block.bottom, fix: [x, y]}
loads:
  press: {on: roller.top, pressure: 350}
contacts:
  joint: {between: [block.top, roller.rim], friction: 0}
)");
  const analysis::ContactResult& joint = last(solution).contacts[0];
  EXPECT_NEAR(joint.normal_force, 35000, 0.01 * 35000);
  double largest = 0.0, half_width = 0.0;
  for (std::size_t k = 0; k < joint.pairs.size(); ++k) {
    const double x = joint.pairs[k].position.x(), pressure = joint.pairs[k].pressure;
    largest = std::max(largest, pressure);
    if (pressure > 0.0) half_width = std::max(half_width, std::abs(x));
    if (std::abs(x) < 5.0) {
      EXPECT_NEAR(pressure, 3585.4 * std::sqrt(1.0 - std::pow(x / 6.2146, 2)), 0.02 * 3585.4) << x;
    }
  }
  EXPECT_NEAR(largest, 3585.4, 0.01 * 3585.4);
  EXPECT_NEAR(half_width, 6.2146, 0.5);
  EXPECT_LT(2 * solution.mesh.nodes(), 12000);
}

// Persson: a pin, loaded at its centre (here at a small bore), in a hole of an infinite plate of the same material,
// without friction. For half angles e of contact: E* dR / Q and R p_max / Q.
class Persson : public testing::TestWithParam<std::array<double, 3>> {};

TEST_P(Persson, QuadtreeInUnboundedPlate) {
  const auto [half_angle, clearance, pressure] = GetParam();
  const double dR = 1e-5, Q = 1e3 * dR / clearance;  // E* = 1e3, R = 1
  const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{m: {{young: 910, poisson: 0.3}}}}
bodies:
  pin:
    material: m
    shape:
      outline:
        - {{arc: {{from: [1, 0], to: [-1, 0], centre: [0, 0]}}, name: crown}}
        - {{arc: {{to: [1, 0], centre: [0, 0]}}, name: rim}}
    holes: {{bore: {{circle: {{centre: [0, 0], radius: 0.02}}}}}}
    mesh: {{size: 0.2, kind: quadtree, refine: [{{on: rim, size: 0.05}}, {{near: [0, 0], size: 0.01}}]}}
  plate:
    material: m
    outside: true
    reference: [0, -1000]
    shape:
      outline:
        - {{arc: {{from: [{0}, {1}], to: [-{0}, {1}], centre: [0, {1}]}}, name: crown}}
        - {{arc: {{to: [{0}, {1}], centre: [0, {1}]}}, name: rim}}
    mesh: {{size: 0.06}}
supports:
  - {{on: pin.vertex_1, fix: [x]}}
  - {{on: {{body: pin, near: [0, 1]}}, fix: [x]}}
loads:
  press: {{on: pin.bore, force: [0, -{2}]}}
contacts:
  joint: {{between: [pin.rim, plate.rim], friction: 0}}
)",
                                        1.0 + dR, dR, Q));
  const analysis::ContactResult& joint = last(solution).contacts[0];
  double largest = 0.0, edge = 0.0, vertical = 0.0;
  for (const analysis::PairResult& pair : joint.pairs) {
    const double angle = std::atan2(std::abs(pair.position.x()), -pair.position.y()) * 180 / std::numbers::pi;
    largest = std::max(largest, pair.pressure);
    if (pair.pressure > 0.0) edge = std::max(edge, angle);
    vertical += pair.normal_force * std::cos(angle * std::numbers::pi / 180);
  }
  EXPECT_NEAR(vertical, Q, 1e-4 * Q);
  EXPECT_NEAR(largest / Q, pressure, 2e-3 * pressure);
  EXPECT_NEAR(edge, half_angle, 2.0);  // an element of the plate is 3.4 degrees long
}

INSTANTIATE_TEST_SUITE_P(Angles, Persson,
                         testing::Values(std::array{30.0, 7.943540, 1.260289}, std::array{45.0, 2.823121, 0.882111},
                                         std::array{60.0, 1.067202, 0.711721}, std::array{75.0, 0.287077, 0.628103}));

}  // namespace
}  // namespace scabo::verification
