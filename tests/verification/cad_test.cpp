// Bodies from a CAD file that Gmsh's library meshes: uniform states of stress, and friction between two of its faces.
#include "scabo/files/cad.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "verification/run.hpp"

namespace scabo::verification {
namespace {

namespace fs = std::filesystem;

/// Two blocks of 2 m x 1 m, one on the other, with a common curve.
class CadBlocks : public testing::Test {
 protected:
  void SetUp() override {
    if (!files::reads_cad()) GTEST_SKIP() << "built without Gmsh's library";
    file_ = fs::temp_directory_path() / fmt::format("scabo_cad_test_{}.geo", ::getpid());
    std::ofstream(file_) << R"(
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 1, 0}; Point(4) = {0, 1, 0};
Point(5) = {2, 2, 0}; Point(6) = {0, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(2) = {2};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
Physical Curve("base") = {1}; Physical Curve("top") = {6}; Physical Curve("left") = {4, 7};
)";
  }
  void TearDown() override { fs::remove(file_); }

  fs::path file_;
};

// One body of both faces under pressure on its top: plane stress, u = (0.2 x, -y) / 30.
TEST_F(CadBlocks, UniformStress) {
  for (const char* mesh : {"size: 0.3", "size: 0.3, order: 1", "size: 0.3, order: 3", "size: 0.3, elements: fem"}) {
    const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{type: static, plane: stress}}
materials: {{m: {{young: 30, poisson: 0.2}}}}
bodies: {{block: {{material: m, mesh: {{file: {}, {}}}}}}}
supports: [{{on: block.base, fix: [y]}}, {{on: block.left, fix: [x]}}]
loads: {{top: {{on: block.top, pressure: 1}}}}
)",
                                          file_.string(), mesh));
    const auto& increment = last(solution);
    for (std::size_t i = 0; i < solution.mesh.bodies[0].nodes.size(); ++i) {
      const Vec2& x = solution.mesh.bodies[0].nodes[i];
      EXPECT_LT((increment.fields.displacements[0].segment<2>(static_cast<Eigen::Index>(2 * i)) -
                 Vec2(0.2 * x.x(), -x.y()) / 30.0)
                    .norm(),
                1e-12)
          << mesh;
    }
  }
}

// The nodes of both faces agree on the curve; the joint carries all of the load by friction.
TEST_F(CadBlocks, FrictionBetweenTwoFaces) {
  const auto solution = run(fmt::format(R"(scabo: 1
materials: {{m: {{young: 30, poisson: 0.2}}}}
bodies:
  lower: {{material: m, mesh: {{file: {0}, size: 0.25, region: lower}}}}
  upper: {{material: m, mesh: {{file: {0}, size: 0.25, region: upper, elements: fem}}}}
supports: [{{on: lower.base, fix: [x, y]}}]
loads: {{push: {{on: upper.top, traction: [0.02, -0.1]}}}}
contacts: {{joint: {{between: [lower.to_upper, upper.to_lower], friction: 0.5}}}}
)",
                                        file_.string()));
  const auto& contact = contact_of(last(solution));
  EXPECT_EQ(contact.pairs.size(), 17u);  // 8 sides of 0.25 m, each with a middle node
  double normal = 0.0;
  for (const auto& pair : contact.pairs) normal += pair.normal_force;
  EXPECT_NEAR(normal, 0.2, 1e-12);
}

}  // namespace
}  // namespace scabo::verification
