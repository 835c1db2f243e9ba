// Which bodies hold a point: outside bodies with and without side faces, cracks, arcs.
#include "scabo/mesh/plane/output_points.hpp"

#include <gtest/gtest.h>

#include "scabo/input/read_model.hpp"

namespace scabo::mesh {
namespace {

model::Model model_of(const std::string& body) {
  return input::parse_model(
      "scabo: 1\nmaterials: {rock: {young: 1, poisson: 0.2}}\nbodies:\n  ground: {material: rock, " + body +
          "}\nloads: {p: {on: ground.edge_2, pressure: 1}}\nsupports: [{on: ground.edge_3, fix: [x, y]}]\n",
      "test.yaml");
}

// A trench 4 wide and 3 deep: the scaling centre on the surface in its middle, side faces from (8, 0) and (12, 0) on.
TEST(OutputPoints, OfAHalfPlaneWithATrenchLieInTheGround) {
  const model::Body body =
      model_of(
          "outside: true, shape: {polygon: {vertices: [[10, 0], [8, 0], [8, -3], [12, -3], [12, 0]]}}, "
          "mesh: {size: 1, centre: [10, 0]}")
          .bodies[0];
  for (const Vec2& x : {Vec2(8, 0), Vec2(12, 0), Vec2(0, 0), Vec2(-1e6, 0), Vec2(14, 0), Vec2(8, -1), Vec2(10, -3),
                        Vec2(10, -1e9), Vec2(12, -3), Vec2(20, -0.1)})
    EXPECT_TRUE(holds(body, x)) << x.transpose();
  // In the trench, on the way from the centre to the mouths of the faces, above the ground.
  for (const Vec2& x :
       {Vec2(10, 0), Vec2(9, 0), Vec2(11.999, 0), Vec2(10, -1), Vec2(8.1, -2.9), Vec2(0, 0.1), Vec2(10, 5)})
    EXPECT_FALSE(holds(body, x)) << x.transpose();
}

TEST(OutputPoints, OfTheGroundAroundATunnelLieOutsideItsOutline) {
  const model::Body body =
      model_of(
          "outside: true, shape: {outline: [{arc: {from: [1, 0], to: [0, 1], centre: [0, 0]}}, "
          "{arc: {to: [-1, 0], centre: [0, 0]}}, {arc: {to: [1, 0], centre: [0, 0]}}]}, mesh: {size: 0.5}")
          .bodies[0];
  for (const Vec2& x : {Vec2(1, 0), Vec2(std::cos(0.3), std::sin(0.3)), Vec2(0, -1.01), Vec2(1e9, 1e9)})
    EXPECT_TRUE(holds(body, x)) << x.transpose();
  for (const Vec2& x : {Vec2(0, 0), Vec2(0.5, 0.1), Vec2(0, 0.999)}) EXPECT_FALSE(holds(body, x)) << x.transpose();
}

TEST(OutputPoints, OfACrackedBodyLieOnTheCrackAndAtItsEnds) {
  const model::Body body = model_of(
                               "shape: {polygon: {vertices: [[0, 0], [2, 0], [2, 2], [0, 2]]}}, mesh: {size: 0.5}, "
                               "cracks: [{tip: [1, 1], mouth: [0, 1]}]")
                               .bodies[0];
  for (const Vec2& x : {Vec2(0, 1), Vec2(0.5, 1), Vec2(1, 1), Vec2(1.5, 1), Vec2(2, 2)})
    EXPECT_TRUE(holds(body, x)) << x.transpose();
  EXPECT_FALSE(holds(body, {-1e-3, 1}));
}

}  // namespace
}  // namespace scabo::mesh
