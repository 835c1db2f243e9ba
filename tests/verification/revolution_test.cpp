// Bodies of revolution against closed forms: Lame's cylinder and sphere, rotation, a press fit, Hertz's sphere;
// patches, motion without force, and twins.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "run.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

constexpr double nu = 0.3;

std::string model(const std::string& bodies, const std::string& rest) {
  return "scabo: 1\nanalysis: {plane: axisymmetric}\nmaterials: {m: {young: 1, poisson: 0.3, density: 1}}\nbodies:\n" +
         bodies + rest;
}

std::string block(const char* name, double x, double y, double width, double height, double size, int order) {
  return fmt::format(
      "  {}: {{material: m, shape: {{rectangle: {{corner: [{}, {}], size: [{}, {}]}}}}, mesh: {{size: {}, order: "
      "{}}}}}\n",
      name, x, y, width, height, size, order);
}

struct Point {
  Vec2 u;
  double radial, axial, shear, hoop;
};

Point at(const analysis::StaticSolution& solution, int body, const Vec2& x) {
  const auto values = result::value_at(solution, last(solution).fields, body, x);
  EXPECT_TRUE(values.has_value());
  const auto b = static_cast<std::size_t>(body);
  const int material = solution.model.bodies[b].material;
  return {values->displacement, values->stress[0], values->stress[1], values->stress[2],
          element::stress_zz(values->stress, solution.model.materials[static_cast<std::size_t>(material)],
                             solution.model.analysis.plane, 0.0, values->strain_zz)};
}

// --- Patches ---

struct Patch {
  const char* name;
  const char* shape;
  int order;
};
class RevolutionPatch : public testing::TestWithParam<Patch> {
 protected:
  std::string body() const {
    return fmt::format("  part: {{material: m, shape: {{{}}}, mesh: {{size: 0.4, order: {}}}}}\n", GetParam().shape,
                       GetParam().order);
  }
};

TEST_P(RevolutionPatch, UniformAxialStress) {
  const auto solution = run(model(body(), R"(
supports: [{on: part.bottom, fix: y}]
loads: {pull: {on: part.top, pressure: -0.01}}
)"));
  for (const Vec2& x : {Vec2(0.5, 0.3), Vec2(0.9, 0.71), Vec2(0.62, 0.02)}) {
    const Point found = at(solution, 0, x);
    EXPECT_NEAR(found.axial, 0.01, 1e-12);
    EXPECT_NEAR(found.radial, 0.0, 1e-12);
    EXPECT_NEAR(found.hoop, 0.0, 1e-12);
    EXPECT_NEAR(found.shear, 0.0, 1e-12);
    EXPECT_LT((found.u - Vec2(-nu * 0.01 * x.x(), 0.01 * x.y())).norm(), 1e-12);
  }
}

TEST_P(RevolutionPatch, UniformRadialAndHoopStress) {
  const bool hollow = std::string_view(GetParam().name).starts_with("Hollow");
  const auto solution = run(model(body(), fmt::format(R"(
supports: [{{on: part.bottom, fix: y}}]
loads:
  press: {{on: part.right, pressure: 0.02}}
  {}
)",
                                                      hollow ? "bore: {on: part.left, pressure: 0.02}" : "")));
  for (const Vec2& x : {Vec2(0.5, 0.3), Vec2(0.9, 0.71), Vec2(0.62, 0.02)}) {
    const Point found = at(solution, 0, x);
    EXPECT_NEAR(found.radial, -0.02, 2e-12);
    EXPECT_NEAR(found.hoop, -0.02, 2e-12);
    EXPECT_NEAR(found.axial, 0.0, 2e-12);
    EXPECT_LT((found.u - Vec2(-(1.0 - nu) * 0.02 * x.x(), 2.0 * nu * 0.02 * x.y())).norm(), 2e-12);
  }
  if (hollow) return;
  const Point on_axis = at(solution, 0, Vec2(0.0, 0.5));
  EXPECT_NEAR(on_axis.radial, -0.02, 2e-12);
  EXPECT_NEAR(on_axis.hoop, -0.02, 2e-12);
  EXPECT_NEAR(on_axis.u.x(), 0.0, 1e-17);
}

TEST_P(RevolutionPatch, TranslationAlongTheAxisHasNoForce) {
  const auto solution = run(model(body(), "supports: [{on: part.bottom, displacement: [null, 1]}]\n"));
  const analysis::IncrementResult& increment = last(solution);
  EXPECT_NEAR(increment.reactions[0].norm(), 0.0, 1e-13);
  EXPECT_LT((at(solution, 0, {0.9, 0.7}).u - Vec2(0.0, 1.0)).norm(), 1e-12);
  EXPECT_NEAR(increment.energy.elastic, 0.0, 1e-24);
}

constexpr const char* solid = "rectangle: {corner: [0, 0], size: [1, 1]}";
constexpr const char* hollow = "rectangle: {corner: [0.3, 0], size: [0.7, 1]}";
constexpr const char* triangles =
    "polygon: {vertices: [[0, 0], [1, 0], [1, 1], [0, 1]], names: {bottom: edge_1, right: edge_2, top: edge_3}}";

INSTANTIATE_TEST_SUITE_P(Bodies, RevolutionPatch,
                         testing::Values(Patch{"SolidOrder1", solid, 1}, Patch{"SolidOrder2", solid, 2},
                                         Patch{"HollowOrder1", hollow, 1}, Patch{"HollowOrder2", hollow, 2},
                                         Patch{"TrianglesOrder1", triangles, 1},
                                         Patch{"TrianglesOrder2", triangles, 2}),
                         [](const auto& of) { return std::string(of.param.name); });

// --- Cylinders, spheres and rotation, with their order in the mesh ---

/// Errors at sizes h and h / 2 fall at least with the power `rate`.
void expect_rate(double coarse, double fine, double rate, const std::string& what) {
  EXPECT_GT(std::log2(coarse / fine), rate) << what << ": " << coarse << ", " << fine;
}

TEST(Revolution, ThickCylinderIsLames) {
  // Plane strain, a = 1, b = 2, p = 1: u = (1 + nu) / E a^2 / (b^2 - a^2) ((1 - 2 nu) r + b^2 / r).
  const auto u = [](double r) { return 1.3 / 3.0 * ((1.0 - 2.0 * nu) * r + 4.0 / r); };
  const auto hoop = [](double r) { return (1.0 + 4.0 / (r * r)) / 3.0; };
  for (const int order : {1, 2}) {
    std::vector<double> displacement, stress;
    for (const double size : {0.25, 0.125, 0.0625, 0.03125}) {
      const auto solution = run(model(block("tube", 1, 0, 1, 0.5, size, order), R"(
supports: [{on: tube.bottom, fix: y}, {on: tube.top, fix: y}]
loads: {inside: {on: tube.left, pressure: 1}}
)"));
      const Point inner = at(solution, 0, {1.0, 0.25}), middle = at(solution, 0, {1.5, 0.25});
      displacement.push_back(std::abs(inner.u.x() - u(1.0)));
      stress.push_back(std::abs(inner.hoop - hoop(1.0)));
      if (order == 2) {
        EXPECT_NEAR(inner.u.x(), u(1.0), 1e-3 * u(1.0));
        EXPECT_NEAR(middle.u.x(), u(1.5), 1e-3 * u(1.5));
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      expect_rate(displacement[i], displacement[i + 1], order == 1 ? 1.7 : 3.0, fmt::format("displacement, {}", order));
      expect_rate(stress[i], stress[i + 1], order == 1 ? 0.7 : 1.7, fmt::format("stress, {}", order));
    }
    if (order == 2) {
      EXPECT_LT(stress.back(), 1e-3 * hoop(1.0));
    }
  }
}

TEST(Revolution, ThickSphereUnderPressure) {
  // VERIFICATION "Space": u(a) = .8, u(b) = .3, hoop at a = .714286.
  std::vector<double> displacement, stress;
  for (const double size : {0.25, 0.125, 0.03}) {
    const auto solution = run(model(fmt::format(R"(
  shell:
    material: m
    shape:
      outline:
        - {{line: {{from: [1, 0], to: [2, 0]}}, name: equator}}
        - {{arc: {{to: [0, 2], centre: [0, 0]}}, name: outside}}
        - {{line: {{to: [0, 1]}}, name: axis}}
        - {{arc: {{to: [1, 0], centre: [0, 0], direction: clockwise}}, name: inside}}
    mesh: {{size: {}}}
)",
                                                size),
                                    R"(
supports: [{on: shell.equator, fix: y}]
loads: {inside: {on: shell.inside, pressure: 1}}
)"));
    const Point equator = at(solution, 0, {1.0, 0.0}), pole = at(solution, 0, {0.0, 2.0});
    displacement.push_back(std::abs(pole.u.y() - 0.3));
    EXPECT_NEAR(equator.u.x(), 0.8, 0.8e-3);
    if (size < 0.2) {
      EXPECT_NEAR(pole.u.y(), 0.3, 0.3e-3);
    }
    stress.push_back(std::abs(equator.hoop - 5.0 / 7.0));
  }
  expect_rate(displacement[0], displacement[1], 2.5, "displacement");
  expect_rate(stress[0], stress[1], 1.4, "stress");
  EXPECT_LT(stress.back(), 1e-3 * 5.0 / 7.0);
}

TEST(Revolution, RotatingShaftAndDisc) {
  // Long shaft, held along the axis: u = (1 + nu)(1 - 2 nu) / (8 (1 - nu)) r ((3 - 2 nu) - r^2) for E = rho = w = b
  // = 1.
  const double factor = 1.3 * 0.4 / (8.0 * 0.7);
  for (const int order : {1, 2}) {
    std::vector<double> errors, at_centre;
    for (const double size : {0.25, 0.125, 0.0625, 0.03125}) {
      const auto solution = run(model(block("shaft", 0, 0, 1, 0.5, size, order), R"(
supports: [{on: shaft.bottom, fix: y}, {on: shaft.top, fix: y}]
loads: {turn: {spin: 1}}
)"));
      // Displacements of the nodes are exact; the hoop stress at the rim is not.
      EXPECT_NEAR(at(solution, 0, {1.0, 0.25}).u.x(), factor * 1.4, 1e-3 * factor);
      errors.push_back(std::abs(at(solution, 0, {1.0, 0.25}).hoop - 0.4 / 2.8));
      if (order == 2) {
        EXPECT_NEAR(at(solution, 0, {0.5, 0.25}).u.x(), factor * 0.5 * 2.15, 1e-3 * factor);
        const Point centre = at(solution, 0, {0.0, 0.25});
        at_centre.push_back(std::abs(centre.radial - 2.4 / 5.6));
        EXPECT_NEAR(centre.hoop, centre.radial, 1e-9);
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
      expect_rate(errors[i], errors[i + 1], order == 1 ? 0.8 : 1.7, fmt::format("order {}", order));
    if (order == 1) continue;
    EXPECT_LT(errors.back(), 1e-3 * 0.4 / 2.8);
    EXPECT_LT(at_centre.back(), 1e-3 * 2.4 / 5.6);
    expect_rate(at_centre[2], at_centre[3], 1.7, "stress at the centre");
  }
  // Thin disc: u(b) = (1 - nu) / 4, stress at the centre (3 + nu) / 8.
  const auto disc = run(model(block("disc", 0, 0, 1, 0.02, 0.02, 2), R"(
supports: [{on: disc.bottom, fix: y}]
loads: {turn: {on: disc, spin: 1}}
)"));
  EXPECT_NEAR(at(disc, 0, {1.0, 0.02}).u.x(), 0.175, 1e-3 * 0.175);
  EXPECT_NEAR(at(disc, 0, {0.0, 0.02}).hoop, 3.3 / 8.0, 1e-3 * 3.3 / 8.0);
}

TEST(Revolution, LoadsAreThoseOfTheWholeCircumference) {
  // Weight, pressure, force on an edge and on a circle: the reaction is their sum.
  const auto solution = run(model(block("part", 0.5, 0, 1, 1, 0.5, 2), R"(
supports: [{on: part.bottom, fix: y}]
loads:
  weight: {gravity: [0, -3]}
  press: {on: part.top, pressure: 0.5}
  edge: {on: part.right, force: [0, -2]}
  circle: {on: part.top_left, force: [0.1, -4]}
)"));
  const double area = pi * (1.5 * 1.5 - 0.5 * 0.5);
  EXPECT_NEAR(last(solution).reactions[0].y(), area * 3.0 + area * 0.5 + 2.0 + 4.0, 1e-10);
}

// --- Contact ---

/// A hub on a shaft with the interference 1e-3 on radius 1: p = E i (b^2 - a^2) / (2 a b^2) with b = 2.
constexpr double fit_pressure = 1e-3 * 3.0 / 8.0;

TEST(Revolution, PressFitIsLamesAndIsPushedOutByItsFriction) {
  const std::string bodies = block("shaft", 0, 0, 1, 11, 0.25, 2) + block("hub", 1, 1.5, 1, 8, 0.25, 2);
  const auto solution = run(model(bodies, R"(
supports:
  - {on: hub.top, fix: y}
  - {name: push, on: shaft.bottom, displacement: [null, 0.02]}
contacts: {fit: {between: [shaft.right, hub.left], friction: 0.15, gap: -1e-3, fit_in: press}}
steps:
  - {name: press, friction: {fit: 0}, loads: {push: 0}}
  - {name: grip, friction: {fit: 0.15}, loads: {push: 0}}
  - {name: push, increments: 4, loads: {push: 1}}
)"));
  const analysis::ContactResult& pressed = contact_of(increment_at(solution, 0));
  double nearest = HUGE_VAL, middle = 0.0;
  for (const analysis::PairResult& pair : pressed.pairs)
    if (std::abs(pair.position.y() - 5.5) < nearest) {
      nearest = std::abs(pair.position.y() - 5.5);
      middle = pair.pressure;
    }
  EXPECT_NEAR(middle, fit_pressure, 1e-3 * fit_pressure);
  const analysis::IncrementResult& pushed = last(solution);
  const analysis::ContactResult& sliding = contact_of(pushed);
  EXPECT_EQ(sliding.stick, 0);
  EXPECT_NEAR(std::abs(sliding.tangential_force), 0.15 * sliding.normal_force, 1e-9 * sliding.normal_force);
  EXPECT_NEAR(pushed.reactions[1].y(), 0.15 * sliding.normal_force, 1e-8 * sliding.normal_force);
  EXPECT_NEAR(pushed.reactions[0].y(), -pushed.reactions[1].y(), 1e-8 * sliding.normal_force);
}

TEST(Revolution, PressFitOfOneLengthHasOnePressure) {
  for (const int order : {1, 2}) {
    std::vector<double> errors;
    for (const double size : {0.25, 0.125}) {
      const auto solution =
          run(model(block("shaft", 0, 0, 1, 1, size, order) + block("hub", 1, 0, 1, 1, size, order), R"(
supports: [{on: hub.bottom, fix: y}, {on: shaft.bottom, fix: y}]
contacts: {fit: {between: [shaft.right, hub.left], gap: -1e-3}}
)"));
      const analysis::ContactResult& fit = contact_of(last(solution));
      EXPECT_NEAR(fit.max_pressure, fit_pressure, (order == 1 ? 0.05 : 5e-3) * fit_pressure);
      errors.push_back(std::abs(fit.normal_force / (2.0 * pi) - fit_pressure));
    }
    EXPECT_LT(errors[1], (order == 1 ? 5e-3 : 1e-4) * fit_pressure);
    expect_rate(errors[0], errors[1], order == 1 ? 1.7 : 2.5, fmt::format("order {}", order));
  }
}

TEST(Revolution, ShellsInThreeLayersWithInterference) {
  // Radii 1, 2, 3, 4, interferences 1e-3 and 2e-3: Lame's two equations for the pressures p at 2 and q at 3.
  const auto solution = run(model(block("inner", 1, 0, 1, 0.5, 0.125, 2) + block("middle", 2, 0, 1, 0.5, 0.125, 2) +
                                      block("outer", 3, 0, 1, 0.5, 0.125, 2),
                                  R"(
supports: [{on: inner.bottom, fix: y}, {on: middle.bottom, fix: y}, {on: outer.bottom, fix: y}]
contacts:
  first: {between: [inner.right, middle.left], gap: -1e-3}
  second: {between: [middle.right, outer.left], gap: -2e-3}
)"));
  // Of a ring a to b in plane stress under p inside, q outside: u(r) = ((1 - nu) A r + (1 + nu) B / r) / E.
  const auto u = [](double a, double b, double p, double q, double r) {
    const double A = (p * a * a - q * b * b) / (b * b - a * a), B = (p - q) * a * a * b * b / (b * b - a * a);
    return (1.0 - nu) * A * r + (1.0 + nu) * B / r;
  };
  Mat2 C;
  C << u(2, 3, 1, 0, 2) - u(1, 2, 0, 1, 2), u(2, 3, 0, 1, 2), -u(2, 3, 1, 0, 3), u(3, 4, 1, 0, 3) - u(2, 3, 0, 1, 3);
  const double det = C.determinant();
  const double p = (C(1, 1) * 1e-3 - C(0, 1) * 2e-3) / det, q = (C(0, 0) * 2e-3 - C(1, 0) * 1e-3) / det;
  EXPECT_NEAR(contact_of(last(solution), 0).max_pressure, p, 1e-3 * p);
  EXPECT_NEAR(contact_of(last(solution), 1).max_pressure, q, 1e-3 * q);
}

std::string hertz(const char* sides, double length, double modulus, double load, double friction) {
  return fmt::format(R"(
scabo: 1
analysis: {{plane: axisymmetric}}
materials: {{steel: {{young: {3}, poisson: 0.3}}, soft: {{young: {4}, poisson: 0.3}}}}
bodies:
  block:
    material: soft
    shape: {{polygon: {{vertices: [[0, {5}], [{6}, {5}], [{6}, 0], [0, 0]], names: {{bottom: edge_1, top: edge_3}}}}}}
    mesh: {{size: {7}, refine: [{{near: [0, 0], size: {8}, growth: 0.1}}]}}
  ball:
    material: steel
    shape:
      outline:
        - {{arc: {{from: [0, 0], to: [{9}, {9}], centre: [0, {9}]}}, name: surface}}
        - {{line: {{to: [0, {9}]}}, name: top}}
        - {{line: {{to: [0, 0]}}, name: axis}}
    mesh: {{size: {7}, refine: [{{near: [0, 0], size: {8}, growth: 0.1}}]}}
supports: [{{on: block.bottom, fix: y}}]
loads: {{press: {{on: ball.top, force: [0, {10}]}}}}
contacts: {{touch: {{between: [{11}], friction: {12}}}}}
)",
                     0, 0, 0, 210e3 * modulus, 70e3 * modulus, -40.0 * length, 40.0 * length, 6.0 * length,
                     0.1 * length, 50.0 * length, -1e4 * load, sides, friction);
}

TEST(Revolution, HertzSphereOnABlock) {
  // VERIFICATION "Space": a 1.866256, p0 1,370.879. The ball leans by a / R = 0.04 at the end of the contact, which
  // Hertz leaves out: to 1e-3 his numbers are those of RevolutionExact.HertzBallOnABlock.
  const auto solution = run(hertz("block.top, ball.surface", 1, 1, 1, 0));
  const analysis::ContactResult& touch = contact_of(last(solution));
  EXPECT_NEAR(touch.normal_force, 1e4, 1e-3 * 1e4);  // the surfaces lean by a / R at the end of the contact
  double edge = 0.0;
  for (const analysis::PairResult& pair : touch.pairs)
    if (pair.state != contact::ContactState::open) edge = std::max(edge, pair.position.x());
  EXPECT_NEAR(edge, 1.866256, 0.08);
  const analysis::PairResult& axis =
      *std::min_element(touch.pairs.begin(), touch.pairs.end(),
                        [](const auto& a, const auto& b) { return a.position.x() < b.position.x(); });
  EXPECT_NEAR(axis.position.x(), 0.0, 1e-9);
  EXPECT_NEAR(axis.pressure, 1370.879, 5e-3 * 1370.879);
}

// --- Twins ---

TEST(Revolution, UnitsOrderAndSidesChangeNothing) {
  const auto numbers = [](const std::string& text) {
    const auto solution = run(text);
    const analysis::ContactResult& touch = contact_of(last(solution));
    return std::array{touch.normal_force, touch.max_pressure, std::abs(touch.tangential_force)};
  };
  const auto plain = numbers(hertz("block.top, ball.surface", 1, 1, 1, 0.3));
  const auto swapped = numbers(hertz("ball.surface, block.top", 1, 1, 1, 0.3));
  const auto metres = numbers(hertz("block.top, ball.surface", 1e-3, 1e6, 1, 0.3));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(swapped[i], plain[i], 1e-6 * plain[i]);
    EXPECT_NEAR(metres[i] / (i == 1 ? 1e6 : 1.0), plain[i], 1e-6 * plain[i]);
  }
}

// Mirrored across the axis, y -> -y, a fit that is pushed out has the same forces, those along the axis with other
// signs.
TEST(Revolution, MirroredAlongTheAxis) {
  const auto fit = [](bool mirrored) {
    const auto part = [&](const char* name, double x, double y, double height) {
      return block(name, x, mirrored ? -y - height : y, 1, height, 0.25, 2);
    };
    const double s = mirrored ? -1.0 : 1.0;
    return run(model(part("shaft", 0, 0, 3) + part("hub", 1, 0.5, 1.5),
                     fmt::format(R"(
supports: [{{on: hub.{}, fix: y}}, {{name: push, on: shaft.{}, displacement: [null, {}]}}]
loads: {{weight: {{gravity: [0, {}]}}}}
contacts: {{fit: {{between: [shaft.right, hub.left], friction: 0.15, gap: -1e-3, fit_in: press}}}}
steps: [{{name: press, loads: {{push: 0}}}}, {{name: push, increments: 2}}]
)",
                                 mirrored ? "bottom" : "top", mirrored ? "top" : "bottom", 1.5e-4 * s, -1e-5 * s)));
  };
  const auto plain = fit(false), mirrored = fit(true);
  const analysis::ContactResult &a = contact_of(last(plain)), &b = contact_of(last(mirrored));
  EXPECT_GT(a.slip, 0);
  EXPECT_GT(a.stick, 0);
  EXPECT_EQ(b.slip, a.slip);
  EXPECT_NEAR(b.normal_force, a.normal_force, 1e-8 * a.normal_force);
  EXPECT_NEAR(b.max_pressure, a.max_pressure, 1e-8 * a.max_pressure);
  EXPECT_NEAR(b.tangential_force, -a.tangential_force, 1e-8 * a.normal_force);
  EXPECT_NEAR(last(mirrored).reactions[1].y(), -last(plain).reactions[1].y(), 1e-8 * a.normal_force);
  const Point above = at(plain, 1, {1.6, 1.4}), below = at(mirrored, 1, {1.6, -1.4});
  EXPECT_NEAR(below.u.x(), above.u.x(), 1e-8 * above.u.norm());
  EXPECT_NEAR(below.u.y(), -above.u.y(), 1e-8 * above.u.norm());
  EXPECT_NEAR(below.hoop, above.hoop, 1e-8 * a.max_pressure);
  EXPECT_NEAR(below.shear, -above.shear, 1e-8 * a.max_pressure);
}

// A glued joint under uniform tension breaks where the tension is its strength: the areas of all pairs are consistent
// with the forces on them, on the axis and beside it.
TEST(Revolution, GluedJointHoldsItsStrengthTimesItsArea) {
  for (const int order : {1, 2})
    for (const double inner : {0.0, 0.5})
      for (const double pull : {0.0099, 0.0101}) {
        const auto solution =
            run(model(block("low", inner, 0, 1, 0.5, 0.25, order) + block("up", inner, 0.5, 1, 0.5, 0.25, order),
                      fmt::format(R"(
supports: [{{on: low.bottom, fix: y}}]
loads: {{pull: {{on: up.top, pressure: -{}}}}}
contacts: {{joint: {{between: [low.top, up.bottom], friction: 0, cohesion: 1, tension: 0.01}}}}
)",
                                  pull)));
        if (pull > 0.01) {
          EXPECT_NE(solution.outcome, analysis::Outcome::solved) << order << ", " << inner;
        } else {
          const double area = pi * ((inner + 1.0) * (inner + 1.0) - inner * inner);
          EXPECT_NEAR(contact_of(last(solution)).normal_force, -pull * area, 1e-10);
        }
      }
}

// Lame's displacement prescribed by formula inside and outside: the pressures follow.
TEST(Revolution, DisplacementsByFormula) {
  const auto solution = run(model(block("tube", 1, 0, 1, 0.5, 0.0625, 2), R"yaml(
supports:
  - {on: tube.bottom, fix: y}
  - {on: tube.top, fix: y}
  - {on: tube.left, displacement: {formula: ["1.3 / 3 * (0.4 * x + 4 / x)", null]}}
  - {on: tube.right, displacement: {formula: ["1.3 / 3 * (0.4 * x + 4 / x)", null]}}
)yaml"));
  const Point middle = at(solution, 0, {1.5, 0.25});
  EXPECT_NEAR(middle.hoop, (1.0 + 4.0 / 2.25) / 3.0, 1e-3);
  EXPECT_NEAR(last(solution).reactions[2].x(), 2.0 * pi * 0.5, 1e-3 * pi);  // the pressure 1 around the circumference
  EXPECT_NEAR(last(solution).reactions[3].x(), 0.0, 1e-3 * pi);
}

TEST(Revolution, TiedPartsAreOneBody) {
  const auto whole = run(model(block("tube", 1, 0, 2, 0.5, 0.25, 2), R"(
supports: [{on: tube.bottom, fix: y}]
loads: {inside: {on: tube.left, pressure: 1}}
)"));
  const auto parts = run(model(block("tube", 1, 0, 1, 0.5, 0.25, 2) + block("coat", 2, 0, 1, 0.5, 0.25, 2), R"(
supports: [{on: tube.bottom, fix: y}, {on: coat.bottom, fix: y}]
loads: {inside: {on: tube.left, pressure: 1}}
ties: {joint: {between: [tube.right, coat.left]}}
)"));
  EXPECT_NEAR(at(parts, 0, {1.0, 0.5}).u.x(), at(whole, 0, {1.0, 0.5}).u.x(), 1e-12);
  EXPECT_NEAR(at(parts, 1, {3.0, 0.5}).hoop, at(whole, 0, {3.0, 0.5}).hoop, 1e-11);
}

TEST(Revolution, RigidBodyFallsOntoItsSeatAlongTheAxis) {
  const auto solution = run(model(block("seat", 0, 0, 2, 1, 0.25, 2) +
                                      "  weight: {rigid: true, shape: {rectangle: {corner: [0, 1], size: [1, 1]}}}\n",
                                  R"(
supports: [{on: seat.bottom, fix: [x, y]}]
loads: {press: {on: weight, force: [0, -0.01]}}
contacts: {joint: {between: [seat.top, weight.bottom], friction: 0.4}}
)"));
  const analysis::IncrementResult& increment = last(solution);
  EXPECT_NEAR(contact_of(increment).normal_force, 0.01, 1e-12);
  EXPECT_NEAR(increment.reactions[0].y(), 0.01, 1e-12);
  EXPECT_EQ(increment.fields.displacements[1][0], 0.0);
  EXPECT_EQ(increment.fields.displacements[1][2], 0.0);
  EXPECT_LT(increment.fields.displacements[1][1], 0.0);
}

}  // namespace
}  // namespace scabo::verification
