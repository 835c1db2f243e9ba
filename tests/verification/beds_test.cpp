// Beds of springs that only press (Winkler): a block that lifts off under an eccentric force, settlement under uniform
// pressure, and twins.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

constexpr double base = 2.0, modulus = 5e7, weight = 3e5;

/// A stiff block on a bed, pressed by a force at `arm` from the middle of its base. Force at a point of a rigid beam:
/// the block has two loads on its top, of which the moment is weight times arm.
std::string block_on_bed(double arm, int elements, const std::string& young, bool swapped = false, double unit = 1.0) {
  return fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{stiff: {{young: {}, poisson: 0}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}}}
  block: {{material: stiff, shape: {{rectangle: {{corner: [{}, 0], size: [{}, {}]}}}}, mesh: {{kind: fem, size: {}, order: 1}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: block.bottom_left, fix: x}}]
loads:
  down: {{on: block.top, force: [0, {}]}}
  turn: {{on: block.top, moment: {}}}
contacts: {{bed: {{between: [{}], modulus: {}, about: [0, 0]}}}}
)",
                     unit, young, -2 * base * unit, -unit, 4 * base * unit, unit, -0.5 * base * unit, base * unit,
                     0.5 * base * unit, base * unit / elements, -weight, -weight * arm * unit,
                     swapped ? "block.bottom, floor.top" : "floor.top, block.bottom", modulus / (unit * unit * unit));
}

// Around an axis too: a disc of radius R under a pressure p settles by p / modulus, and the bed carries p pi R^2. On
// the axis itself the pair has the area of a disc, which is not quite that of its shape function: finer elements,
// smaller error.
TEST(Beds, CarryADiscAroundItsAxis) {
  constexpr double p = 1e5, radius = 2.0;
  double before = 1.0;
  for (const double size : {0.2, 0.1, 0.05}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: axisymmetric}}
materials: {{steel: {{young: 210e9, poisson: 0}}}}
bodies:
  ground: {{rigid: true, shape: {{rectangle: {{corner: [0, -1], size: [4, 1]}}}}}}
  slab: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [{}, 0.5]}}}}, mesh: {{size: {}}}}}
supports: [{{on: ground, fix: y}}]
loads: {{down: {{on: slab.top, pressure: {}}}}}
contacts: {{bed: {{between: [ground.top, slab.bottom], modulus: {}}}}}
)",
                                          radius, size, p, modulus));
    const double force = p * std::numbers::pi * radius * radius;
    EXPECT_NEAR(contact_of(last(solution)).normal_force, force, 1e-9 * force);
    EXPECT_NEAR(last(solution).reactions[0].y(), force, 1e-9 * force);
    // Stored: p^2 / (2 modulus) for each area of the bed, p^2 h / (2 E) in the disc.
    const double stored = 0.5 * p * force * (1.0 / modulus + 0.5 / 210e9);
    const double error = std::abs(last(solution).energy.elastic / stored - 1.0);
    EXPECT_LT(error, 0.5 * before);
    before = error;
  }
  EXPECT_LT(before, 1e-4);
}

// Under a uniform pressure p the block settles by p / modulus, and the bed stores p^2 / (2 modulus) per area.
TEST(Beds, SettleByThePressureOverTheModulus) {
  for (const int elements : {3, 8}) {
    const auto solution = run(block_on_bed(0.0, elements, "70e9"), {"loads.turn.moment=1e-12"});
    const double p = weight / base;
    for (const analysis::PairResult& pair : contact_of(last(solution)).pairs) {
      EXPECT_NEAR(pair.pressure, p, 1e-8 * p);
      EXPECT_NEAR(pair.displacement_b.x(), -p / modulus, 1e-8 * p / modulus);
    }
    EXPECT_NEAR(last(solution).energy.elastic, 0.5 * p * p / modulus * base + 0.5 * p * p / 70e9 * base * 0.5 * base,
                1e-8 * weight);
    EXPECT_NEAR(last(solution).energy.external, last(solution).energy.elastic, 1e-10 * weight);
  }
}

// A rigid block with a force at e > B / 6 from the middle lifts off: it is in contact over 3 (B / 2 - e), and the
// largest pressure is 2 F over that length. Pressures are linear where it is in contact, so that the length follows
// from two of them. With the springs at the nodes both are of second order in the size of the elements.
TEST(Beds, OfARigidBlockAreInContactOverThreeTimesTheRest) {
  for (const double e : {0.5, 0.8})
    for (const int elements : {20, 80, 320}) {
      const double length = 3.0 * (0.5 * base - e), largest = 2.0 * weight / length;
      const double second_order = std::pow(base / elements / length, 2);
      const auto solution = run(block_on_bed(e, elements, "70e15"));
      const analysis::ContactResult& bed = contact_of(last(solution));
      ASSERT_TRUE(bed.centre_of_pressure);
      EXPECT_NEAR(bed.normal_force, weight, 1e-8 * weight);
      EXPECT_NEAR(bed.centre_of_pressure->x(), e, 1e-8 * base);
      const analysis::PairResult &end = bed.pairs.back(), &before = bed.pairs[bed.pairs.size() - 2];
      const double slope = (end.pressure - before.pressure) / (end.position.x() - before.position.x());
      EXPECT_NEAR(end.pressure / slope, length, second_order * length);
      EXPECT_NEAR(end.pressure, largest, second_order * largest);
      EXPECT_GT(bed.open, 0);
      for (const analysis::PairResult& pair : bed.pairs) EXPECT_GE(pair.pressure, 0.0);
    }
}

TEST(Beds, AreTheSameWithSidesSwappedAndInMillimetres) {
  const auto one = run(block_on_bed(0.6, 20, "70e9")), swapped = run(block_on_bed(0.6, 20, "70e9", true)),
             millimetres = run(block_on_bed(0.6, 20, "70e3", false, 1e3));
  const analysis::ContactResult& bed = contact_of(last(one));
  for (std::size_t i = 0; i < bed.pairs.size(); ++i) {
    EXPECT_NEAR(contact_of(last(swapped)).pairs[i].normal_force, bed.pairs[i].normal_force, 1e-9 * weight);
    EXPECT_NEAR(contact_of(last(millimetres)).pairs[i].normal_force, bed.pairs[i].normal_force, 1e-8 * weight);
  }
}

// With friction on its surface, a bar to the ground, turned and mirrored.
TEST(Beds, DoNotDependOnTheAxes) {
  std::vector<double> forces, energies;
  for (const auto& [angle, side] : {std::pair(0.0, 1.0), std::pair(0.7, 1.0), std::pair(2.2, -1.0)}) {
    const auto point = [&, c = std::cos(angle), s = std::sin(angle), m = side](double x, double y) {
      return fmt::format("[{:.17g}, {:.17g}]", c * m * x - s * y, s * m * x + c * y);
    };
    const auto box = [&](double x, double y, double width, double height) {
      return fmt::format("{{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, top: edge_3}}}}}}",
                         point(x, y), point(x + width, y), point(x + width, y + height), point(x, y + height));
    };
    const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2}}}}
bodies:
  floor: {{rigid: true, shape: {}}}
  block: {{material: stuff, shape: {}, mesh: {{size: 0.2}}}}
supports: [{{on: floor, fix: [x, y]}}]
bars: {{rod: {{between: [block.vertex_3, {}], k: 1e6}}}}
loads: {{down: {{on: block.top, force: {}}}, turn: {{on: block.top, moment: {}}}}}
contacts: {{bed: {{between: [floor.top, block.bottom], modulus: {}, friction: 0.3}}}}
)",
                                          box(-4, -1, 8, 1), box(-1, 0, 2, 1), point(3, 2), point(2e4, -weight),
                                          -side * 0.5 * weight, modulus));
    forces.push_back(last(solution).bars[0]);
    energies.push_back(last(solution).energy.elastic);
    EXPECT_GT(contact_of(last(solution)).open, 0);
    EXPECT_NEAR(forces.back(), forces.front(), 1e-10 * weight);
    EXPECT_NEAR(energies.back(), energies.front(), 1e-10 * energies.front());
    EXPECT_NEAR(last(solution).energy.external - last(solution).energy.friction, energies.back(),
                1e-9 * energies.back() + last(solution).energy.friction_error);
  }
}

}  // namespace
}  // namespace scabo::verification
