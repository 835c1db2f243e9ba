// Tied bodies move as one: nothing that is exact in one body is lost across a tie, whatever the two meshes.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "run.hpp"
#include "scabo/analysis/modal/modal_analysis.hpp"
#include "scabo/result/probe.hpp"
#include "scabo/system/dofs.hpp"

namespace scabo::verification {
namespace {

const std::vector<std::string>& tied_meshes() {
  static const std::vector<std::string> all{"{size: 0.25, order: 1}", "{size: 0.35, order: 3}",
                                            "{size: 0.27, kind: polygons, order: 2}",
                                            "{size: 0.35, kind: quadtree, order: 1}", "{size: 0.23, kind: fem}"};
  return all;
}

/// Two blocks of one material, 2 wide, 1 and 1.5 high, joined by `joint`.
std::string blocks(const std::string& lower, const std::string& upper, const std::string& joint,
                   const std::string& loads) {
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 30e9, poisson: 0.2, density: 2400}}}}
bodies:
  lower: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {}}}
  upper: {{material: m, shape: {{rectangle: {{corner: [0, 1], size: [2, 1.5]}}}}, mesh: {}}}
supports:
  - {{on: lower.bottom, fix: [y]}}
  - {{on: lower.bottom_left, fix: [x]}}
loads: {}
{}
)",
                     lower, upper, loads, joint);
}

constexpr const char* tied = "ties: {joint: {between: [lower.top, upper.bottom]}}";
constexpr const char* tied_swapped = "ties: {joint: {between: [upper.bottom, lower.top]}}";
constexpr const char* bonded = "contacts: {joint: {between: [lower.top, upper.bottom], bond: true}}";

class TiedPatch : public testing::TestWithParam<int> {};

TEST_P(TiedPatch, UniformStressOverAnyPairOfMeshes) {
  const std::string& lower = tied_meshes()[static_cast<std::size_t>(GetParam())];
  for (const std::string& upper : tied_meshes())
    for (const char* joint : {tied, tied_swapped}) {
      const auto solution = run(blocks(lower, upper, joint, "{pull: {on: upper.top, pressure: -1e6}}"));
      const analysis::IncrementResult& increment = last(solution);
      EXPECT_EQ(increment.newton_iterations, 0);
      double worst = 0.0;
      for (std::size_t b = 0; b < 2; ++b)
        for (std::size_t i = 0; i < solution.mesh.bodies[b].nodes.size(); ++i) {
          const Vec2& x = solution.mesh.bodies[b].nodes[i];
          const Vec2 exact = Vec2(-0.2 * x.x(), x.y()) * (1e6 / 30e9);
          const Vec2 u = increment.fields.displacements[b].segment<2>(static_cast<Eigen::Index>(2 * i));
          worst = std::max(worst, (u - exact).norm());
        }
      EXPECT_LT(worst, 2e-12 * 2.5e6 / 30e9) << lower << ' ' << upper;
      EXPECT_NEAR(increment.reactions[0].y(), -2e6, 2e-4);
    }
}
INSTANTIATE_TEST_SUITE_P(Meshes, TiedPatch, testing::Range(0, 5));

// A bond holds the same pairs of nodes together by forces, found by another part of the program.
TEST(Ties, AreBonds) {
  for (const std::string& lower : tied_meshes())
    for (const std::string& upper : {tied_meshes()[1], tied_meshes()[2]}) {
      const std::string loads = "{shear: {on: upper.top, traction: [1e6, 2e5]}, weight: {gravity: [1, -9.81]}}";
      const auto one = run(blocks(lower, upper, tied, loads)), other = run(blocks(lower, upper, bonded, loads));
      double scale = 0.0, difference = 0.0;
      for (std::size_t b = 0; b < 2; ++b) {
        const Vector &u = last(one).fields.displacements[b], &v = last(other).fields.displacements[b];
        ASSERT_EQ(u.size(), v.size());
        scale = std::max(scale, v.lpNorm<Eigen::Infinity>());
        difference = std::max(difference, (u - v).lpNorm<Eigen::Infinity>());
      }
      EXPECT_LT(difference, 1e-9 * scale) << lower << ' ' << upper;
      EXPECT_NEAR(last(one).energy.elastic, last(other).energy.elastic, 1e-9 * last(one).energy.elastic);
      EXPECT_NEAR(last(one).energy.external, last(one).energy.elastic, 1e-9 * last(one).energy.elastic);
      // Weight and traction, against the supports.
      const double weight = 2400 * 2 * 2.5;
      EXPECT_NEAR(last(one).reactions[0].y(), 9.81 * weight - 4e5, 1e-4);
      EXPECT_NEAR(last(one).reactions[1].x(), -weight - 2e6, 1e-3);
    }
}

// Four squares round a point, each of another mesh: the point is one node.
TEST(Ties, FourBodiesAtOnePoint) {
  std::string text = R"(
scabo: 1
materials: {m: {young: 1000, poisson: 0.3}}
bodies:
  sw: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.2}}
  se: {material: m, shape: {rectangle: {corner: [1, 0], size: [1, 1]}}, mesh: {size: 0.3, kind: polygons}}
  nw: {material: m, shape: {rectangle: {corner: [0, 1], size: [1, 1]}}, mesh: {size: 0.3, kind: quadtree}}
  ne: {material: m, shape: {rectangle: {corner: [1, 1], size: [1, 1]}}, mesh: {size: 0.25, kind: fem}}
supports:
  - {on: sw.bottom_left, fix: [x, y]}
  - {on: se.bottom, fix: [y]}
loads:
  right: {on: se.right, traction: [1, 0]}
  right_above: {on: ne.right, traction: [1, 0]}
  left: {on: sw.left, traction: [-1, 0]}
  left_above: {on: nw.left, traction: [-1, 0]}
ties: {all: {between: all}}
)";
  const auto solution = run(text);
  EXPECT_EQ(solution.model.ties.size(), 4u);
  const system::Dofs dofs(solution.model, solution.mesh);
  ASSERT_EQ(dofs.parts(), 1u);
  std::set<int> at_centre;
  for (int b = 0; b < 4; ++b)
    for (std::size_t i = 0; i < solution.mesh.bodies[static_cast<std::size_t>(b)].nodes.size(); ++i) {
      const Vec2& x = solution.mesh.bodies[static_cast<std::size_t>(b)].nodes[i];
      if ((x - Vec2(1, 1)).norm() < 1e-9) at_centre.insert(dofs.of(b, static_cast<int>(i), 0));
      const Vec2 u =
          last(solution).fields.displacements[static_cast<std::size_t>(b)].segment<2>(static_cast<Eigen::Index>(2 * i));
      EXPECT_NEAR(u.x(), x.x() / 1000, 1e-14);
      EXPECT_NEAR(u.y(), -0.3 * x.y() / 1000, 1e-14);
    }
  EXPECT_EQ(at_centre.size(), 1u);
}

// A beam in two tied halves vibrates as one body; nothing vibrates by itself.
TEST(Ties, NaturalFrequenciesAreThoseOfOneBody) {
  const std::string head = R"(
scabo: 1
analysis: {type: modal, modes: 4}
materials: {m: {young: 1, poisson: 0, density: 1}}
)";
  const std::string one = head + R"(
bodies: {beam: {material: m, shape: {rectangle: {corner: [0, 0], size: [10, 1]}}, mesh: {size: 0.25, kind: fem, order: 2}}}
supports: [{on: beam.left, fix: [x, y]}]
)";
  const std::string two = head + R"(
bodies:
  left: {material: m, shape: {rectangle: {corner: [0, 0], size: [5, 1]}}, mesh: {size: 0.25, kind: fem, order: 2}}
  right: {material: m, shape: {rectangle: {corner: [5, 0], size: [5, 1]}}, mesh: {size: 0.25, kind: fem, order: 2}}
supports: [{on: left.left, fix: [x, y]}]
ties: {middle: {between: [left.right, right.left]}}
)";
  const auto whole = analysis::solve_modal(input::parse_model(one, "one.yaml", {}));
  const auto halves = analysis::solve_modal(input::parse_model(two, "two.yaml", {}));
  ASSERT_EQ(whole.modes.size(), 4u);
  ASSERT_EQ(halves.modes.size(), 4u);
  EXPECT_NEAR(halves.total_mass, 10.0, 1e-12);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_FALSE(halves.modes[k].rigid);
    EXPECT_EQ(halves.modes[k].bodies, (std::vector<int>{0, 1}));
    EXPECT_NEAR(halves.modes[k].frequency / whole.modes[k].frequency, 1.0, 1e-9);
  }
}

// Lame: a pressurised hole in an infinite plate, in plane strain u_r = (1 + nu) p a^2 / (E r), with a mesh around the
// hole. Stress resultants and displacement in both bodies.
TEST(Ties, MeshedNearFieldInUnboundedGround) {
  const std::string text = R"(
scabo: 1
analysis: {plane: strain}
materials: {rock: {young: 2e9, poisson: 0.25}}
bodies:
  near:
    material: rock
    shape: {circle: {centre: [0, 0], radius: 3}}
    holes: {bore: {circle: {centre: [0, 0], radius: 1}}}
    mesh: {kind: polygons, size: 0.5, order: 3}
  far:
    material: rock
    outside: true
    shape: {circle: {centre: [0, 0], radius: 3}}
    mesh: {size: 0.8, order: 3}
loads: {p: {on: near.bore, pressure: 1e6}}
ties: {ground: {between: [near, far]}}
)";
  const auto solution = run(text);
  const analysis::IncrementResult& increment = last(solution);
  const result::Probe near(solution, increment.fields, 0), far(solution, increment.fields, 1);
  for (const double r : {1.3, 2.0, 2.9, 3.1, 5.0, 20.0})
    for (const double angle : {0.1, 1.9, 4.0}) {
      const Vec2 e(std::cos(angle), std::sin(angle));
      const auto values = (r < 3 ? near : far).at(r * e);
      ASSERT_TRUE(values) << r;
      EXPECT_NEAR(values->displacement.dot(e) / (1.25 * 1e6 / (2e9 * r)), 1.0, 2e-3) << r;
      const double radial = e.x() * e.x() * values->stress[0] + e.y() * e.y() * values->stress[1] +
                            2.0 * e.x() * e.y() * values->stress[2];
      EXPECT_NEAR(radial / (-1e6 / (r * r)), 1.0, 2e-2) << r;
    }
}

}  // namespace
}  // namespace scabo::verification
