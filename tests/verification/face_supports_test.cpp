// Supports and springs on the faces of cracks: uniform fields, Betti's theorem, the same in other words.
#include <fmt/format.h>

#include <cmath>

#include "run.hpp"

namespace scabo::verification {
namespace {

constexpr double E = 2e9, nu = 0.25, t = 0.3, sigma = 1e6, eps = sigma / E;

/// A plate of 4 x 4 with a crack from the middle of its left edge to its centre, on rollers at its bottom.
/// Left face: above the crack, normal (0, -1); right face: below it, normal (0, 1).
std::string plate(const std::string& mesh, const std::string& rest, double scale = 1.0,
                  const std::string& path = "[[0, 2], [2, 2]]") {
  const std::string shape = scale == 1.0 ? "[4, 4]" : fmt::format("[{}, {}]", 4 * scale, 4 * scale);
  return fmt::format(R"(scabo: 1
analysis: {{thickness: {}}}
materials: {{m: {{young: {}, poisson: {}}}}}
bodies:
  plate:
    material: m
    shape: {{rectangle: {{corner: [0, 0], size: {}}}}}
    mesh: {{{}}}
    cracks: [{{name: slit, path: {}}}]
{})",
                     t, E, nu, shape, mesh, path, rest);
}

const std::vector<std::string> meshes = {"kind: polygons, size: 1", "kind: quadtree, size: 1, order: 2",
                                         "kind: fem, size: 0.5, order: 2"};

// Faces that move as in the plate without a crack leave its uniform tension as it is; forces are sigma times the area.
TEST(SupportsOnCrackFaces, KeepAUniformTension) {
  for (const auto& [mesh, face] :
       {std::pair(meshes[0], "displacement: {{normal: {0}}}"), std::pair(meshes[1], "displacement: [null, {1}]"),
        std::pair(meshes[2], "displacement: {{along: [0, 2], value: {1}}}")}) {
    const std::string form = face;
    const auto moved = [&](double outwards, double up) { return fmt::format(fmt::runtime(form), outwards, up); };
    const auto solution = run(plate(mesh, fmt::format(R"(supports:
  - {{on: plate.bottom, fix: normal}}
  - {{on: plate.bottom_left, fix: x}}
  - {{on: plate.slit.left, {}, name: upper}}
  - {{on: plate.slit.right, {}, name: lower}}
loads: {{pull: {{on: plate.top, traction: [0, {}]}}}}
)",
                                                      moved(-2 * eps, 2 * eps), moved(2 * eps, 2 * eps), sigma)));
    const analysis::IncrementResult& increment = last(solution);
    const double force = sigma * 2.0 * t;
    EXPECT_LT((increment.reactions[2] - Vec2(0.0, -force)).norm(), 1e-6 * force) << mesh;
    EXPECT_LT((increment.reactions[3] - Vec2(0.0, force)).norm(), 1e-6 * force) << mesh;
    EXPECT_LT((increment.reactions[0] + Vec2(0.0, 2.0 * force)).norm(), 1e-6 * force);
    ASSERT_EQ(increment.cracks.size(), 1u);
    EXPECT_TRUE(std::isnan(increment.cracks.front().factors.K_I));
    bool told = false;
    for (const Warning& warning : solution.warnings)
      told = told || warning.text.find("stress intensity factors are undefined") != std::string::npos;
    EXPECT_TRUE(told);
  }
}

// Betti's theorem with the uniform tension of the plate without a crack: for faces that move by c_1 (below) and c_2
// (above) and a top that is held, R_1 + R_2 + 2 R_top = E t (c_1 - c_2). A wedge: c_2 > c_1.
TEST(SupportsOnCrackFaces, OpenACrackWithTheForcesOfBettisTheorem) {
  const std::vector<std::pair<double, double>> moved = {{-1e-4, 3e-4}, {0.0, 2e-4}, {-2e-4, -2e-4}};
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const std::string& mesh = meshes[k];
    const auto [below, above] = moved[k];
    const auto solution = run(plate(mesh, fmt::format(R"(supports:
  - {{on: plate.bottom, fix: normal}}
  - {{on: plate.bottom_left, fix: x}}
  - {{on: plate.top, fix: normal}}
  - {{on: plate.slit.left, displacement: {{normal: {}}}}}
  - {{on: plate.slit.right, displacement: {{normal: {}}}}}
)",
                                                      -above, below)));
    const analysis::IncrementResult& increment = last(solution);
    const double bottom = increment.reactions[0].y(), top = increment.reactions[2].y(),
                 upper = increment.reactions[3].y(), lower = increment.reactions[4].y();
    const double size = std::abs(upper) + std::abs(lower);
    EXPECT_NEAR(upper + lower + 2.0 * top, E * t * (below - above), 1e-6 * size) << mesh;
    EXPECT_NEAR(bottom + top + upper + lower, 0.0, 1e-9 * size);
    if (above > below) EXPECT_GT(upper, 0.0);
    if (above > below) EXPECT_LT(lower, 0.0);
  }
}

// fix: [x, y], normal with tangent, and both directions of a turned pair are the same.
TEST(SupportsOnCrackFaces, AreTheSameInOtherWords) {
  const auto with = [&](const std::string& face, double scale = 1.0) {
    const auto solution =
        run(plate(scale == 1.0 ? "kind: polygons, size: 1" : fmt::format("kind: polygons, size: {}", scale),
                  fmt::format(R"(supports:
  - {{on: plate.bottom, fix: [x, y]}}
{}
loads: {{pull: {{on: plate.top, traction: [3e5, 1e6]}}}}
)",
                              face),
                  scale, fmt::format("[[0, {}], [{}, {}]]", 2 * scale, 2 * scale, 2 * scale)));
    const analysis::IncrementResult& increment = last(solution);
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 1; i < increment.reactions.size(); ++i) sum += increment.reactions[i];
    return Vec2(sum / scale);
  };
  const Vec2 fixed = with("  - {on: plate.slit.right, fix: [x, y]}");
  EXPECT_GT(fixed.norm(), 1e5);
  for (const char* same :
       {"  - {on: plate.slit.right, fix: [normal, tangent]}",
        "  - {on: plate.slit.right, fix: {along: [1, 1]}}\n  - {on: plate.slit.right, fix: {along: [1, -2]}}",
        "  - {on: plate.slit.right, displacement: {normal: 0, tangent: 0}}"})
    EXPECT_LT((with(same) - fixed).norm(), 1e-9 * fixed.norm()) << same;
  for (const double scale : {1e-3, 1e3})
    EXPECT_LT((with("  - {on: plate.slit.right, fix: [x, y]}", scale) - fixed).norm(), 1e-6 * fixed.norm());
}

// Springs that are at rest where they pull with sigma in the plate without a crack.
TEST(SpringsOnCrackFaces, KeepAUniformTension) {
  const double k = 5e9, force = sigma * 2.0 * t;
  for (const std::string& mesh : meshes) {
    const auto solution = run(plate(mesh, fmt::format(R"(supports:
  - {{on: plate.bottom, fix: normal}}
  - {{on: plate.bottom_left, fix: x}}
springs:
  - {{on: plate.slit.left, k_n: {0}, at_rest: [{1}, 0], name: upper}}
  - {{on: plate.slit.right, k_n: {0}, at_rest: [{2}, 0], name: lower}}
loads: {{pull: {{on: plate.top, traction: [0, {3}]}}}}
)",
                                                      k, sigma / k - 2 * eps, sigma / k + 2 * eps, sigma)));
    const analysis::IncrementResult& increment = last(solution);
    EXPECT_LT((increment.springs[0] - Vec2(0.0, -force)).norm(), 1e-6 * force) << mesh;
    EXPECT_LT((increment.springs[1] - Vec2(0.0, force)).norm(), 1e-6 * force) << mesh;
    ASSERT_EQ(increment.cracks.size(), 1u);
    EXPECT_LT(std::abs(increment.cracks.front().factors.K_I), 1e-3 * sigma);  // sigma sqrt(pi a) without the springs
  }
}

}  // namespace
}  // namespace scabo::verification
