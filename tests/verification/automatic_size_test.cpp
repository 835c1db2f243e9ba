// Sizes of meshes: those of single edges, graded, and those that follow from a wanted error.
#include <fmt/format.h>

#include <cmath>

#include "scabo/mesh/mesh.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

/// A plate 4 x 3 with a hole of radius 0.5, pulled to the right; symmetric supports are points.
std::string plate(const std::string& mesh, double scale, const std::string& more = {}) {
  return fmt::format(R"(scabo: 1
materials: {{steel: {{young: 200e9, poisson: 0.3}}}}
bodies:
  plate:
    material: steel
    shape: {{rectangle: {{corner: [{0}, {1}], size: [{2}, {3}]}}}}
    holes: {{bore: {{circle: {{centre: [0, 0], radius: {4}}}}}}}
    mesh: {{{5}}}
supports: [{{on: plate.bottom_left, fix: [x, y]}}, {{on: plate.bottom_right, fix: y}}]
loads:
  pull: {{on: plate.right, traction: [100e6, 0]}}
  hold: {{on: plate.left, traction: [-100e6, 0]}}
{6}
)",
                     -2.0 * scale, -1.5 * scale, 4.0 * scale, 3.0 * scale, 0.5 * scale, mesh, more);
}

struct SizeCase {
  const char* kind;
  double tolerance;
};
class AutomaticSize : public testing::TestWithParam<SizeCase> {};

TEST_P(AutomaticSize, MeetsTheWantedError) {
  const double reference = last(run(plate("kind: polygons, size: 0.25, order: 6", 1.0))).energy.elastic;
  for (const double scale : {1.0, 1e-3}) {
    const auto solution =
        run(plate(fmt::format("{}, size: auto, tolerance: {}", GetParam().kind, GetParam().tolerance), scale));
    const double energy = last(solution).energy.elastic / (scale * scale);
    // Under tractions alone the energy of a mesh is too small by the square of its error.
    EXPECT_LE(std::sqrt(std::max(0.0, 1.0 - energy / reference)), GetParam().tolerance) << scale;
    ASSERT_FALSE(solution.passes.empty());
    EXPECT_LT(solution.passes.front().dofs, 3000) << "the first mesh is a coarse one";
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, AutomaticSize,
                         testing::Values(SizeCase{"kind: superelement", 0.01}, SizeCase{"kind: polygons", 0.01},
                                         SizeCase{"kind: quadtree", 0.01}, SizeCase{"kind: fem", 0.03}));

TEST(AutomaticSizeOfAModel, FollowsFromTheToleranceOfOneNumber) {
  const char* number = "output: {points: [{at: [2, 0], name: end}]}\ntolerance: {of: end.ux, relative: 1e-3}";
  const auto solution = run(plate("kind: quadtree, size: auto", 1.0, number));
  const auto& bar = last(solution).quantities.at(0);
  EXPECT_LE(bar.relative(), 1e-3);
  const auto finer = run(plate("kind: polygons, size: 0.25, order: 6", 1.0,
                               "output: {points: [{at: [2, 0], name: end}], error_of: [end.ux]}"));
  const double reference = last(finer).quantities.at(0).finer;
  EXPECT_NEAR(bar.value, reference, bar.bar);
}

class SizeOfAnEdge : public testing::TestWithParam<const char*> {};

TEST_P(SizeOfAnEdge, HoldsAlongItAndGrowsAsSaid) {
  const double size = 0.6, on_top = 0.05, growth = 0.25;
  const auto model = input::parse_model(fmt::format(R"(scabo: 1
materials: {{steel: {{young: 200e9, poisson: 0.3}}}}
bodies:
  plate:
    material: steel
    shape: {{rectangle: {{corner: [0, 0], size: [3, 3]}}}}
    mesh: {{{}, size: {}, refine: [{{on: top, size: {}, growth: {}}}]}}
supports: [{{on: plate.bottom, fix: [x, y]}}]
loads: {{pull: {{on: plate.top, traction: [1, 0]}}}}
)",
                                                    GetParam(), size, on_top, growth),
                                        "test.yaml");
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const mesh::BodyMesh& body = mesh.bodies[0];
  const auto length = [&](const mesh::LineElement& element) {
    return (body.nodes[static_cast<std::size_t>(element.nodes.back())] -
            body.nodes[static_cast<std::size_t>(element.nodes.front())])
        .norm();
  };
  for (const mesh::LineElement& element : body.edges[2]) {
    EXPECT_LE(length(element), on_top * (1.0 + 1e-9));
    EXPECT_GE(length(element), 0.3 * on_top);
  }
  double longest = 0.0;
  for (const mesh::LineElement& element : body.edges[1]) {  // upwards, to the top
    const double y = std::min(body.nodes[static_cast<std::size_t>(element.nodes.front())].y(),
                              body.nodes[static_cast<std::size_t>(element.nodes.back())].y());
    EXPECT_LE(length(element), 1.001 * std::min(size, on_top + growth * (3.0 - y))) << y;
    longest = std::max(longest, length(element));
  }
  EXPECT_GT(longest, 4.0 * on_top);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SizeOfAnEdge,
                         testing::Values("kind: superelement", "kind: polygons", "kind: quadtree", "kind: fem"));

}  // namespace
}  // namespace scabo::verification
