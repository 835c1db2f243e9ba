// Displacements and rotations of bodies in space that are not small: known motions of a block.
#include "scabo/analysis/space/large_motions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/solid_blocks.hpp"

namespace scabo::analysis {
namespace {

constexpr double size = 3.0;  // the diagonal of a block of 1 x 2 x 2

mesh::SolidMesh block() { return test::solid_block({5.0, -1.0, 0.0}, {6.0, 1.0, 2.0}, {2, 3, 2}, 10); }

/// u = along + turn x (x - centre) + stretch * (x - centre) along x.
SolidMotion moved(const Eigen::Vector3d& along, const Eigen::Vector3d& turn, double stretch = 0.0) {
  const mesh::SolidMesh mesh = block();
  Vector u(3 * mesh.nodes.cols());
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    const Eigen::Vector3d arm = mesh.nodes.col(i) - Eigen::Vector3d(5.5, 0.0, 1.0);
    u.segment<3>(3 * i) = along + turn.cross(arm) + stretch * arm.x() * Eigen::Vector3d::UnitX();
  }
  return motion_of(mesh, u);
}

TEST(LargeMotions, TellTurningMovingAndDeforming) {
  const SolidMotion turned = moved({1.0, 2.0, -2.0}, {0.02, -0.03, 0.06});
  EXPECT_NEAR(turned.rotation, 0.07, 1e-14);
  EXPECT_NEAR(turned.deformed, 0.0, 1e-14);
  EXPECT_NEAR(turned.size, size, 1e-12);
  const SolidMotion stretched = moved(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.4);
  EXPECT_NEAR(stretched.rotation, 0.0, 1e-14);
  EXPECT_NEAR(stretched.displacement, 0.2, 1e-14);
  EXPECT_NEAR(stretched.deformed, 0.2, 1e-14);
}

TEST(LargeMotions, AreThoseBeyondTheTheory) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const auto found = [](const std::vector<SolidMotion>& motions, const std::vector<bool>& rigid) {
    const auto large = large_motion_of(motions, rigid);
    return large ? large->body : -1;
  };
  const SolidMotion still = moved(none, none), far = moved({0.0, 0.31, 0.0}, none),
                    near = moved({0.0, 0.29, 0.0}, none);
  EXPECT_EQ(found({still, near}, {false, false}), -1);
  EXPECT_EQ(found({still, far}, {false, false}), 1);
  EXPECT_EQ(found({still, far}, {false, true}), -1);  // a rigid body may be driven as far as it likes
  EXPECT_EQ(found({far, moved(none, {0.0, 0.0, 0.11}), moved(none, {0.2, 0.0, 0.0})}, {false, false, true}), 2);
  EXPECT_EQ(found({moved(none, {0.0, 0.1, 0.0})}, {true}), -1);  // as prescribed rotations may be
}

TEST(LargeMotions, SayWhatItIs) {
  const auto text = [](const SolidMotion& motion) { return LargeMotion{0, motion}.text("lid"); };
  EXPECT_NE(text(moved({0.0, 0.0, 0.0}, {0.0, 0.2, 0.0})).find("body 'lid' turns by 0.2 rad"), std::string::npos);
  EXPECT_NE(text(moved({0.0, 1.0, 0.0}, {0.0, 0.0, 0.0})).find("it moves as a whole"), std::string::npos);
  EXPECT_NE(text(moved({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.8)).find("0.4 of it are deformation"), std::string::npos);
}

}  // namespace
}  // namespace scabo::analysis
