// Bodies of revolution against closed forms of half-spaces, a cavity and heat, each to 1e-3; conical seats, and sides
// that are divided differently. Half-spaces are hemispheres of radius 20 whose far boundary has the tractions of
// Boussinesq's force: what the load at its middle adds to them falls with the third power of the distance.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "run.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

constexpr double poisson_ratio = 0.3;
const std::string head =
    "scabo: 1\nanalysis: {plane: axisymmetric}\n"
    "materials: {m: {young: 1, poisson: 0.3, expansion: 1e-3}, soft: {young: 0.25, poisson: 0.3}}\nbodies:\n";

struct Values {
  Vec2 u;
  double radial, axial, shear, hoop;
};

Values values_at(const analysis::StaticSolution& solution, int body, const Vec2& x) {
  const auto values = result::value_at(solution, last(solution).fields, body, x);
  EXPECT_TRUE(values.has_value());
  const int material = solution.model.bodies[static_cast<std::size_t>(body)].material;
  const auto& loads = solution.model.loads;
  const bool warm = std::any_of(loads.begin(), loads.end(), [](const model::Load& load) {
    return std::holds_alternative<model::Temperature>(load.kind);
  });
  return {values->displacement, values->stress[0], values->stress[1], values->stress[2],
          element::stress_zz(values->stress, solution.model.materials[static_cast<std::size_t>(material)],
                             solution.model.analysis.plane, warm ? 2.0 + 3.0 * x.x() : 0.0, values->strain_zz)};
}

/// Boussinesq: a force P along -y on the half-space y < 0 with E = 1, at the depth z = -y.
struct Boussinesq {
  double P = 1.0, young = 1.0;

  Vec2 displacement(double r, double z) const {
    const double R = std::hypot(r, z), k = P * (1.0 + poisson_ratio) / (2.0 * pi * young);
    return {k * (r * z / (R * R * R) - (1.0 - 2.0 * poisson_ratio) * r / (R * (R + z))),
            -k * (2.0 * (1.0 - poisson_ratio) / R + z * z / (R * R * R))};
  }
  /// On the sphere about the origin.
  Vec2 traction(double r, double z) const {
    const double R = std::hypot(r, z), k = P / (2.0 * pi), R5 = std::pow(R, 5);
    const double rr = k * ((1.0 - 2.0 * poisson_ratio) / (R * (R + z)) - 3.0 * r * r * z / R5),
                 zz = -3.0 * k * z * z * z / R5, rz = -3.0 * k * r * z * z / R5;
    return {(rr * r + rz * z) / R, -(rz * r + zz * z) / R};
  }
};

constexpr double far = 20.0;

/// The tractions on the far boundary of the body below the surface, or of its mirror image above.
std::string far_tractions(const Boussinesq& of, bool above, double first_angle = 0.0) {
  constexpr int count = 400;
  std::vector<std::string> at, values;
  for (int k = 0; k <= count; ++k) {
    const int of_arc = above ? k : count - k;
    const double angle = first_angle + (0.5 * pi - first_angle) * of_arc / count, z = far * std::sin(angle),
                 r = of_arc == count ? 0.0 : far * std::cos(angle), sign = above ? 1.0 : -1.0;
    const Vec2 t = of.traction(r, z);
    at.push_back(fmt::format("[{:.17g}, {:.17g}]", r, sign * z));
    values.push_back(fmt::format("[{:.17g}, {:.17g}]", t.x(), -sign * t.y()));
  }
  return fmt::format("traction: {{at: [{}], values: [{}]}}", fmt::join(at, ", "), fmt::join(values, ", "));
}

std::string ground(const std::string& refine) {
  return fmt::format(R"(
  ground:
    material: m
    shape:
      outline:
        - {{line: {{from: [0, 0], to: [0, {0}]}}, name: axis}}
        - {{arc: {{to: [{1}, 0], centre: [0, 0]}}, name: far}}
        - {{line: {{to: [0, 0]}}, name: surface}}
    mesh: {{size: 3, refine: [{2}]}}
)",
                     -far, far, refine);
}

/// Holds the ground at the end of its axis where Boussinesq's force moves it.
std::string held(const Boussinesq& force) {
  return fmt::format("supports: [{{on: {{body: ground, near: [0, {}]}}, displacement: [null, {:.17g}]}}]\n", -far,
                     force.displacement(0.0, far).y());
}

TEST(RevolutionExact, BoussinesqsForce) {
  // VERIFICATION "Space": u_z at the surface r = 1 .289662; on the axis z = 1 u_z .496563, sigma_zz -.477465.
  const Boussinesq force;
  std::vector<double> errors;
  for (const double size : {0.2, 0.05}) {
    const auto solution = run(
        head +
        ground(fmt::format("{{near: [0, 0], size: {}, growth: {}}}, {{near: [0, -1], size: {}, growth: 0.1}}", size,
                           2.0 * size > 0.1 ? 0.2 : 0.07, 0.6 * size)) +
        held(force) + "loads:\n  point: {on: {body: ground, near: [0, 0]}, force: [0, -1]}\n  far: {on: ground.far, " +
        far_tractions(force, false) + "}\n");
    const Values surface = values_at(solution, 0, {1.0, 0.0}), axis = values_at(solution, 0, {0.0, -1.0});
    errors.push_back(std::abs(surface.u.y() + 0.289662));
    if (size > 0.1) continue;
    EXPECT_NEAR(surface.u.y(), -0.289662, 1e-3 * 0.289662);
    EXPECT_NEAR(axis.u.y(), -0.496563, 1e-3 * 0.496563);
    EXPECT_NEAR(axis.axial, -0.477465, 1e-3 * 0.477465);
    const Vec2 aside = force.displacement(0.7, 0.7);
    EXPECT_LT((values_at(solution, 0, {0.7, -0.7}).u - aside).norm(), 1e-3 * aside.norm());
  }
  EXPECT_GT(errors[0], 4.0 * errors[1]);
}

TEST(RevolutionExact, RigidCircularPunch) {
  // P = 2 a E* delta, a = 1; the pressure at its edge has no bound, so that the order is that of the size there.
  constexpr double P = 1e-3, modulus = 1.0 / (1.0 - poisson_ratio * poisson_ratio);
  std::vector<double> errors;
  for (const double size : {0.08, 0.01, 0.001}) {
    const Boussinesq force{P};
    const auto solution =
        run(head + ground(fmt::format("{{near: [1, 0], size: {}, growth: 0.2}}", size)) +
            "  punch: {rigid: true, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}}\n" + held(force) +
            "loads:\n  press: {on: punch, force: [0, -1e-3]}\n  far: {on: ground.far, " + far_tractions(force, false) +
            "}\ncontacts: {seat: {between: [ground.surface, punch.bottom], friction: 0}}\n");
    EXPECT_NEAR(contact_of(last(solution)).normal_force, P, 1e-9 * P);
    errors.push_back(std::abs(values_at(solution, 0, {0.0, 0.0}).u.y() * 2.0 * modulus / P + 1.0));
  }
  EXPECT_LT(errors[1], 1e-3);
  EXPECT_LT(errors[2], 3e-4);
  EXPECT_GT(errors[0], 4.0 * errors[1]);
}

/// Hertz's contact of radius a = 1 between a ball, 1e4 times as large, and a block: largest pressure, approach and
/// contact radius over the exact ones. The radius is that of Hertz's pressure with this force and largest pressure.
struct Hertz {
  double force, pressure, approach, radius;
};
Hertz hertz_contact(double size, const char* sides, bool ball_first = false) {
  constexpr double R = 1e4, soft = 0.25, ends_at = far * far / (2.0 * R);
  const double modulus = 1.0 / ((1.0 - poisson_ratio * poisson_ratio) * (1.0 + 1.0 / soft)),
               P = 4.0 * modulus / (3.0 * R), p0 = 3.0 * P / (2.0 * pi);
  const Boussinesq below{P, soft}, above{P, 1.0};
  std::string block = ground(fmt::format("{{near: [0, 0], size: {}, growth: {}}}", size, 2.0 * size > 0.2 ? 0.2 : 0.1));
  block.replace(block.find("material: m"), 11, "material: soft");
  const std::string ball =
      fmt::format(R"(
  ball:
    material: m
    shape:
      outline:
        - {{arc: {{from: [0, 0], to: [{0:.17g}, {1:.17g}], centre: [0, {2}]}}, name: face}}
        - {{arc: {{to: [0, {3}], centre: [0, 0]}}, name: far}}
        - {{line: {{to: [0, 0]}}, name: axis}}
    mesh: {{size: 3, refine: [{{near: [0, 0], size: {4}, growth: {5}}}]}}
)",
                  std::sqrt(far * far - ends_at * ends_at), ends_at, R, far, size, 2.0 * size > 0.2 ? 0.2 : 0.1);
  const auto solution = run(head + (ball_first ? ball + block : block + ball) +
                            fmt::format("supports: [{{on: {{body: ground, near: [0, {}]}}, fix: y}}]\n", -far) +
                            "loads:\n  below: {on: ground.far, " + far_tractions(below, false) +
                            "}\n  above: {on: ball.far, " + far_tractions(above, true, std::asin(ends_at / far)) +
                            "}\ncontacts: {touch: {between: [" + sides + "], friction: 0}}\n");
  const analysis::ContactResult& touch = contact_of(last(solution));
  const double moved = values_at(solution, ball_first ? 1 : 0, {0.0, -far}).u.y() -
                       values_at(solution, ball_first ? 0 : 1, {0.0, far}).u.y();
  const auto axis = std::min_element(touch.pairs.begin(), touch.pairs.end(),
                                     [](const auto& a, const auto& b) { return a.position.x() < b.position.x(); });
  return {touch.normal_force / P, axis->pressure / p0,
          R * (moved - below.displacement(0.0, far).y() - above.displacement(0.0, far).y()),
          std::sqrt(3.0 * touch.normal_force / (2.0 * pi * axis->pressure))};
}

TEST(RevolutionExact, HertzBallOnABlock) {
  std::array<Hertz, 3> of;
  for (std::size_t i = 0; i < 3; ++i) of[i] = hertz_contact(std::array{0.2, 0.1, 0.05}[i], "ground.surface, ball.face");
  const Hertz& fine = of[2];
  EXPECT_NEAR(fine.force, 1.0, 1e-5);
  EXPECT_NEAR(fine.pressure, 1.0, 1e-3);
  EXPECT_NEAR(fine.approach, 1.0, 1e-3);
  EXPECT_NEAR(fine.radius, 1.0, 1e-3);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_GT(std::abs(of[i].approach - 1.0), 2.0 * std::abs(of[i + 1].approach - 1.0));
  for (std::size_t i = 1; i < 3; ++i) EXPECT_GT(std::abs(of[0].pressure - 1.0), 4.0 * std::abs(of[i].pressure - 1.0));
}

TEST(RevolutionExact, OrderOfBodiesAndSidesChangesNothing) {
  const Hertz plain = hertz_contact(0.1, "ground.surface, ball.face"),
              reordered = hertz_contact(0.1, "ball.face, ground.surface", true);
  EXPECT_NEAR(reordered.force, plain.force, 1e-8);
  EXPECT_NEAR(reordered.pressure, plain.pressure, 1e-8);
  EXPECT_NEAR(reordered.approach, plain.approach, 1e-7);
}

TEST(RevolutionExact, CavityUnderTension) {
  // VERIFICATION "Space": equator 2.045455, pole -.681818.
  std::vector<double> errors;
  for (const double size : {0.2, 0.05}) {
    const auto solution = run(head +
                              fmt::format(R"(
  body:
    material: m
    shape:
      outline:
        - {{line: {{from: [1, 0], to: [20, 0]}}, name: equator}}
        - {{line: {{to: [20, 20]}}, name: side}}
        - {{line: {{to: [0, 20]}}, name: top}}
        - {{line: {{to: [0, 1]}}, name: axis}}
        - {{arc: {{to: [1, 0], centre: [0, 0], direction: clockwise}}, name: cavity}}
    mesh: {{size: 4, refine: [{{on: cavity, size: {}, growth: 0.15}}]}}
)",
                                          size) +
                              "supports: [{on: body.equator, fix: y}]\nloads: {pull: {on: body.top, pressure: -1}}\n");
    const Values equator = values_at(solution, 0, {1.0, 0.0}), pole = values_at(solution, 0, {0.0, 1.0});
    errors.push_back(std::abs(pole.hoop + 0.681818));
    EXPECT_NEAR(pole.radial, pole.hoop, 1e-9);
    if (size > 0.1) continue;
    EXPECT_NEAR(equator.axial, 2.045455, 1e-3 * 2.045455);
    EXPECT_NEAR(pole.hoop, -0.681818, 1e-3 * 0.681818);
  }
  EXPECT_GT(errors[0], 4.0 * errors[1]);
}

// --- Heat: T = 2 + 3 r, E = 1, expansion 1e-3 ---

std::string heated(double inner, double height, double size, const std::string& supports) {
  return head +
         fmt::format(
             "  ring: {{material: m, shape: {{rectangle: {{corner: [{}, 0], size: [1, {}]}}}}, mesh: {{size: {}}}}}\n",
             inner, height, size) +
         "supports: [" + supports + "]\nloads: {heat: {temperature: {constant: 2, x: 3}}}\n";
}

TEST(RevolutionExact, HeatedDisc) {
  // Thin: radial stress 1e-3 (1 - r), hoop stress 1e-3 (1 - 2 r), u(1) = 4e-3. The displacement is a polynomial of
  // second order, so that the mesh does not matter; what is left is of the order of the thickness, and of the stress
  // that the kink of T on the axis causes within a thickness of it.
  for (const double size : {0.25, 0.125}) {
    const auto solution = run(heated(0.0, 0.002, size, "{on: ring.bottom, fix: y}"));
    EXPECT_NEAR(values_at(solution, 0, {1.0, 0.001}).u.x(), 4e-3, 1e-5 * 4e-3);
    EXPECT_NEAR(values_at(solution, 0, {1.0, 0.001}).hoop, -1e-3, 1e-7);
    EXPECT_NEAR(values_at(solution, 0, {0.5, 0.001}).radial, 0.5e-3, 1e-7);
    EXPECT_NEAR(values_at(solution, 0, {0.0, 0.001}).hoop, 1e-3, 1e-6);
  }
}

TEST(RevolutionExact, HeatedTube) {
  // Held along its axis, with I(r) the integral of T r from the inner radius 1.
  const auto I = [](double r) { return (r * r - 1.0) + (r * r * r - 1.0); };
  const auto u = [&](double r) {
    return 1e-3 * 1.3 / 0.7 / r * (((1.0 - 2.0 * poisson_ratio) * r * r + 1.0) / 3.0 * I(2.0) + I(r));
  };
  const double hoop = 1e-3 / 0.7 * (2.0 / 3.0 * I(2.0) - 5.0);
  std::vector<double> errors, of_stress;
  for (const double size : {0.25, 0.125, 0.0625, 0.03125}) {
    const auto solution = run(heated(1.0, 0.25, size, "{on: ring.bottom, fix: y}, {on: ring.top, fix: y}"));
    const Values inner = values_at(solution, 0, {1.0, 0.125});
    EXPECT_NEAR(inner.u.x(), u(1.0), 1e-3 * u(1.0));
    EXPECT_NEAR(values_at(solution, 0, {2.0, 0.125}).u.x(), u(2.0), 1e-3 * u(2.0));
    errors.push_back(std::abs(inner.u.x() - u(1.0)));
    of_stress.push_back(std::abs(inner.hoop - hoop));
  }
  EXPECT_GT(errors[0], 8.0 * errors[1]);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GT(of_stress[i], 3.0 * of_stress[i + 1]);
  EXPECT_LT(of_stress.back(), 1e-3 * std::abs(hoop));
}

// --- Conical seats and sides that are divided differently ---

TEST(RevolutionExact, ConicalSeatSlidesAndSticks) {
  // The seat leans by atan(0.2) from the axis; along it act N sin b + T cos b, and T = mu N where all slides.
  const double b = std::atan(0.2);
  for (const double mu : {0.1, 5.0}) {
    const auto solution = run(head + fmt::format(R"(
  plug:
    material: m
    shape: {{polygon: {{vertices: [[0, 0], [1, 0], [1.2, 1], [0, 1]], names: {{side: edge_2, top: edge_3}}}}}}
    mesh: {{size: 0.25}}
  ring:
    material: m
    shape: {{polygon: {{vertices: [[1, 0], [2.5, 0], [2.5, 1], [1.2, 1]], names: {{foot: edge_1, seat: edge_4}}}}}}
    mesh: {{size: 0.25}}
supports: [{{on: ring.foot, fix: [x, y]}}, {{name: push, on: plug.top, displacement: [null, -0.01]}}]
contacts: {{cone: {{between: [ring.seat, plug.side], friction: {}}}}}
)",
                                                 mu));
    const analysis::ContactResult& cone = contact_of(last(solution));
    const double along = cone.normal_force * std::sin(b) + std::abs(cone.tangential_force) * std::cos(b);
    EXPECT_EQ(cone.open, 0);
    EXPECT_EQ(mu < 1.0 ? cone.stick : cone.slip, 0);
    EXPECT_NEAR(last(solution).reactions[0].y(), along, 1e-12);
    EXPECT_NEAR(last(solution).reactions[1].y(), -along, 1e-12);
    const double bound = cone.normal_force * (std::sin(b) + mu * std::cos(b));
    EXPECT_NEAR(along, mu < 1.0 ? bound : std::min(along, bound), 1e-12);
  }
}

TEST(RevolutionExact, UniformPressurePassesSidesThatAreDividedDifferently) {
  for (const auto& [below, above] : {std::array{0.25, 0.1}, std::array{0.1, 0.3}}) {
    const auto solution = run(head + fmt::format(R"(
  low: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [1, 0.5]}}}}, mesh: {{size: {}}}}}
  up: {{material: m, shape: {{rectangle: {{corner: [0, 0.5], size: [1, 0.5]}}}}, mesh: {{size: {}}}}}
supports: [{{on: low.bottom, fix: y}}]
loads: {{press: {{on: up.top, pressure: 0.01}}}}
contacts: {{joint: {{between: [low.top, up.bottom], friction: 0.3}}}}
)",
                                                 below, above));
    for (const analysis::PairResult& pair : contact_of(last(solution)).pairs) EXPECT_NEAR(pair.pressure, 0.01, 1e-11);
    EXPECT_NEAR(values_at(solution, 0, {0.37, 0.21}).axial, -0.01, 1e-11);
    EXPECT_NEAR(values_at(solution, 1, {0.61, 0.83}).hoop, 0.0, 1e-11);
  }
}

// Forces of one radian: those of the whole circumference over 2 pi; pressures, displacements and slips are the same.
TEST(Revolution, ForcesOfOneRadianAreThoseOfTheWholeCircumferenceOverTwoPi) {
  const auto fit = [](const std::string& forces, double push) {
    return run(fmt::format(R"(
scabo: 1
analysis: {{plane: axisymmetric{}}}
materials: {{steel: {{young: 210e9, poisson: 0.3, density: 7850}}}}
bodies:
  shaft: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [0.05, 0.2]}}}}, mesh: {{size: 0.025}}}}
  hub: {{material: steel, shape: {{rectangle: {{corner: [0.05, 0.06], size: [0.05, 0.08]}}}}, mesh: {{size: 0.025}}}}
supports: [{{on: shaft.bottom, fix: y}}]
loads:
  push: {{on: hub.top_right, force: [0, {}]}}
  squeeze: {{on: hub.right, pressure: 2e6}}
  spin: {{on: shaft, spin: 300}}
contacts: {{fit: {{between: [shaft.right, hub.left], gap: -2e-5, friction: 0.2}}}}
)",
                           forces, push));
  };
  const auto whole = fit("", 1e3 * 2.0 * pi), radian = fit(", forces: per_radian", 1e3);
  const analysis::ContactResult &a = contact_of(last(whole)), &b = contact_of(last(radian));
  EXPECT_NEAR(b.normal_force * 2.0 * pi / a.normal_force, 1.0, 1e-10);
  EXPECT_NEAR(b.tangential_force * 2.0 * pi / a.tangential_force, 1.0, 1e-9);
  EXPECT_NEAR(b.tangential_force, 1e3, 1e-6);  // on the hub, along t: down, against the push
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t i = 0; i < a.pairs.size(); ++i)
    EXPECT_NEAR(b.pairs[i].pressure, a.pairs[i].pressure, 1e-9 * a.max_pressure);
  EXPECT_NEAR(last(radian).energy.elastic * 2.0 * pi / last(whole).energy.elastic, 1.0, 1e-10);
}

}  // namespace
}  // namespace scabo::verification
