// The same body in other units and at another place gets the same cells.
#include <gtest/gtest.h>

#include <cmath>

#include "models.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/many_cells.hpp"

namespace scabo::mesh {
namespace {

struct Telling {
  const char* name;
  double scale;
  Vec2 move;  // in sizes of the body
};
void PrintTo(const Telling& telling, std::ostream* out) { *out << telling.name; }

/// A plate of 3 by 1.1 with a round hole, a triangle of another material and a bent crack, where the kind may have one.
model::Body plate(model::MeshKind kind, int order, const Telling& telling) {
  const auto at = [&](double x, double y) {
    return Vec2(telling.scale * (x + 3.0 * telling.move.x()), telling.scale * (y + 3.0 * telling.move.y()));
  };
  model::Outline outline =
      test::polygon({at(0, 0), at(3, 0), at(3, 1.1), at(0.1, 1.0)}, {"bottom", "right", "top", "left"});
  outline.holes = {4};
  for (const double from : {0.0, -test::pi}) {
    outline.edges.push_back(test::arc("hole", at(2.3, 0.53), 0.2 * telling.scale, from, -test::pi));
    outline.corners.push_back({{"hole_corner"}, outline.edges.back().start});
  }
  outline.edges[5].start = outline.edges[4].end;
  outline.edges[5].end = outline.edges[4].start;
  model::Body body = test::elastic("plate", outline, 0.21 * telling.scale, order);
  body.mesh.kind = kind;
  if (kind != model::MeshKind::parts) body.mesh.refine.push_back({at(1, 1), -1, 0.07 * telling.scale, {}});
  model::Region region;
  region.material = 1;
  region.outline = test::polygon({at(1.2, 0.3), at(1.8, 0.35), at(1.5, 0.8)}, {"a", "b", "c"});
  body.regions = {region};
  if (kind == model::MeshKind::polygons || kind == model::MeshKind::quadtree) {
    model::Crack crack;
    crack.name = "crack";
    crack.path = {at(0.3, 0.3), at(0.6, 0.4), at(0.8, 0.3)};
    body.cracks = {crack};
  }
  return body;
}

class UnitFreeMesh : public testing::TestWithParam<Telling> {};

TEST_P(UnitFreeMesh, HasTheSameCellsAndItsBoundaryOnTheOutline) {
  const Telling& telling = GetParam();
  using enum model::MeshKind;
  for (const model::MeshKind kind : {polygons, quadtree, parts, fem})
    for (const int order : {1, 2}) {
      const model::Body body = plate(kind, order, telling);
      auto reference = divide_into_cells(plate(kind, order, {"m", 1.0, {0, 0}}), {}, 1e6);
      auto told = divide_into_cells(body, {}, 1e6);
      ASSERT_TRUE(std::holds_alternative<BodyMesh>(reference));
      ASSERT_TRUE(std::holds_alternative<BodyMesh>(told));
      const BodyMesh &expected = std::get<BodyMesh>(reference), &mesh = std::get<BodyMesh>(told);
      ASSERT_EQ(mesh.nodes.size(), expected.nodes.size());
      ASSERT_EQ(mesh.cells.size(), expected.cells.size());
      // Coordinates carry the rounding of the given ones, which grows with their distance from the origin.
      const double tolerance = 1e-12 + 1e-15 * 3.0 * telling.move.norm();
      const auto own = [&](const Vec2& x) { return Vec2(x / telling.scale - 3.0 * telling.move); };
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        ASSERT_LT((own(mesh.nodes[i]) - expected.nodes[i]).norm(), 3.0 * tolerance);
      for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        ASSERT_EQ(mesh.cells[c].nodes(), expected.cells[c].nodes());
        // A centre at the middle of where all sides are seen amplifies rounding.
        ASSERT_LT((own(mesh.cells[c].centre) - expected.cells[c].centre).norm(), 30.0 * tolerance);
      }
      for (std::size_t e = 0; e < mesh.edges.size(); ++e)
        for (const LineElement& element : mesh.edges[e])
          for (const int node : element.nodes) {
            const Vec2& x = mesh.nodes[static_cast<std::size_t>(node)];
            if (body.outline.edges[e].arc && kind == fem && node != element.nodes.front()) continue;  // straight sides
            ASSERT_LE(geometry::distance_to(body.outline.edges[e], x), 1e-15 * (x.norm() + telling.scale));
          }
    }
}

INSTANTIATE_TEST_SUITE_P(Tellings, UnitFreeMesh,
                         testing::Values(Telling{"millimetres", 1e3, {0, 0}}, Telling{"kilometres", 1e-3, {0, 0}},
                                         Telling{"inches", 1.0 / 0.0254, {0, 0}}, Telling{"third", 1.0 / 3.0, {0, 0}},
                                         Telling{"far", 1.0, {1000, -700}}, Telling{"far_in_mm", 1e3, {-1000, 333}},
                                         Telling{"farther", 1.0, {-123, 1777}}),
                         [](const auto& given) { return given.param.name; });

TEST(UnitFreeMesh, DividesAnEdgeThatIsAMultipleOfTheSizeAsOftenAsThat) {
  for (const double scale : {1.0, 1e-3, 0.0254, 7.0})
    for (const int count : {3, 10, 97, 1000}) {  // the top is a hundredth of the body, which rounding must not see
      model::Body body = test::elastic(
          "wedge",
          test::polygon({scale * Vec2(0, 0), scale * Vec2(1, 0), scale * Vec2(0.01, 0.3), scale * Vec2(0, 0.3)},
                        {"bottom", "right", "top", "left"}),
          scale * 0.01 / count, 1);
      body.mesh.kind = model::MeshKind::parts;
      const auto mesh = divide_into_cells(body, {}, 1e7);
      EXPECT_EQ(std::get<BodyMesh>(mesh).edges[2].size(), static_cast<std::size_t>(count));
      EXPECT_EQ(std::get<BodyMesh>(mesh).edges[0].size(), static_cast<std::size_t>(100 * count));
    }
}

}  // namespace
}  // namespace scabo::mesh
