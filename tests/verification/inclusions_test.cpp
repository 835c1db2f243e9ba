// Stress inside bodies that other tests only see from their boundary: inclusions in the infinite plane (Eshelby;
// Goodier), a hole in an orthotropic plate (Lekhnitskii), a disc between two forces (Hertz), a strip of two metals
// (Timoshenko), and the work of friction along a bar that is pulled and pushed on a rigid foundation.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

using element::Mat3;
using element::Vec3;
constexpr double pi = std::numbers::pi;

/// Stress along axes that are turned by `angle` against those of the argument.
Vec3 turned(const Vec3& s, double angle) {
  const double c = std::cos(angle), n = std::sin(angle);
  return {s[0] * c * c + s[1] * n * n + 2.0 * s[2] * c * n, s[0] * n * n + s[1] * c * c - 2.0 * s[2] * c * n,
          (s[1] - s[0]) * c * n + s[2] * (c * c - n * n)};
}

std::string text_of(const Vec3& s) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", s[0], s[1], s[2]); }

/// A disc of radius 1.5 around (1, 2) in the infinite plane.
std::string disc_in_plane(const std::string& plane, const std::string& rest) {
  return fmt::format(R"(
scabo: 1
analysis: {{plane: {}, thickness: 0.5}}
materials: {{rock: {{young: 1e5, poisson: 0.3}}, metal: {{young: 3e5, poisson: 0.2, expansion: 1e-4}}}}
bodies:
  ground:
    material: rock
    outside: true
    shape: {{circle: {{centre: [1, 2], radius: 1.5}}}}
    mesh: {{size: 0.6, order: 6}}
  disc:
    material: metal
    shape: {{circle: {{centre: [1, 2], radius: 1.5}}}}
    mesh: {{size: 0.6, order: 6}}
{})",
                     plane, rest);
}

const double E = 1e5, nu = 0.3, mu = 0.5 * E / (1.0 + nu), E_disc = 3e5, nu_disc = 0.2;

// A disc that is heated by 10 K: pressure p between it and the plane, everywhere in it and, with the square of the
// distance less, around it.
TEST(Inclusion, ThatIsHeatedHasThePressureOfEshelby) {
  const double free_strain = 1e-4 * 10.0, area = pi * 1.5 * 1.5 * 0.5;
  for (const bool strain : {false, true}) {
    const auto solution = run(disc_in_plane(strain ? "strain" : "stress", R"(
ties: {rim: {between: [ground.rim, disc.rim]}}
loads: {heat: {on: disc, temperature: {constant: 10}}}
)"));
    const double p = strain
                         ? (1.0 + nu_disc) * free_strain / (0.5 / mu + (1.0 + nu_disc) * (1.0 - 2.0 * nu_disc) / E_disc)
                         : free_strain / (0.5 / mu + (1.0 - nu_disc) / E_disc);
    const analysis::IncrementResult& increment = last(solution);
    const result::Probe ground(solution, increment.fields, 0), disc(solution, increment.fields, 1);
    EXPECT_LE((disc.at({1.3, 2.4})->stress - Vec3(-p, -p, 0.0)).norm(), 1e-8 * p);
    const double angle = std::atan2(0.8, 0.6), ratio = std::pow(1.5 / 2.5, 2);
    const Vec3 around = turned(ground.at({1.0 + 2.5 * 0.6, 2.0 + 2.5 * 0.8})->stress, angle);
    EXPECT_LE((around - Vec3(-p * ratio, p * ratio, 0.0)).norm(), 1e-7 * p);
    // Energy: of the plane, and of the stress in the disc, the one across the plane included.
    const double across = strain ? -2.0 * nu_disc * p - E_disc * free_strain : 0.0;
    const double in_disc =
        0.5 * (2.0 * p * p + across * across - 2.0 * nu_disc * (p * p - 2.0 * p * across)) / E_disc * area;
    const double in_plane = 0.5 * p * p / mu * area;
    EXPECT_NEAR(increment.energy.elastic, in_disc + in_plane, 1e-10 * in_plane);
    EXPECT_NEAR(increment.energy.external, in_disc + in_plane, 1e-10 * in_plane);
  }
}

// Another material in a plane under tension far away, at 33 degrees. At rest both have the same strain.
TEST(Inclusion, InAPlaneUnderTensionHasTheStressOfGoodier) {
  const double angle = 33.0 * pi / 180.0, beta = E_disc / (1.0 + nu_disc) / (E / (1.0 + nu));
  for (const bool strain : {false, true}) {
    const auto kolosov = [&](double poisson) {
      return strain ? 3.0 - 4.0 * poisson : (3.0 - poisson) / (1.0 + poisson);
    };
    const auto law = [&](double young, double poisson) {
      if (strain) young /= 1.0 - poisson * poisson, poisson /= 1.0 - poisson;
      Mat3 D = Mat3::Zero();
      D << 1.0, poisson, 0.0, poisson, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - poisson);
      return Mat3(young / (1.0 - poisson * poisson) * D);
    };
    const double k = kolosov(nu), k_disc = kolosov(nu_disc);
    const double mean = 0.5 * beta * (k + 1.0) / (2.0 * beta + k_disc - 1.0),
                 half = 0.5 * beta * (k + 1.0) / (beta * k + 1.0);
    const Vec3 far(1.0, 0.0, 0.0), rest = law(E_disc, nu_disc) * law(E, nu).inverse() * far;
    const auto solution = run(disc_in_plane(strain ? "strain" : "stress",
                                            fmt::format(R"(
contacts: {{rim: {{between: [ground.rim, disc.rim], bond: true}}}}
loads:
  far: {{on: ground, field: {{stress: {}}}}}
  near: {{on: disc, field: {{stress: {}}}}}
)",
                                                        text_of(turned(far, -angle)), text_of(turned(rest, -angle)))));
    const result::Probe disc(solution, last(solution).fields, 1);
    EXPECT_LE((disc.at({1.3, 2.4})->stress - turned(Vec3(mean + half, mean - half, 0.0), -angle)).norm(), 1e-9);
  }
}

// Tension along the stiffer axis of an orthotropic plate, whose axes are turned: hoop stress around the hole.
TEST(OrthotropicPlate, HasTheStressOfLekhnitskiiAroundItsHole) {
  const double E1 = 3e5, E2 = 1e5, nu12 = 0.25, G = 4e4;
  const double k = std::sqrt(E1 / E2), n = std::sqrt(2.0 * (k - nu12) + E1 / G);
  for (const double degrees : {0.0, 25.0}) {
    const double axis = degrees * pi / 180.0;
    const auto solution = run(fmt::format(
        R"(
scabo: 1
materials: {{wood: {{orthotropic: {{E1: {}, E2: {}, nu12: {}, G12: {}, angle: {}}}}}}}
bodies:
  plate: {{material: wood, outside: true, shape: {{circle: {{centre: [0, 0], radius: 2}}}}, mesh: {{size: 0.8, order: 8}}}}
loads: {{far: {{on: plate, field: {{stress: {}}}}}}}
)",
        E1, E2, nu12, G, degrees, text_of(turned({1.0, 0.0, 0.0}, -axis))));
    const result::Probe plate(solution, last(solution).fields, 0);
    for (const double angle : {0.05, 0.7, 1.2, 1.57}) {
      const double c = std::pow(std::cos(angle), 2), s = 1.0 - c;
      const double along = 1.0 / (s * s / E1 + (1.0 / G - 2.0 * nu12 / E1) * s * c + c * c / E2);
      const Vec2 x = 2.0000002 * Vec2(std::cos(axis + angle), std::sin(axis + angle));
      EXPECT_NEAR(turned(plate.at(x)->stress, axis + angle)[1], along / E1 * ((1.0 + n) * s - k * c), 1e-4) << angle;
    }
  }
}

// Two forces on a diameter: the stress of two point forces and a tension from all sides.
TEST(Disc, BetweenTwoForcesHasTheStressOfHertz) {
  const auto solution = run(R"(
scabo: 1
analysis: {thickness: 0.7}
materials: {rock: {young: 1e5, poisson: 0.3}}
bodies:
  disc:
    material: rock
    shape:
      outline:
        - {arc: {from: [0, -1], to: [1, 0], centre: [0, 0]}}
        - {arc: {to: [0, 1], centre: [0, 0]}}
        - {arc: {to: [-1, 0], centre: [0, 0]}}
        - {arc: {to: [0, -1], centre: [0, 0]}}
    mesh: {size: 0.2, order: 5}
supports: [{on: disc.vertex_1, fix: [x, y]}, {on: disc.vertex_3, fix: x}]
loads: {press: {on: disc.vertex_3, force: [0, -1000]}}
)");
  const result::Probe disc(solution, last(solution).fields, 0);
  const double p = 1000.0 / (pi * 0.7);
  for (const Vec2& x : {Vec2(0.3, 0.2), Vec2(-0.11, 0.43), Vec2(0.52, -0.37)}) {
    Vec3 expected(p, p, 0.0);
    for (const double y : {1.0, -1.0}) {
      const Vec2 d = x - Vec2(0.0, y);
      const double size = -2.0 * p * std::abs(d.y()) / std::pow(d.squaredNorm(), 2);
      expected += size * Vec3(d.x() * d.x(), d.y() * d.y(), d.x() * d.y());
    }
    EXPECT_LE((disc.at(x)->stress - expected).norm(), 1e-5 * p) << x.x() << ", " << x.y();
  }
}

// A strip of two layers, heated: stress in the middle by the theory of beams, exact far from the ends.
TEST(StripOfTwoMetals, BendsAsTimoshenkosThermostat) {
  const double E1 = 1e5, E2 = 3e5, poisson = 0.25, h1 = 0.3, h2 = 0.2, heat = 20.0, a1 = 1e-4, a2 = 2e-5;
  for (const bool strain : {false, true}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: {}, thickness: 0.4}}
materials:
  lower: {{young: {}, poisson: {}, expansion: {}}}
  upper: {{young: {}, poisson: {}, expansion: {}}}
bodies:
  strip:
    material: lower
    shape: {{rectangle: {{corner: [0, 0], size: [5, 0.5]}}}}
    regions: {{top: {{material: upper, shape: {{rectangle: {{corner: [-1, 0.3], size: [7, 1]}}}}}}}}
    mesh: {{kind: polygons, size: 0.15, order: 3}}
supports: [{{on: strip.left, fix: x}}, {{on: strip.bottom_left, fix: y}}]
loads: {{heat: {{temperature: {{constant: {}}}}}}}
)",
                                          strain ? "strain" : "stress", E1, poisson, a1, E2, poisson, a2, heat));
    const double f = strain ? 1.0 / (1.0 - poisson * poisson) : 1.0, g = strain ? 1.0 + poisson : 1.0, h = h1 + h2;
    Eigen::Matrix2d A;  // no force and no moment: strain e + k y
    A(0, 0) = f * (E1 * h1 + E2 * h2);
    A(0, 1) = A(1, 0) = 0.5 * f * (E1 * h1 * h1 + E2 * (h * h - h1 * h1));
    A(1, 1) = f / 3.0 * (E1 * std::pow(h1, 3) + E2 * (std::pow(h, 3) - std::pow(h1, 3)));
    const Vec2 b =
        f * g * heat * Vec2(E1 * a1 * h1 + E2 * a2 * h2, 0.5 * (E1 * a1 * h1 * h1 + E2 * a2 * (h * h - h1 * h1)));
    const Vec2 e = A.inverse() * b;
    const result::Probe strip(solution, last(solution).fields, 0);
    for (const double y : {0.02, 0.14, 0.28, 0.33, 0.47}) {
      const bool lower = y < h1;
      const double expected = f * (lower ? E1 : E2) * (e[0] + e[1] * y - g * (lower ? a1 : a2) * heat);
      EXPECT_LE((strip.at({2.4, y})->stress - Vec3(expected, 0.0, 0.0)).norm(), 0.02) << y;
    }
  }
}

// A thin bar that lies on a rigid foundation under uniform pressure and is pulled and pushed at its end by a force F.
// With q = mu p for each length: it moves by F^2 / (2 E A q), loses F^3 / (6 E A q) at first and 2 F^3 / (3 E A q) in
// every cycle.
TEST(BarOnAFoundation, LosesTheWorkOfFrictionInEveryCycle) {
  const auto solution = run(R"(
scabo: 1
analysis: {thickness: 0.7}
materials: {steel: {young: 1e5, poisson: 0}}
bodies:
  ground: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [5, 1]}}}
  bar: {material: steel, shape: {rectangle: {corner: [0, 0], size: [3, 0.05]}}, mesh: {kind: fem, size: 0.05}}
supports: [{on: ground, fix: [x, y]}]
loads:
  press: {on: bar.top, pressure: 2}
  pull: {on: bar.right, traction: [1, 0]}
contacts: {joint: {between: [ground.top, bar.bottom], friction: 0.4}}
steps:
  - {loads: {press: 1}}
  - {increments: 4, loads: {pull: 40}}
  - {increments: 6, loads: {pull: -40}}
  - {increments: 6, loads: {pull: 40}}
)");
  const double F = 40.0 * 0.05 * 0.7, q = 0.4 * 2.0 * 0.7, EA = 1e5 * 0.05 * 0.7;
  const auto lost = [&](std::size_t increment) { return increment_at(solution, increment).energy.friction; };
  EXPECT_NEAR(lost(4), F * F * F / (6.0 * EA * q), 5e-2 * lost(4));
  EXPECT_NEAR(lost(16) - lost(4), 2.0 * F * F * F / (3.0 * EA * q), 5e-2 * (lost(16) - lost(4)));
  const analysis::Energy& energy = last(solution).energy;
  EXPECT_NEAR(energy.external, energy.elastic + energy.friction, 1e-2 * energy.friction);
}

}  // namespace
}  // namespace scabo::verification
