// A coefficient of friction that differs by the direction of slip, in whole models: blocks that are pushed, that lie on
// an incline, that are shaken, and the same in other words.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "incline.hpp"
#include "run.hpp"

namespace scabo::verification {
namespace {

constexpr double forward = 0.2, backward = 0.5;
const std::string both = fmt::format("{{forward: {}, backward: {}}}", forward, backward);

/// A block of 2 x 1 m, pressed by 1000 N, on a floor; its top is driven by `drive`. Turned by `angle`.
std::string driven(const std::string& rest, const std::string& friction = both, double angle = 0.0,
                   bool floor_first = true, double young = 1e9) {
  const auto at = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", std::cos(angle) * x - std::sin(angle) * y,
                       std::sin(angle) * x + std::cos(angle) * y);
  };
  const auto box = [&](double x, double y, double width, double height) {
    return fmt::format(
        "{{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, right: edge_2, top: edge_3, left: "
        "edge_4}}}}}}",
        at(x, y), at(x + width, y), at(x + width, y + height), at(x, y + height));
  };
  return fmt::format(R"(scabo: 1
materials: {{m: {{young: {}, poisson: 0}}}}
bodies:
  floor: {{rigid: true, shape: {}}}
  block: {{material: m, shape: {}, mesh: {{size: 0.5}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: block.top, displacement: {{along: {}, value: 0.01}}, name: drive}}]
loads: {{press: {{on: block.top, pressure: 500}}}}
contacts: {{base: {{between: [{}], friction: {}}}}}
{})",
                     young, box(-1, -1, 8, 1), box(0, 0, 2, 1), at(1, 0),
                     floor_first ? "floor.top, block.bottom" : "block.bottom, floor.top", friction, rest);
}

const std::string one_way = "steps: [{loads: {press: 1}}, {increments: 4, loads: {drive: 1}}]\n";
const std::string other_way = "steps: [{loads: {press: 1}}, {increments: 4, loads: {drive: -1}}]\n";

TEST(FrictionByDirection, OfABlockPushedOneWayAndTheOther) {
  for (const double angle : {0.0, 0.7, -2.4})
    for (const bool floor_first : {true, false}) {
      const auto right = run(driven(one_way, both, angle, floor_first));
      const auto left = run(driven(other_way, both, angle, floor_first));
      EXPECT_NEAR(contact_of(last(right)).normal_force, 1000.0, 1e-9);
      EXPECT_NEAR(contact_of(last(right)).tangential_force, -1000.0 * forward, 1e-8);
      EXPECT_NEAR(contact_of(last(left)).tangential_force, 1000.0 * backward, 1e-8);
      EXPECT_NEAR(contact_of(last(right)).normal_force, 1000.0, 1e-8);
    }
}

const std::string falling = "{static: {forward: 0.3, backward: 0.8}, dynamic: {forward: 0.2, backward: 0.5}";

TEST(FrictionByDirection, FallsAtOnceToTheCoefficientOfItsDirection) {
  for (const double angle : {0.0, 2.2})
    for (const bool floor_first : {true, false}) {
      const auto right = run(driven(one_way, falling + "}", angle, floor_first));
      const auto left = run(driven(other_way, falling + "}", angle, floor_first));
      EXPECT_NEAR(contact_of(last(right)).tangential_force, -1000.0 * 0.2, 1e-8);
      EXPECT_NEAR(contact_of(last(left)).tangential_force, 1000.0 * 0.5, 1e-8);
    }
}

// The slip of every pair so far, of either direction, gives the coefficients of both; there and back.
TEST(FrictionByDirection, FallsWithAllSlip) {
  constexpr double distance = 0.02;
  const auto solution = run(
      driven("steps: [{loads: {press: 1}}, {increments: 4, loads: {drive: 1}}, {increments: 4, loads: {drive: 0.4}}]\n",
             falling + fmt::format(", slip_distance: {}}}", distance), 0.0, true, 1e7));
  last(solution);
  int forward_slips = 0, backward_slips = 0;
  std::vector<double> slip_before, all_slip;
  for (const analysis::IncrementResult& increment : solution.increments) {
    const auto& pairs = increment.contacts.front().pairs;
    slip_before.resize(pairs.size(), 0.0);
    all_slip.resize(pairs.size(), 0.0);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      all_slip[i] += std::abs(pairs[i].slip - slip_before[i]);
      const double fallen = std::min(all_slip[i] / distance, 1.0);
      if (pairs[i].state == contact::ContactState::slip) {
        const bool goes_forward = pairs[i].slip > slip_before[i];
        const double mu = goes_forward ? 0.3 - 0.1 * fallen : 0.8 - 0.3 * fallen;
        EXPECT_NEAR(pairs[i].tangential_force, (goes_forward ? -mu : mu) * pairs[i].normal_force, 1e-7);
        ++(goes_forward ? forward_slips : backward_slips);
      }
      slip_before[i] = pairs[i].slip;
    }
  }
  EXPECT_GT(forward_slips, 10);
  EXPECT_GT(backward_slips, 10);
}

/// Forces of all pairs of an increment.
std::vector<double> forces(const analysis::IncrementResult& increment) {
  std::vector<double> all;
  for (const analysis::PairResult& pair : increment.contacts.front().pairs) {
    all.push_back(pair.normal_force);
    all.push_back(pair.tangential_force);
  }
  return all;
}

TEST(FrictionByDirection, EqualInBothGivesEqualBits) {
  const std::string steps = R"(curves: {cycle: {table: [[0, 0], [1, 1], [3, -1], [4, 0]]}}
steps: [{loads: {press: 1}}, {increments: 8, loads: {drive: cycle}}]
)";
  const auto one = run(driven(steps, "0.3", 0.4, true, 1e6)),
             two = run(driven(steps, "{forward: 0.3, backward: 0.3}", 0.4, true, 1e6));
  ASSERT_EQ(one.increments.size(), two.increments.size());
  for (std::size_t k = 0; k < one.increments.size(); ++k)
    EXPECT_EQ(forces(increment_at(one, k)), forces(increment_at(two, k)));
  const auto plain = run(driven(steps, "{static: 0.4, dynamic: 0.3, slip_distance: 1e-3}", 0.4, true, 1e6)),
             each = run(driven(steps,
                               "{static: {forward: 0.4, backward: 0.4}, dynamic: {forward: 0.3, backward: 0.3}, "
                               "slip_distance: 1e-3}",
                               0.4, true, 1e6));
  ASSERT_EQ(plain.increments.size(), each.increments.size());
  for (std::size_t k = 0; k < plain.increments.size(); ++k)
    EXPECT_EQ(forces(increment_at(plain, k)), forces(increment_at(each, k)));
}

// In a cycle the base slides by 2 amplitudes each way, less what the block shears until it slips again:
// W = (mu_f + mu_b) N s, s = 2 amplitude - (mu_f + mu_b) N h / (G A). The increments in which slip reverses are small:
// in them the mean of the forces at both ends counts, which loses 2e-4 here.
TEST(FrictionByDirection, DissipatesTheLoopOfForceAndMotion) {
  const double N = 1000.0, amplitude = 0.01, G = 0.5e9;
  const auto solution = run(driven(R"(
curves: {cycle: {table: [[0, 0], [1, 1], [1.001, 0.999], [3, -1], [3.001, -0.999], [4, 0]]}}
steps: [{loads: {press: 1}}, {increments: 4, cycles: 3, loads: {drive: cycle}}]
)"));
  std::array<double, 5> dissipated{};  // at the end of every step
  for (const analysis::IncrementResult& increment : solution.increments)
    dissipated.at(static_cast<std::size_t>(increment.step)) = increment.energy.friction;
  EXPECT_LE(last(solution).certificate.worst(), 1e-10);
  const double expected = (forward + backward) * N * (2.0 * amplitude - (forward + backward) * N / (G * 2.0));
  for (const std::size_t cycle : {3u, 4u})
    EXPECT_NEAR(dissipated[cycle] - dissipated[cycle - 1], expected, 1e-3 * expected);
}

TEST(FrictionByDirection, HoldsOnAnInclineByTheCoefficientDownhill) {
  for (const double degrees : {8.0, 25.0, -8.0, -25.0}) {
    const double limit = std::tan(std::abs(degrees) * std::numbers::pi / 180.0);
    const auto friction = [&](double downhill, double uphill) {
      return fmt::format("friction: {{forward: {:.17g}, backward: {:.17g}}}", degrees > 0 ? downhill : uphill,
                         degrees > 0 ? uphill : downhill);
    };
    for (const double uphill : {0.0, 0.05, 3.0}) {
      const auto rests = run(incline(degrees, friction(limit * (1.0 + 1e-6), uphill)));
      const analysis::ContactResult& contact = contact_of(last(rests));
      EXPECT_NEAR(contact.tangential_force / contact.normal_force, degrees > 0 ? -limit : limit, 1e-9);
      const auto slides = run(incline(degrees, friction(limit * (1.0 - 1e-6), uphill)));
      EXPECT_EQ(slides.outcome, analysis::Outcome::mechanism) << slides.reason;
    }
  }
}

TEST(FrictionByDirection, IsChangedBySteps) {
  const auto solution = run(driven(
      "steps: [{loads: {press: 1}}, {increments: 4, loads: {drive: 1}}, {increments: 2, friction: {base: {forward: "
      "0.1, "
      "backward: 0.9}}, loads: {drive: 2}}, {increments: 2, loads: {drive: 0}}, {increments: 2, friction: {base: 0.4}, "
      "loads: {drive: 1}}]\n"));
  const auto end_of = [&](int step) {
    double force = 0.0;
    for (const auto& increment : solution.increments)
      if (increment.step == step) force = contact_of(increment).tangential_force;
    return force;
  };
  EXPECT_LE(last(solution).certificate.worst(), 1e-10);
  EXPECT_NEAR(end_of(2), -1000.0 * forward, 1e-8);
  EXPECT_NEAR(end_of(3), -100.0, 1e-8);
  EXPECT_NEAR(end_of(4), 900.0, 1e-8);
  EXPECT_NEAR(end_of(5), -400.0, 1e-8);
}

TEST(FrictionByDirection, ComesFromAPropertyAndForAllContacts) {
  const auto with = [&](const std::string& contact, const std::string& section) {
    return run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0}}}}
{}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [8, 1]}}}}}}
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.5}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: block.top, displacement: [-0.01, null]}}]
loads: {{press: {{on: block.top, pressure: 500}}}}
contacts: {{base: {{{}}}}}
)",
                           section, contact));
  };
  const std::string property = "contact_properties: {pawl: {friction: " + both + "}}";
  for (const auto& solution :
       {with("between: all, friction: " + both, ""), with("between: all, property: pawl", property),
        with("between: [block, floor], friction: " + both, ""),
        with("between: [block.bottom, floor.top], property: pawl", property)})
    EXPECT_NEAR(contact_of(last(solution)).tangential_force, 1000.0 * backward, 1e-8);
}

// A block on a spring is shaken by loads of the same amplitude to both sides. At a peak F it moves to where
// F - k x = mu_f N, or keeps its place; at -F it moves back to where F + k x = mu_b N, if that is nearer. So it drifts
// to the side of less friction: to x_1 = (F_1 - mu_f N) / k by the first peaks, and, as F_2 + k x_2 > mu_b N, from x_2
// = (F_2 - mu_f N) / k back to (mu_b N - F_2) / k by the second ones.
TEST(FrictionByDirection, LetsABlockThatIsShakenDriftToTheSideOfLessFriction) {
  const double N = 1000.0, k = 1e5, F = 300.0;
  const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 1e10, poisson: 0}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [8, 1]}}}}}}
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.5}}}}
supports: [{{on: floor, fix: [x, y]}}]
springs: [{{on: block.bottom, k_t: {}}}]
loads: {{press: {{on: block.top, pressure: 500}}, shake: {{on: block.bottom, traction: [{}, 0]}}}}
contacts: {{base: {{between: [floor.top, block.bottom], friction: {}}}}}
curves: {{quake: {{table: [[0, 0], [1, 1], [3, -1], [5, 1.2], [7, -1.2], [8, 0]]}}}}
steps: [{{loads: {{press: 1}}}}, {{increments: 8, loads: {{shake: quake}}}}]
)",
                                        k / 2.0, F / 2.0, both));
  const auto slip_at = [&](double part) {
    for (const auto& increment : solution.increments)
      if (increment.step == 2 && std::abs(increment.reached - part) < 1e-9) {
        double mean = 0.0;
        for (const auto& pair : increment.contacts.front().pairs)
          mean += pair.slip / static_cast<double>(increment.contacts.front().pairs.size());
        return mean;
      }
    throw std::runtime_error("no such increment");
  };
  EXPECT_LE(last(solution).certificate.worst(), 1e-10);
  const double first = (F - forward * N) / k, second = (1.2 * F - forward * N) / k;
  EXPECT_NEAR(slip_at(1.0 / 8), first, 1e-4 * first);
  EXPECT_NEAR(slip_at(3.0 / 8), first, 1e-4 * first);
  EXPECT_NEAR(slip_at(5.0 / 8), second, 1e-4 * second);
  const double back = (backward * N - 1.2 * F) / k;
  EXPECT_NEAR(slip_at(7.0 / 8), back, 1e-4 * back);
  EXPECT_NEAR(slip_at(1.0), back, 1e-4 * back);
}

// A crack that is closed by pressure and slides under shear of one sign or the other, as with that coefficient alone.
TEST(FrictionByDirection, OfAClosedCrackIsThatOfItsDirection) {
  const auto crack = [&](const std::string& friction, double shear) {
    return run(fmt::format(R"(scabo: 1
analysis: {{type: static, plane: strain}}
materials: {{m: {{young: 1e9, poisson: 0.2}}}}
bodies:
  plate:
    material: m
    shape: {{rectangle: {{corner: [0, 0], size: [4, 4]}}}}
    mesh: {{kind: polygons, size: 1}}
    cracks: [{{name: slit, path: [[0, 2], [2, 2]]}}]
supports: [{{on: plate.bottom, fix: [x, y]}}]
loads: {{press: {{on: plate.top, pressure: 1e6}}, shear: {{on: plate.top, traction: [{}, 0]}}}}
contacts: {{faces: {{between: [plate.slit.left, plate.slit.right], friction: {}}}}}
steps: [{{loads: {{press: 1}}}}, {{loads: {{shear: 1}}}}]
)",
                           shear, friction));
  };
  const std::string less = "{forward: 0.05, backward: 0.1}";
  const auto right = crack(less, 2.6e5), as_right = crack("0.05", 2.6e5), left = crack(less, -2.6e5),
             as_left = crack("0.1", -2.6e5);
  EXPECT_NEAR(contact_of(last(right)).tangential_force, contact_of(last(as_right)).tangential_force,
              1e-6 * std::abs(contact_of(last(as_right)).tangential_force));
  EXPECT_NEAR(contact_of(last(left)).tangential_force, contact_of(last(as_left)).tangential_force,
              1e-6 * std::abs(contact_of(last(as_left)).tangential_force));
  EXPECT_LT(contact_of(last(right)).tangential_force, 0.0);
  EXPECT_GT(contact_of(last(left)).tangential_force, 0.0);
}

}  // namespace
}  // namespace scabo::verification
