// Contact and ties across the mouths of cracks, where a body has two nodes at one point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/mesh_text.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

/// Two blocks of 2 x 1 m on each other, the lower one with a crack up to their interface at `x`; 2 MPa from above.
std::string blocks(const std::string& kind, const std::string& size, const std::string& upper_size, double x,
                   const std::string& rest) {
  return fmt::format(R"(scabo: 1
materials: {{stone: {{young: 10e9, poisson: 0.2}}}}
bodies:
  lower:
    material: stone
    shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}
    mesh: {{kind: {0}, size: {1}}}
    cracks: [{{path: [[{3}, 1], [{3}, 0.5]], name: flaw}}]
  upper: {{material: stone, shape: {{rectangle: {{corner: [0, 1], size: [2, 1]}}}}, mesh: {{kind: {0}, size: {2}}}}}
supports: [{{on: lower.left, fix: x}}, {{on: upper.left, fix: x}}, {{on: lower.bottom, fix: y}}]
loads: {{press: {{on: upper.top, pressure: 2e6}}}}
{4}
)",
                     kind, size, upper_size, x, rest);
}

class Mouths : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Mouths, testing::Values("polygons", "quadtree", "fem"),
                         [](const auto& kind) { return std::string(kind.param); });

// A uniform state: the crack is parallel to the pressure and does not show. One of its two nodes at the interface once
// had no partner: pressures of up to 2.8 MPa however fine the mesh, a factor K_II, and a certificate of 1e-15.
TEST_P(Mouths, OfACrackInContactLeaveAUniformPressureUniform) {
  for (const char* upper_size : {"0.25", "0.17"})
    for (const double x : {1.0, 0.7}) {
      const auto solution = run(blocks(GetParam(), "0.25", upper_size, x,
                                       "contacts: {joint: {between: [lower.top, upper.bottom], friction: 0.3}}"));
      const analysis::IncrementResult& at = last(solution);
      for (const analysis::PairResult& pair : contact_of(at).pairs) {
        EXPECT_NEAR(pair.pressure, 2e6, 2e6 * 1e-8) << "at x = " << pair.position.x();
        EXPECT_NEAR(pair.shear, 0.0, 2e6 * 1e-8);
      }
      EXPECT_NEAR(at.energy.elastic, 800.0, 800.0 * 1e-10);  // 2e6^2 / (2 10e9) times 4 m^2
      ASSERT_EQ(at.cracks.size(), 1u);
      EXPECT_NEAR(at.cracks[0].factors.K_I, 0.0, 1e-3);
      EXPECT_NEAR(at.cracks[0].factors.K_II, 0.0, 1e-3);
    }
}

TEST_P(Mouths, SidesMayBeSwapped) {
  const auto text = [&](const char* between) {
    return blocks(GetParam(), "0.25", "0.25", 0.7, fmt::format("contacts: {{joint: {{{}, friction: 0.3}}}}", between));
  };
  const auto one = run(text("between: [lower.top, upper.bottom]")),
             two = run(text("between: [upper.bottom, lower.top]"));
  ASSERT_EQ(contact_of(last(one)).pairs.size(), contact_of(last(two)).pairs.size());
  EXPECT_EQ(contact_of(last(one)).normal_force, contact_of(last(two)).normal_force);
}

TEST_P(Mouths, OfACrackInATieLeaveAUniformPressureUniform) {
  const auto solution =
      run(blocks(GetParam(), "0.25", "0.17", 0.7, "ties: {joint: {between: [lower.top, upper.bottom]}}"));
  EXPECT_NEAR(last(solution).energy.elastic, 800.0, 800.0 * 1e-10);
  EXPECT_NEAR(last(solution).cracks[0].factors.K_II, 0.0, 1e-3);
}

// A crack that runs through two tied bodies is that of one body: left is tied to left, right to right. Tied crosswise
// it was held shut at the tie, K_I 18 % too small.
TEST(MouthsThatMeet, AreOneCrack) {
  const std::string base = R"(scabo: 1
materials: {stone: {young: 10e9, poisson: 0.2}}
)";
  const auto tied = run(base + R"(
bodies:
  a: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.125, kind: quadtree, order: 2},
      cracks: [{path: [[1, 1], [1, 0.5]], name: k}]}
  b: {material: stone, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {size: 0.125, kind: quadtree, order: 2},
      cracks: [{path: [[1, 1], [1, 1.5]], name: k}]}
supports: [{on: a.left, fix: x}, {on: b.left, fix: x}, {on: a.bottom, fix: y}]
loads: {p: {on: b.right, traction: [1e6, 0]}, q: {on: a.right, traction: [1e6, 0]}}
ties: {t: {between: [a.top, b.bottom]}}
)");
  const auto whole = run(base + R"(
bodies:
  a: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 2]}}, mesh: {size: 0.125, kind: quadtree, order: 2},
      cracks: [{path: [[1, 1.5], [1, 0.5]], name: k}]}
supports: [{on: a.left, fix: x}, {on: a.bottom, fix: y}]
loads: {p: {on: a.right, traction: [1e6, 0]}}
)");
  EXPECT_NEAR(last(tied).energy.elastic / last(whole).energy.elastic, 1.0, 1e-5);
  double of_tied = 0.0, of_whole = 0.0;
  for (const auto& crack : last(tied).cracks)
    if (crack.name == "a.k.end") of_tied = crack.factors.K_I;
  for (const auto& crack : last(whole).cracks)
    if (crack.name == "a.k.end") of_whole = crack.factors.K_I;
  EXPECT_GT(of_whole, 1e6);
  EXPECT_NEAR(of_tied / of_whole, 1.0, 1e-4);
}

/// Squares of a plate [-1, 1]^2 whose sides from (-1, 0) to (0, 0) have nodes of their own above and below, or are the
/// set `boundary_9`.
test::MeshText plate(bool slit) {
  constexpr int n = 16;
  test::MeshText mesh;
  const auto node = [](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.nodes.emplace_back(2.0 * i / n - 1.0, 2.0 * j / n - 1.0);
  if (slit)
    for (int i = 0; i < n / 2; ++i) mesh.nodes.emplace_back(2.0 * i / n - 1.0, 0.0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto below = [&](int k) { return slit && j == n / 2 && k < n / 2 ? (n + 1) * (n + 1) + k : node(k, j); };
      mesh.cells.push_back({9, {below(i), below(i + 1), node(i + 1, j + 1), node(i, j + 1)}, 1});
    }
  for (int i = 0; i < n; ++i) {
    mesh.cells.push_back({3, {node(i, 0), node(i + 1, 0)}, 1});
    mesh.cells.push_back({3, {node(i, n), node(i + 1, n)}, 2});
  }
  if (!slit)
    for (int i = 0; i < n / 2; ++i) mesh.cells.push_back({3, {node(i, n / 2), node(i + 1, n / 2)}, 9});
  return mesh;
}

double factor_of(const test::MeshText& mesh, const std::string& path) {
  const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 200e9, poisson: 0.3}}}}
bodies: {{plate: {{material: steel, mesh: {{file: {}, order: 2}}, cracks: [{{name: flaw, path: {}}}]}}}}
supports: [{{on: plate.boundary_1, fix: [x, y]}}]
loads: {{pull: {{on: plate.boundary_2, traction: [0, 1e6]}}}}
)",
                                        mesh.file(), path));
  return last(solution).cracks.at(0).factors.K_I;
}

// A file may have been slit when it was made: its crack has nodes of its own on both sides.
TEST(Slits, OfAMeshFromAFileAreCracks) {
  const double opened_here = factor_of(plate(false), "boundary_9"), slit = factor_of(plate(true), "[[-1, 0], [0, 0]]");
  EXPECT_NEAR(opened_here, 5.0914e6, 2e-4 * 5.0914e6);  // polygons of order 4
  EXPECT_NEAR(slit / opened_here, 1.0, 1e-10);
}

}  // namespace
}  // namespace scabo::verification
