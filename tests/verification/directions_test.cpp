// Supports along the normal and tangent of an edge, and along a direction: turned twins, Lame's ring between planes of
// symmetry, motions that all supports prescribe together.
#include <fmt/format.h>

#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// Coordinates turned about the origin.
struct Turned {
  double c = 1.0, s = 0.0;
  explicit Turned(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
  Vec2 of(const Vec2& x) const { return {c * x.x() - s * x.y(), s * x.x() + c * x.y()}; }
  Vec2 back(const Vec2& x) const { return {c * x.x() + s * x.y(), c * x.y() - s * x.x()}; }
  std::string operator()(double x, double y) const {
    const Vec2 at = of({x, y});
    return fmt::format("[{:.17g}, {:.17g}]", at.x(), at.y());
  }
  /// A rectangle with the edges bottom, right, top and left.
  std::string box(double x, double y, double width, double height) const {
    return fmt::format(
        "{{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, right: edge_2, top: edge_3, left: "
        "edge_4}}}}}}",
        (*this)(x, y), (*this)(x + width, y), (*this)(x + width, y + height), (*this)(x, y + height));
  }
};

/// The largest difference between the displacements of a body and those of its twin, turned back, relative to them.
double difference(const analysis::IncrementResult& upright, const analysis::IncrementResult& twin, const Turned& turned,
                  std::size_t body) {
  const Vector &a = upright.fields.displacements[body], &b = twin.fields.displacements[body];
  if (a.size() != b.size()) throw std::runtime_error("the twins have different meshes");
  double largest = 0.0;
  for (Eigen::Index i = 0; i + 1 < a.size(); i += 2)
    largest = std::max(largest, (turned.back(b.segment<2>(i)) - a.segment<2>(i)).norm());
  return largest / a.lpNorm<Eigen::Infinity>();
}

/// A block of the given length on rollers along its bottom and left side, loaded on top and at the right.
analysis::StaticSolution block_on_rollers(const Turned& turned, double length, const std::string& mesh,
                                          const std::string& supports) {
  return run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 10e9, poisson: 0.3}}}}
bodies: {{block: {{material: stuff, shape: {}, mesh: {{{}}}}}}}
supports: {}
loads:
  top: {{on: block.top, pressure: {{over: length, at: [0, {}], values: [1e6, 3e6]}}}}
  right: {{on: block.right, traction: {}}}
)",
                         turned.box(0, 0, length, 1), mesh, supports, length, turned(2e5, 3e5)));
}

TEST(SupportDirections, OfATurnedBlockOnRollersGiveTheSame) {
  for (const char* mesh : {"size: 0.3, order: 3", "size: 0.5, order: 5"})
    for (const double angle : {0.3, 2.0, -1.1}) {
      const Turned none(0.0), turned(angle);
      const auto upright = block_on_rollers(none, 2.0, mesh, "[{on: block.bottom, fix: y}, {on: block.left, fix: x}]");
      const auto by_edges =
          block_on_rollers(turned, 2.0, mesh, "[{on: block.bottom, fix: normal}, {on: block.left, fix: normal}]");
      const auto by_direction = block_on_rollers(
          turned, 2.0, mesh,
          fmt::format("[{{on: block.bottom, fix: {{along: {}}}}}, {{on: block.left, fix: {{along: {}}}}}]",
                      turned(0, -3), turned(0.5, 0)));
      for (const auto* twin : {&by_edges, &by_direction}) {
        EXPECT_LT(difference(last(upright), last(*twin), turned, 0), 1e-12) << angle;
        for (std::size_t i = 0; i < 2; ++i)
          EXPECT_LT((turned.back(last(*twin).reactions[i]) - last(upright).reactions[i]).norm(), 1e-12 * 4e6) << angle;
      }
    }
}

// The rigid motion that the rollers leave is stopped by one point: a simply supported beam of 200:1, whose displacement
// is refined in twice the working precision.
TEST(SupportDirections, OfASlenderBeamGiveTheSame) {
  const auto beam = [](const Turned& turned, const char* first, const std::string& second) {
    return block_on_rollers(
        turned, 200.0, "size: 2, order: 2",
        fmt::format("[{{on: block.left, fix: {}}}, {{on: block.vertex_2, fix: {}}}]", first, second));
  };
  const Turned none(0.0), turned(0.7);
  const auto upright = beam(none, "[x, y]", "y");
  const auto twin = beam(turned, "[normal, tangent]", fmt::format("{{along: {}}}", turned(0, 1)));
  EXPECT_LT(difference(last(upright), last(twin), turned, 0), 1e-6);  // the last digits of K count (page 4)
  EXPECT_LT((turned.back(last(twin).reactions[1]) - last(upright).reactions[1]).norm(), 1e-8 * 4e8);
}

/// Two blocks with friction between them, on rollers at their left sides and below, so that the nodes at the end of the
/// joint are held along the normal of an edge and in contact; the upper one is pushed by a rigid plate.
analysis::StaticSolution blocks(const Turned& turned, const char* left, const char* bottom, const std::string& drive) {
  return run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 10e9, poisson: 0.3}}, soft: {{young: 2e9, poisson: 0.2}}}}
bodies:
  lower: {{material: stuff, shape: {}, mesh: {{size: 0.3}}}}
  upper: {{material: soft, shape: {}, mesh: {{size: 0.3}}}}
  plate: {{rigid: true, shape: {}}}
supports:
  - {{on: lower.bottom, fix: {}}}
  - {{on: lower.left, fix: {}}}
  - {{on: upper.left, fix: {}}}
  - {{on: plate.top, {}, name: drive}}
  - {{on: plate.left, fix: {}}}
contacts:
  joint: {{between: [lower.top, upper.bottom], friction: 0.1}}
  head: {{between: [upper.top, plate.bottom], friction: 0.3}}
)",
                         turned.box(0, 0, 2, 1), turned.box(0, 1, 1.6, 1), turned.box(-0.5, 2, 3, 0.5), bottom, left,
                         left, drive, left));
}

TEST(SupportDirections, OfBlocksInContactGiveTheSame) {
  const Turned none(0.0), turned(0.5);
  const auto upright = blocks(none, "x", "y", "displacement: [null, -1e-3]");
  for (const auto& twin :
       {blocks(turned, "normal", "normal", "displacement: {normal: -1e-3}"),
        blocks(turned, "normal", "normal", fmt::format("displacement: {{along: {}, value: 2e-3}}", turned(0, -1)))}) {
    const double factor = last(twin).reactions[3].norm() / last(upright).reactions[3].norm();
    const bool twice = factor > 1.5;
    EXPECT_NEAR(factor, twice ? 2.0 : 1.0, 1e-9);  // proportional: no gaps
    if (twice) continue;
    for (std::size_t body = 0; body < 2; ++body) EXPECT_LT(difference(last(upright), last(twin), turned, body), 1e-9);
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_LT((turned.back(last(twin).reactions[i]) - last(upright).reactions[i]).norm(),
                1e-9 * last(upright).reactions[3].norm());
    EXPECT_GT(contact_of(last(twin)).slip, 0);
    const analysis::Energy &a = last(upright).energy, &b = last(twin).energy;
    EXPECT_NEAR(b.external, a.external, 1e-9 * a.external);
    EXPECT_NEAR(b.external, b.elastic + b.friction, 1e-9 * b.external);
  }
}

// Lame's ring, plane strain: u_r = (1 + nu) / E p a^2 / (b^2 - a^2) ((1 - 2 nu) r + b^2 / r). A plane of symmetry
// carries p a by equilibrium, whatever the elements.
TEST(SupportDirections, HoldASectorOfARingBetweenPlanesOfSymmetry) {
  const double p = 2e6, E = 200e9, nu = 0.3, a = 1.0, b = 2.0;
  for (const double from : {0.0, 0.4}) {
    const Turned turned(from);
    const double angle = 50.0 * std::numbers::pi / 180.0;
    const auto at = [&](double r, double theta) { return turned(r * std::cos(theta), r * std::sin(theta)); };
    const auto solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain, thickness: 0.5}}
materials: {{steel: {{young: {}, poisson: {}}}}}
bodies:
  ring:
    material: steel
    shape:
      outline:
        - {{line: {{from: {}, to: {}}}, name: cut}}
        - {{arc: {{to: {}, centre: [0, 0]}}, name: outer}}
        - {{line: {{to: {}}}, name: other_cut}}
        - {{arc: {{to: {}, centre: [0, 0], direction: clockwise}}, name: inner}}
    mesh: {{size: 0.2, order: 6}}
supports:
  - {{on: ring.cut, fix: normal}}
  - {{on: ring.other_cut, fix: [normal]}}
loads: {{oil: {{on: ring.inner, pressure: {}}}}}
)",
                                          E, nu, at(a, 0), at(b, 0), at(b, angle), at(a, angle), at(a, 0), p));
    const Vector& u = last(solution).fields.displacements.front();
    const auto& nodes = solution.mesh.bodies.front().nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double r = nodes[i].norm();
      const double radial = (1.0 + nu) / E * p * a * a / (b * b - a * a) * ((1.0 - 2.0 * nu) * r + b * b / r);
      EXPECT_LT((u.segment<2>(static_cast<Eigen::Index>(2 * i)) - radial / r * nodes[i]).norm(), 1e-7 * radial) << i;
    }
    const Vec2 cut = turned.of({0.0, -1.0}), other = turned.of({-std::sin(angle), std::cos(angle)});
    EXPECT_LT((last(solution).reactions[0] - 0.5 * p * a * cut).norm(), 1e-11 * p);
    EXPECT_LT((last(solution).reactions[1] - 0.5 * p * a * other).norm(), 1e-11 * p);
  }
}

// All edges of a triangle moved by (2, 1) mm, each along its own normal and tangent: at the corners four values for two
// components, which agree. A translation costs nothing.
TEST(SupportDirections, ThatAgreeAtCornersTranslateABody) {
  const Vec2 shift(2e-3, 1e-3);
  std::string supports;
  const Vec2 normals[] = {{0.0, -1.0}, {0.6, 0.8}, {-1.0, 0.0}};
  for (int k = 0; k < 3; ++k)
    supports += fmt::format("  - {{on: wedge.edge_{}, displacement: {{normal: {:.17g}, tangent: {:.17g}}}}}\n", k + 1,
                            normals[k].dot(shift), Vec2(-normals[k].y(), normals[k].x()).dot(shift));
  const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 10e9, poisson: 0.2}}}}
bodies:
  wedge: {{material: stuff, shape: {{polygon: {{vertices: [[0, 0], [4, 0], [0, 3]]}}}}, mesh: {{size: 1}}}}
supports:
{})",
                                        supports));
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  const Vector& u = last(solution).fields.displacements.front();
  for (Eigen::Index i = 0; i < u.size(); i += 2) EXPECT_LT((u.segment<2>(i) - shift).norm(), 1e-17);
}

TEST(SupportDirections, ThatDisagreeAtACornerAreRefused) {
  try {
    run(R"(
scabo: 1
materials: {stuff: {young: 10e9, poisson: 0.2}}
bodies:
  wedge: {material: stuff, shape: {polygon: {vertices: [[0, 0], [4, 0], [0, 3]]}}, mesh: {size: 1}}
supports:
  - {on: wedge.edge_1, fix: [x, y], name: base}
  - {on: wedge.edge_2, displacement: {normal: 1e-3}}
)");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("prescribes the displacement along (0.6, 0.8) at (4, 0), where support "
                        "'base' (line 7) prescribes another value"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace scabo::verification
