// What one super-element can do, on finite elements and on meshes from files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/mesh_text.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

/// Squares of a plate [0, 1] x [-1, 1], turned by an angle and scaled; the sides from (0, 0) to (0.5, 0) are the set
/// `boundary_9`.
test::MeshText cracked_plate(int n, double angle = 0.0, double scale = 1.0) {
  test::MeshText mesh;
  const double c = std::cos(angle), s = std::sin(angle);
  for (int j = 0; j <= 2 * n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n - 1.0;
      mesh.nodes.emplace_back(scale * (c * x - s * y), scale * (s * x + c * y));
    }
  for (int j = 0; j < 2 * n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.cells.push_back({9, {a, a + 1, a + n + 2, a + n + 1}, 1});
    }
  for (int i = 0; i < n / 2; ++i) mesh.cells.push_back({3, {n * (n + 1) + i, n * (n + 1) + i + 1}, 9});
  return mesh;
}

std::string model(const std::string& body, double c, double s, double stress) {
  return fmt::format(R"(scabo: 1
materials: {{steel: {{young: {0}, poisson: 0.3}}}}
bodies: {{plate: {{material: steel, {1}}}}}
supports: [{{on: plate.vertex_1, fix: [x, y]}}]
loads: {{up: {{on: plate.edge_3, traction: [{2}, {3}]}}, down: {{on: plate.edge_1, traction: [{4}, {5}]}}}}
)",
                     200.0 * stress, body, -s * stress, c * stress, s * stress, -c * stress);
}

const double exact = 2.82546 * std::sqrt(0.5 * std::numbers::pi);  // edge crack, h/W = 1, a/W = 1/2

double K_of(const analysis::StaticSolution& solution) {
  const auto& cracks = last(solution).cracks;
  if (cracks.size() != 1) throw std::runtime_error("one tip is expected");
  EXPECT_NEAR(cracks.front().factors.K_II / cracks.front().factors.K_I, 0.0, 1e-3);
  return cracks.front().factors.K_I;
}

std::string with_rotation_held(std::string text) {
  const std::string before = "fix: [x, y]}";
  return text.replace(text.find(before), before.size(), "fix: [x, y]}, {on: plate.vertex_2, fix: [y]}");
}

// The cells around the tip become one super-element, so that finite elements give the factor as well.
TEST(CracksOnAllKinds, EdgeCrackInFiniteElements) {
  const std::string body =
      "shape: {polygon: {vertices: [[0, -1], [1, -1], [1, 1], [0, 1]]}}, "
      "cracks: [{name: flaw, tip: [0.5, 0], mouth: [0, 0]}], mesh: {kind: fem, size: 0.1, order: 2}";
  EXPECT_NEAR(K_of(run(with_rotation_held(model(body, 1, 0, 1)))) / exact, 1.0, 5e-4);
}

// Several cracks, or a path, in a body of the default kind.
TEST(CracksOnAllKinds, PathInABodyOfTheDefaultKind) {
  const std::string body =
      "shape: {polygon: {vertices: [[0, -1], [1, -1], [1, 1], [0, 1]]}}, "
      "cracks: [{name: flaw, path: [[0, 0], [0.5, 0]]}], mesh: {size: 0.25, order: 4}";
  EXPECT_NEAR(K_of(run(with_rotation_held(model(body, 1, 0, 1)))) / exact, 1.0, 1e-5);
}

// By the name of the sides in the file, or by points.
TEST(CracksOnAllKinds, EdgeCrackInAMeshFromAFile) {
  const std::string file = cracked_plate(10).file();
  for (const char* path : {"boundary_9", "[[0, 0], [0.5, 0]]"}) {
    const std::string body =
        fmt::format("cracks: [{{name: flaw, path: {}}}], mesh: {{file: {}, order: 4}}", path, file);
    EXPECT_NEAR(K_of(run(with_rotation_held(model(body, 1, 0, 1)))) / exact, 1.0, 2e-5) << path;
  }
}

// The same plate in millimetres, turned by 30 degrees: K in N / mm^1.5.
TEST(CracksOnAllKinds, TurnedAndInOtherUnits) {
  const auto K = [](double angle, double scale, double stress) {
    const std::string body = fmt::format("cracks: [{{name: flaw, path: boundary_9}}], mesh: {{file: {}, order: 2}}",
                                         cracked_plate(10, angle, scale).file());
    const double c = std::cos(angle), s = std::sin(angle);
    return K_of(run(with_rotation_held(model(body, c, s, stress))));
  };
  const double here = K(0.0, 1.0, 1.0);
  EXPECT_NEAR(K(std::numbers::pi / 6.0, 1.0, 1.0) / here, 1.0, 1e-9);
  EXPECT_NEAR(K(0.0, 1000.0, 1e-6) / (here * 1e-6 * std::sqrt(1000.0)), 1.0, 1e-9);
}

// Stress along a crack does not see it: a patch test of the doubled nodes and of the cell around the tip.
TEST(CracksOnAllKinds, StressAlongACrack) {
  const std::string file = cracked_plate(8).file();
  for (const std::string& mesh :
       {fmt::format("mesh: {{file: {}}}", file), fmt::format("mesh: {{file: {}, elements: fem}}", file)}) {
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{steel: {{young: 200, poisson: 0.25}}}}
bodies: {{plate: {{material: steel, cracks: [{{name: flaw, path: boundary_9}}], {}}}}}
supports: [{{on: plate.edge_4, fix: [x]}}, {{on: plate.vertex_1, fix: [y]}}]
loads: {{pull: {{on: plate.edge_2, traction: [1, 0]}}}}
)",
                                          mesh));
    const auto& increment = last(solution);
    EXPECT_NEAR(increment.energy.elastic, 0.5 * 2.0 / 200.0, 1e-14);
    const mesh::BodyMesh& body = solution.mesh.bodies[0];
    for (std::size_t n = 0; n < body.nodes.size(); ++n) {
      const Vec2 u = increment.fields.displacements[0].segment<2>(2 * static_cast<Eigen::Index>(n));
      EXPECT_NEAR(u.x(), body.nodes[n].x() / 200.0, 1e-14);
      EXPECT_NEAR(u.y(), -0.25 * (body.nodes[n].y() + 1.0) / 200.0, 1e-14);
    }
  }
}

/// Cook's membrane as n x n quadrilaterals; its energy is 12.02080304 (docs/methods/17_points_and_error.md).
test::MeshText cook(int n) {
  test::MeshText mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
      mesh.nodes.emplace_back(48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.cells.push_back({9, {a, a + 1, a + n + 2, a + n + 1}, 1});
    }
  return mesh;
}

TEST(ToleranceOnAllKinds, CooksMembrane) {
  const std::string file = cook(4).file();
  struct Case {
    std::string mesh;
    double tolerance;
  };
  for (const auto& [mesh, tolerance] :
       {Case{fmt::format("mesh: {{file: {}, order: 2, tolerance: 0.02}}", file), 0.02},
        Case{fmt::format("mesh: {{file: {}, elements: fem, tolerance: 0.08}}", file), 0.08},
        Case{"shape: {polygon: {vertices: [[0, 0], [48, 44], [48, 60], [0, 44]]}}, "
             "mesh: {kind: fem, size: 12, order: 2, tolerance: 0.02}",
             0.02}}) {
    const bool from_file = mesh.starts_with("mesh");
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 1, poisson: 0.333333333333333333}}}}
bodies: {{cook: {{material: m, {}}}}}
supports: [{{on: cook.edge_4, fix: [x, y]}}]
loads: {{shear: {{on: cook.edge_2, force: [0, 1]}}}}
)",
                                          mesh));
    const auto& increment = last(solution);
    const double error = std::sqrt((12.02080304 - increment.energy.elastic) / 12.02080304);
    EXPECT_LE(error, tolerance) << mesh;
    EXPECT_GT(increment.error->relative, 0.7 * error) << from_file;
    EXPECT_LT(increment.error->relative, 1.05 * error);
    EXPECT_GT(solution.passes.size(), 1);
  }
}

// A disc pressed into a ring, E d (b^2 - a^2) / (2 a b^2) = 0.75 everywhere, by straight sides of different lengths.
TEST(PressFit, SidesOfOrderOneAndOfDifferentLengths) {
  const auto solution = run(R"(scabo: 1
materials: {steel: {young: 2, poisson: 0.3}}
bodies:
  disc: {material: steel, shape: {circle: {centre: [0, 0], radius: 1}}, mesh: {size: 0.13, order: 1, kind: polygons}}
  ring:
    material: steel
    shape: {circle: {centre: [0, 0], radius: 2}}
    holes: {bore: {circle: {centre: [0, 0], radius: 1}}}
    mesh: {size: 0.2, order: 1, kind: polygons}
supports:
  - {on: {body: ring, near: [2, 0]}, fix: [y]}
  - {on: {body: ring, near: [-2, 0]}, fix: [y]}
  - {on: {body: ring, near: [0, 2]}, fix: [x]}
contacts: {fit: {between: [disc.rim, ring.bore], friction: 0.3, gap: -1e-3}}
)");
  const auto& contact = contact_of(last(solution));
  EXPECT_EQ(contact.stick, static_cast<int>(contact.pairs.size()));
  for (const auto& pair : contact.pairs) EXPECT_NEAR(pair.pressure / 0.75e-3, 1.0, 0.025);
  EXPECT_NEAR(contact.normal_force / (2.0 * std::numbers::pi * 0.75e-3), 1.0, 2e-3);
}

}  // namespace
}  // namespace scabo::verification
