// Springs and elastic foundations: rigid blocks, blocks under pressure, a long beam on Winkler's foundation, vibration,
// contact with a body on springs; twins in other units and turned.
#include <fmt/format.h>

#include <numbers>

#include "run.hpp"
#include "scabo/analysis/modal/modal_analysis.hpp"

namespace scabo::verification {
namespace {

Vec2 sum_of_springs(const analysis::IncrementResult& increment) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& force : increment.springs) sum += force;
  return sum;
}

/// Coordinates times `length`, turned about the origin.
struct Frame {
  double angle = 0.0, length = 1.0;
  Vec2 turned(const Vec2& x) const {
    return {std::cos(angle) * x.x() - std::sin(angle) * x.y(), std::sin(angle) * x.x() + std::cos(angle) * x.y()};
  }
  std::string direction(const Vec2& v) const {
    const Vec2 d = turned(v);
    return fmt::format("[{:.17g}, {:.17g}]", d.x(), d.y());
  }
  std::string operator()(double x, double y) const { return direction(length * Vec2(x, y)); }
  /// Edges bottom, right, top and left, corners vertex_1 (bottom left) and so on.
  std::string box(double x, double y, double width, double height) const {
    return fmt::format(
        "{{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, right: edge_2, top: edge_3, left: "
        "edge_4}}}}}}",
        (*this)(x, y), (*this)(x + width, y), (*this)(x + width, y + height), (*this)(x, y + height));
  }
};

// A rigid block B x H, thickness t, on a foundation k_n, k_t under its base, with a force at its upper right corner. At
// the middle of the base: k_t B t u = F_x, k_n B t v = F_y, k_n t B^3 / 12 theta = F_y B / 2 - F_x H.
TEST(Springs, UnderARigidBlockGiveItsTranslationAndRotation) {
  const double B = 2.0, H = 3.0, t = 0.4, k_n = 5e7, k_t = 2e7;
  const Vec2 F(3e4, -8e4);
  for (const double angle : {0.0, 0.6}) {
    const Frame frame{angle, 1.0};
    const auto solution =
        run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{stuff: {{young: 1e9, poisson: 0.2}}}}
bodies:
  aside: {{material: stuff, shape: {}, mesh: {{size: 1}}}}
  block: {{rigid: true, shape: {}}}
supports: [{{on: aside, fix: [x, y]}}]
springs: [{{on: block.bottom, k_n: {}, k_t: {}, name: bed}}]
loads: {{push: {{on: block.vertex_3, force: {}}}}}
)",
                        t, frame.box(9, 0, 1, 1), frame.box(-0.5 * B, 0, B, H), k_n, k_t, frame.direction(F)));
    const Vector& motion = last(solution).fields.displacements[1];
    const double rotation = (F.y() * 0.5 * B - F.x() * H) / (k_n * t * B * B * B / 12.0);
    const Vec2 base(F.x() / (k_t * B * t), F.y() / (k_n * B * t));
    const Vec2 centroid = frame.turned(Vec2(base.x() - rotation * 0.5 * H, base.y()));
    EXPECT_LT((motion.head<2>() - centroid).norm(), 1e-13 * centroid.norm());
    EXPECT_NEAR(motion[2], rotation, 1e-13 * std::abs(rotation));
    EXPECT_LT((last(solution).springs[0] + frame.turned(F)).norm(), 1e-12 * F.norm());
    const double energy = 0.5 * (F.x() * base.x() + F.y() * base.y() + (F.y() * 0.5 * B - F.x() * H) * rotation);
    EXPECT_NEAR(last(solution).energy.elastic, energy, 1e-12 * energy);
    EXPECT_NEAR(last(solution).energy.external, energy, 1e-12 * energy);
  }
}

// Supports hold a part of the motion, springs another: a lever on a hinge with a spring at its end.
TEST(Springs, AtTheEndOfARigidLever) {
  const auto solution = run(R"(
scabo: 1
materials: {stuff: {young: 1e9, poisson: 0.2}}
bodies:
  aside: {material: stuff, shape: {rectangle: {corner: [9, 0], size: [1, 1]}}, mesh: {size: 1}}
  lever: {rigid: true, shape: {rectangle: {corner: [0, 0], size: [4, 0.2]}}}
supports: [{on: aside, fix: [x, y]}, {on: lever.bottom_left, fix: [x, y]}]
springs: [{on: lever.bottom_right, k_y: 3e5}]
loads: {weight: {on: lever, force: [0, -600]}}
)");
  // 600 N at 2 m, the spring at 4 m: 300 N and 1 mm there.
  EXPECT_NEAR(last(solution).springs[0].y(), 300.0, 1e-10);
  EXPECT_NEAR(last(solution).reactions[1].y(), 300.0, 1e-10);
  EXPECT_NEAR(last(solution).fields.displacements[1][2], -1e-3 / 4.0, 1e-16);
}

// A block under pressure on a foundation settles by p / k_n, and its top by p H / E more; soft and stiff springs alike.
TEST(Springs, UnderABlockAreAnExactPatch) {
  const double E = 20e9, p = 3e6, H = 1.0;
  for (const char* mesh : {"size: 0.5, order: 3", "kind: fem, size: 0.3", "kind: polygons, size: 0.3",
                           "kind: quadtree, size: 0.3, order: 1"})
    for (const double k_n : {1e13, 1e9, 1e4, 1.0}) {
      const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{thickness: 0.3}}
materials: {{stuff: {{young: {}, poisson: 0.2}}}}
bodies: {{block: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [2, {}]}}}}, mesh: {{{}}}}}}}
springs:
  - {{on: block.bottom, k_n: {}, name: bed}}
  - {{on: block.bottom_left, k_x: 1e6}}
loads: {{press: {{on: block.top, pressure: {}}}}}
)",
                                            E, H, mesh, k_n, p));
      const double settlement = p / k_n;
      const Vector& u = last(solution).fields.displacements[0];
      const auto& nodes = solution.mesh.bodies[0].nodes;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double exact = -settlement - p / E * nodes[i].y();
        EXPECT_NEAR(u[static_cast<Eigen::Index>(2 * i + 1)], exact, 1e-10 * (p / E) + 1e-12 * settlement)
            << mesh << ", " << k_n;
      }
      const double total = p * 2.0 * 0.3;
      EXPECT_LT((last(solution).springs[0] - Vec2(0.0, total)).norm(), 1e-12 * total);
      EXPECT_LT(last(solution).springs[1].norm(), 1e-10 * total) << mesh << ", " << k_n;
      const double energy = 0.5 * total * (settlement + p * H / E);
      EXPECT_NEAR(last(solution).energy.elastic, energy, 1e-10 * energy);
      EXPECT_NEAR(last(solution).energy.external, energy, 1e-10 * energy);
    }
}

// Half of a long beam with a force P in the middle on Winkler's foundation. Timoshenko: with lambda^4 = k / (4 E I) and
// beta = k / (4 kappa G A), a^2 = lambda^2 + beta, b^2 = lambda^2 - beta,
//
//     w = e^(-a x) (A cos b x + B sin b x),   A = P / (8 E I lambda^2 a) + P / (4 kappa G A a),
//     B = (a A - P / (2 kappa G A)) / b,      M = E I (w'' - 4 beta w).
//
// (beta = 0: w(0) = P lambda / (2 k), M(0) = P / (4 lambda).) kappa after Cowper for plane stress. The rest is of the
// order of (lambda h)^4, and end effects within a depth of the force.
TEST(Springs, UnderALongBeamAreWinklersFoundation) {
  const double E = 30e9, nu = 0.2, h = 1.0, t = 0.5, P = 2e5, lambda = 0.1, L = 100.0;
  const double EI = E * t * h * h * h / 12.0, k = 4.0 * EI * std::pow(lambda, 4);
  const double shear = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu) * E / (2.0 * (1.0 + nu)) * t * h;
  const double beta = k / (4.0 * shear), a = std::sqrt(lambda * lambda + beta), b = std::sqrt(lambda * lambda - beta);
  const double A = P / (8.0 * EI * lambda * lambda * a) + P / (4.0 * shear * a), B = (a * A - P / (2.0 * shear)) / b;
  const auto w = [&](double x) { return std::exp(-a * x) * (A * std::cos(b * x) + B * std::sin(b * x)); };
  const auto moment = [&](double x) {  // of P in the middle: positive below it
    const double c = std::cos(b * x), s = std::sin(b * x);
    const double second = std::exp(-a * x) * ((a * a - b * b) * (A * c + B * s) + 2.0 * a * b * (A * s - B * c));
    return -EI * (second - 4.0 * beta * w(x));
  };
  EXPECT_NEAR(A, P * lambda / (2.0 * k), 0.02 * A);  // Euler and Bernoulli
  EXPECT_NEAR(moment(0.0), P / (4.0 * lambda), 0.02 * P / lambda);
  for (const char* mesh : {"kind: fem, size: 0.5", "size: 2, order: 4"}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{concrete: {{young: {}, poisson: {}}}}}
bodies: {{beam: {{material: concrete, shape: {{rectangle: {{corner: [0, 0], size: [{}, {}]}}}}, mesh: {{{}}}}}}}
supports: [{{on: beam.left, fix: x, name: middle}}]
springs: [{{on: beam.bottom, k_n: {:.17g}, name: ground}}]
loads: {{half: {{on: beam.left, traction: [0, {:.17g}]}}}}
)",
                                          t, E, nu, L, h, mesh, k / t, -0.5 * P / (h * t)));
    EXPECT_LT((sum_of_springs(last(solution)) - Vec2(0.0, 0.5 * P)).norm(), 1e-12 * P) << mesh;
    const Vector& u = last(solution).fields.displacements[0];
    const auto& nodes = solution.mesh.bodies[0].nodes;
    int compared = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vec2& x = nodes[i];
      if (x.x() < 2.0 * h || x.y() > 0.0) continue;
      ++compared;
      EXPECT_NEAR(-u[static_cast<Eigen::Index>(2 * i + 1)], w(x.x()), 3e-4 * A) << mesh << " at " << x.x();
    }
    EXPECT_GT(compared, 90);
    // The moment in the middle: that of the forces on the half, whose springs lie along it.
    std::vector<std::pair<double, double>> along;  // x, w
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].y() == 0.0) along.emplace_back(nodes[i].x(), -u[static_cast<Eigen::Index>(2 * i + 1)]);
    std::sort(along.begin(), along.end());
    double of_springs = 0.0;  // by trapezoids
    for (std::size_t i = 0; i + 1 < along.size(); ++i)
      of_springs += 0.5 * (along[i + 1].first - along[i].first) * k *
                    (along[i].first * along[i].second + along[i + 1].first * along[i + 1].second);
    EXPECT_NEAR(of_springs, moment(0.0), 5e-3 * moment(0.0)) << mesh;
  }
}

/// An elastic block on a rigid plate on springs, pushed sideways.
analysis::StaticSolution block_on_plate(const Frame& frame, double push, const std::string& more = {}) {
  const double l = frame.length, stiff = 1.0 / l;  // Pa and N/m3 with lengths in other units, the same newtons
  return run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {0}}}
materials: {{stuff: {{young: {1:.17g}, poisson: 0.3}}}}
bodies:
  block: {{material: stuff, shape: {2}, mesh: {{size: {3}, order: 3}}}}
  plate: {{rigid: true, shape: {4}}}
springs:
  - {{on: plate.bottom, k_n: {5:.17g}, k_t: {6:.17g}, name: ground}}
  - {{on: block.vertex_3, k_x: {7:.17g}, k_y: {7:.17g}, name: stay}}
contacts: {{joint: {{between: [plate.top, block.bottom], friction: 0.4}}}}
loads:
  weight: {{on: block.top, traction: {8}}}
  push: {{on: block.left, traction: {9}}}
{10}
)",
                         0.5 * l, 1e9 * stiff * stiff, frame.box(0, 0, 2, 1), 0.25 * l, frame.box(-0.5, -0.4, 3, 0.4),
                         4e7 * stiff * stiff * stiff, 3e7 * stiff * stiff * stiff, 2e6 * stiff,
                         frame.direction(Vec2(0.0, -1e6 * stiff * stiff)),
                         frame.direction(Vec2(push * stiff * stiff, 0.0)), more));
}

TEST(Springs, UnderAPlateInContactBalanceTheLoads) {
  const auto solution = block_on_plate({}, 1e5);
  const analysis::IncrementResult& increment = last(solution);
  const Vec2 loads(1e5 * 0.5, -1e6 * 2.0 * 0.5);
  EXPECT_LT((sum_of_springs(increment) + loads).norm(), 1e-11 * loads.norm());
  const auto& joint = contact_of(increment);
  EXPECT_NEAR(joint.normal_force, increment.springs[0].y(), 1e-11 * loads.norm());
  EXPECT_NEAR(joint.tangential_force, increment.springs[0].x(), 1e-11 * loads.norm());
  EXPECT_NEAR(increment.energy.external, increment.energy.elastic + increment.energy.friction,
              1e-9 * increment.energy.external);
  // Friction cannot hold more than 0.4 N; the rest goes into the stay.
  const auto sliding = block_on_plate({}, 2e6);
  EXPECT_EQ(contact_of(last(sliding)).stick, 0);
  EXPECT_LT(last(sliding).springs[1].x(), -1e6 + 0.41 * contact_of(last(sliding)).normal_force);
}

TEST(Springs, OfTwinsInOtherUnitsAndTurnedGiveTheSame) {
  const auto first = block_on_plate({}, 3e5);
  for (const Frame& frame : {Frame{0.0, 1e3}, Frame{0.0, 1e-3}, Frame{0.8, 1.0}, Frame{-2.2, 1e3}}) {
    const auto twin = block_on_plate(frame, 3e5);
    for (std::size_t b = 0; b < 2; ++b) {
      const Vector &u = last(first).fields.displacements[b], &v = last(twin).fields.displacements[b];
      ASSERT_EQ(u.size(), v.size());
      for (Eigen::Index i = 0; i + 1 < u.size(); i += 2)
        EXPECT_LT((v.segment<2>(i) / frame.length - frame.turned(u.segment<2>(i))).norm(),
                  1e-9 * u.lpNorm<Eigen::Infinity>());
    }
    // The stay has the same stiffness along x and y, so that it turns with the model.
    for (std::size_t s = 0; s < 2; ++s)
      EXPECT_LT((last(twin).springs[s] - frame.turned(last(first).springs[s])).norm(), 1e-9 * 1e6);
  }
}

TEST(Springs, NormalToACircleDoNotHoldItsRotation) {
  for (const char* body : {"material: stuff, mesh: {size: 0.4}", "material: stuff, mesh: {kind: polygons, size: 0.4}"})
    try {
      run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2}}}}
bodies: {{disc: {{shape: {{circle: {{centre: [3, 1], radius: 1}}}}, {}}}}}
springs: [{{on: disc.rim, k_n: 1e8}}]
loads: {{push: {{on: {{body: disc, near: [3, 2]}}, force: [0, -1]}}}}
)",
                      body));
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("it is free to move by rotation about (3, 1); add a support or springs"),
                std::string::npos)
          << error.what();
    }
}

// Radially symmetric: a disc under pressure p on its rim in springs k_n moves by u = p' R (1 - nu) / E, with p' = p - k
// u.
TEST(Springs, AroundADiscShareItsPressure) {
  const double E = 1e9, nu = 0.2, R = 2.0, p = 1e6, k = 3e8;
  const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: {}, poisson: {}}}}}
bodies: {{disc: {{material: stuff, shape: {{circle: {{centre: [0, 0], radius: {}}}}}, mesh: {{size: 0.4, order: 6}}}}}}
springs: [{{on: disc.rim, k_n: {}, k_t: 1e8}}]
loads: {{press: {{on: disc.rim, pressure: {}}}}}
)",
                                        E, nu, R, k, p));
  const double c = R * (1.0 - nu) / E, u = p * c / (1.0 + k * c);
  const Vector& found = last(solution).fields.displacements[0];
  const auto& nodes = solution.mesh.bodies[0].nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_LT((found.segment<2>(static_cast<Eigen::Index>(2 * i)) + u / R * nodes[i]).norm(), 1e-9 * u);
  EXPECT_LT(last(solution).springs[0].norm(), 1e-9 * p * R);  // in balance by themselves
}

// Two tied blocks on a foundation that reaches under both, and a finite-element twin of both in one.
TEST(Springs, UnderTiedBodies) {
  const auto text = [](const char* bodies, const char* springs, const char* ties, const char* load) {
    return fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2}}}}
bodies:
{}
springs: [{}]
ties: {{{}}}
loads: {{press: {{on: {}, force: [0, -1e5]}}}}
)",
                       bodies, springs, ties, load);
  };
  const auto two = run(text(
      R"(  left: {material: stuff, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {kind: fem, size: 0.25}}
  right: {material: stuff, shape: {rectangle: {corner: [2, 0], size: [2, 1]}}, mesh: {kind: fem, size: 0.25}})",
      "{on: left.bottom, k_n: 1e8, k_t: 1e7}, {on: right.bottom, k_n: 1e8, k_t: 1e7}",
      "joint: {between: [left.right, right.left]}", "right.top_right"));
  const auto one = run(text(
      "  whole: {material: stuff, shape: {rectangle: {corner: [0, 0], size: [4, 1]}}, mesh: {kind: fem, size: 0.25}}",
      "{on: whole.bottom, k_n: 1e8, k_t: 1e7}", "", "whole.top_right"));
  EXPECT_LT((sum_of_springs(last(two)) - Vec2(0.0, 1e5)).norm(), 1e-11 * 1e5);
  EXPECT_LT((sum_of_springs(last(two)) - last(one).springs[0]).norm(), 1e-11 * 1e5);
  EXPECT_NEAR(last(two).energy.elastic, last(one).energy.elastic, 1e-10 * last(one).energy.elastic);
}

// A stiff block vibrates on soft springs: f = sqrt(k / m) / 2 pi along both axes.
TEST(Springs, CountInNaturalFrequencies) {
  for (const char* mesh : {"size: 0.5", "kind: fem, size: 0.1"}) {
    const auto result = analysis::solve_modal(input::parse_model(fmt::format(R"(
scabo: 1
analysis: {{type: modal, modes: 4, thickness: 0.5}}
materials: {{stuff: {{young: 200e9, poisson: 0.3, density: 8000}}}}
bodies: {{block: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{{}}}}}}}
springs: [{{on: block.bottom, k_n: 4e6}}]
)",
                                                                             mesh),
                                                                 "test.yaml"));
    // One free motion, along x; down and rotation on springs: I = m (4 + 1) / 12 about the centroid, and the springs
    // 0.5 m below it turn it by k B^3 / 12 alone, because k_t = 0.
    const double m = 8000.0 * 2.0 * 0.5, k = 4e6 * 2.0 * 0.5;
    const double down = std::sqrt(k / m) / (2.0 * std::numbers::pi);
    const double rock = std::sqrt(4e6 * 0.5 * 8.0 / 12.0 / (m * 5.0 / 12.0)) / (2.0 * std::numbers::pi);
    ASSERT_EQ(result.modes.size(), 4u);
    EXPECT_TRUE(result.modes[0].rigid);
    EXPECT_NEAR(result.modes[1].frequency, std::min(down, rock), 1e-4 * down) << mesh;
    EXPECT_NEAR(result.modes[2].frequency, std::max(down, rock), 1e-4 * down) << mesh;
  }
}

// A bar E, A, L held at its left end, with a spring k at its right end whose far end moves by a: u = a k / (k + E A /
// L), and the force of the spring is k (a - u). Steps and curves give the movement a factor; twice as much moves twice
// as far.
TEST(SpringsAtRest, PullABarByTheirStiffnessTimesWhatIsLeft) {
  const double E = 2e9, A = 0.5 * 0.2, L = 2.0, k = 3e8, a = 1e-3;
  for (const double scale : {1.0, 1e-3, 1e3}) {
    const double area = A * scale;  // plane: the height is scaled, the thickness is not
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{thickness: 0.2}}
materials: {{stuff: {{young: {}, poisson: 0}}}}
bodies: {{bar: {{material: stuff, shape: {{rectangle: {{corner: [0, 0], size: [{}, {}]}}}}, mesh: {{size: {}}}}}}}
supports: [{{on: bar.left, fix: [x, y]}}]
springs: [{{on: bar.right, k_n: {:.17g}, at_rest: [{:.17g}, null], name: jack}}]
curves: {{wave: {{sine: {{amplitude: 0.5, periods: 0.75, mean: 1}}}}}}
steps: [{{name: tighten}}, {{increments: 3, loads: {{jack: wave}}}}, {{loads: {{jack: -2}}}}]
)",
                                          E, L * scale, 0.5 * scale, 0.25 * scale, k / area, a * scale));
    const double stiffness = E * area / (L * scale), u = a * scale * k / (k + stiffness);
    EXPECT_LE(last(solution).certificate.worst(), 1e-10);
    for (const analysis::IncrementResult& increment : solution.increments) {
      const double factor = increment.factors.at("jack");
      const Vec2 force = increment.springs.front();
      EXPECT_NEAR(force.x(), factor * k * (a * scale - u), 1e-9 * k * a * scale) << scale;
      EXPECT_NEAR(force.y(), 0.0, 1e-9 * k * a * scale);
      EXPECT_NEAR(increment.reactions.front().x(), -force.x(), 1e-9 * k * a * scale);
      // As a load k a on a spring that was at rest at 0.
      EXPECT_NEAR(increment.energy.external, increment.energy.elastic, 1e-9 * k * a * a * scale * scale);
    }
    EXPECT_NEAR(last(solution).factors.at("jack"), -2.0, 0.0);
  }
}

// Ground that settles under a rigid block by [a_n, a_t]: the block goes with it, without any force; turned too.
TEST(SpringsAtRest, CarryARigidBlockWithTheGround) {
  for (const double angle : {0.0, 0.9, -2.0}) {
    const Frame frame{angle, 1.0};
    const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 1e9, poisson: 0.2}}}}
bodies:
  aside: {{material: stuff, shape: {}, mesh: {{size: 1}}}}
  block: {{rigid: true, shape: {}}}
supports: [{{on: aside, fix: [x, y]}}]
springs:
  - {{on: block.bottom, k_n: 5e7, k_t: 2e7, at_rest: [1e-3, -2e-3], name: bed}}
  - {{on: block.top, k_n: 1e7, k_t: 1e7, at_rest: [-1e-3, 2e-3], name: roof}}
steps: [{{loads: {{bed: 1, roof: 1}}}}, {{loads: {{bed: 0.5, roof: 0.5}}}}]
)",
                                          frame.box(9, 0, 1, 1), frame.box(-1, 0, 2, 3)));
    // Bottom: outward normal (0, -1), tangent (1, 0); top: (0, 1), (-1, 0).
    for (const std::size_t k : {0u, 1u}) {
      const analysis::IncrementResult& increment = increment_at(solution, k);
      const Vector& motion = increment.fields.displacements[1];
      const Vec2 expected = (k == 0 ? 1.0 : 0.5) * frame.turned({-2e-3, -1e-3});
      EXPECT_LT((motion.head<2>() - expected).norm(), 1e-14);
      EXPECT_NEAR(motion[2], 0.0, 1e-14);
      EXPECT_LT(sum_of_springs(increment).norm(), 1e-6);
      EXPECT_LT(increment.springs[0].norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace scabo::verification
