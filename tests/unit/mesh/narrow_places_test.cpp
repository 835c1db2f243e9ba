// Cells in narrow places, at crack tips that are close to each other, and beside small holes.
#include "scabo/mesh/plane/narrow_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "models.hpp"
#include "scabo/mesh/plane/crack_net.hpp"
#include "scabo/mesh/plane/line_net.hpp"
#include "scabo/mesh/plane/many_cells.hpp"

namespace scabo::mesh {
namespace {

model::Body body_of(model::Outline outline, model::MeshKind kind, double size) {
  model::Body body = test::elastic("b", std::move(outline), size);
  body.mesh.kind = kind;
  return body;
}

void add_hole(model::Outline& outline, const Vec2& centre, double radius) {
  const int first = static_cast<int>(outline.edges.size());
  outline.holes.push_back(first);
  for (const double from : {0.0, -test::pi}) {
    outline.edges.push_back(test::arc("hole", centre, radius, from, -test::pi));
    outline.corners.push_back({{"hole_corner"}, outline.edges.back().start});
  }
  outline.edges.back().start = outline.edges[outline.edges.size() - 2].end;
  outline.edges.back().end = outline.edges[static_cast<std::size_t>(first)].start;
}

/// Area of the polygons of the sides' end nodes.
double meshed_area(const BodyMesh& mesh) {
  double area = 0.0;
  for (const Cell& cell : mesh.cells)
    for (const LineElement& element : cell.boundary)
      for (std::size_t k = 0; k + 1 < element.nodes.size(); ++k)
        area += 0.5 * cross(mesh.nodes[static_cast<std::size_t>(element.nodes[k])] - cell.centre,
                            mesh.nodes[static_cast<std::size_t>(element.nodes[k + 1])] - cell.centre);
  return area;
}

const BodyMesh* mesh_in(const std::variant<BodyMesh, Diagnostic>& made) {
  if (const Diagnostic* wrong = std::get_if<Diagnostic>(&made)) ADD_FAILURE() << wrong->message;
  return std::get_if<BodyMesh>(&made);
}

using Kind = model::MeshKind;

TEST(NarrowPlaces, AThinRingIsDividedAlongItsLength) {
  const double inner = 0.999;
  for (const Kind kind : {Kind::polygons, Kind::fem, Kind::quadtree, Kind::parts}) {
    const model::Body ring =
        body_of(test::outline({test::arc("top", {0, 0}, 1.0, 0.0, test::pi), test::line("left", {-1, 0}, {-inner, 0}),
                               test::arc("bottom", {0, 0}, inner, test::pi, -test::pi),
                               test::line("right", {inner, 0}, {1, 0})}),
                kind, 0.2);
    const auto made = divide_into_cells(ring, {}, 1e6);
    const BodyMesh* mesh = mesh_in(made);
    if (mesh == nullptr) continue;
    const double exact = 0.5 * test::pi * (1.0 - inner * inner);
    EXPECT_NEAR(meshed_area(*mesh), exact, 1e-3 * exact);
  }
}

TEST(NarrowPlaces, AHoleThatNearlyTouchesTheOutline) {
  for (const double gap : {1e-2, 1e-4, 1e-6})
    for (const Kind kind : {Kind::polygons, Kind::fem, Kind::quadtree}) {
      model::Outline outline = test::rectangle({0, 0}, {2, 1});
      add_hole(outline, {1, 0.5}, 0.5 - gap);
      const auto made = divide_into_cells(body_of(outline, kind, 0.2), {}, 1e6);
      const BodyMesh* mesh = mesh_in(made);
      if (mesh == nullptr) continue;
      EXPECT_NEAR(meshed_area(*mesh), 2.0 - test::pi * std::pow(0.5 - gap, 2), 2e-3);
      EXPECT_LT(mesh->nodes.size(), 50000u);  // small cells lie in the narrow places only
    }
}

TEST(NarrowPlaces, ATinyHole) {
  for (const Kind kind : {Kind::polygons, Kind::fem, Kind::quadtree}) {
    model::Outline outline = test::rectangle({0, 0}, {2, 1});
    add_hole(outline, {0.8, 0.5}, 1e-6);
    const auto made = divide_into_cells(body_of(outline, kind, 0.2), {}, 1e6);
    const BodyMesh* mesh = mesh_in(made);
    if (mesh == nullptr) continue;
    EXPECT_NEAR(meshed_area(*mesh), 2.0, 1e-9);
    EXPECT_GE(mesh->edges[4].size(), 4u);
    EXPECT_LT(mesh->nodes.size(), 20000u);
  }
}

TEST(NarrowPlaces, EveryCrackTipHasACellOfItsOwn) {
  for (const double gap : {0.25, 0.1, 1e-2, 1e-3, 1e-5})
    for (const Kind kind : {Kind::polygons, Kind::quadtree}) {
      model::Body body = body_of(test::rectangle({0, 0}, {2, 1}), kind, 0.2);
      body.cracks.resize(3);
      body.cracks[0].path = {{0.5, 0.5}, {0.9, 0.5}};
      body.cracks[1].path = {{0.9 + gap, 0.5}, {1.5, 0.5}};
      body.cracks[2].path = {{1.8, 0.7}, {1.8, 1.0 - gap}};  // towards the outline
      const auto made = divide_into_cells(body, {}, 1e6);
      const BodyMesh* mesh = mesh_in(made);
      if (mesh == nullptr) continue;
      EXPECT_EQ(std::count_if(mesh->cells.begin(), mesh->cells.end(), [](const Cell& cell) { return cell.is_open(); }),
                6);
      for (const Cell& cell : mesh->cells) {
        if (!cell.is_open()) continue;
        double radius = 0.0;
        for (const int node : cell.nodes())
          radius = std::max(radius, (mesh->nodes[static_cast<std::size_t>(node)] - cell.centre).norm());
        const double to_gap =
            std::min({(cell.centre - Vec2(0.9, 0.5)).norm(), (cell.centre - Vec2(0.9 + gap, 0.5)).norm(),
                      (cell.centre - Vec2(1.8, 1.0 - gap)).norm()});
        if (to_gap < 1e-9) EXPECT_LT(radius, gap);
      }
    }
}

TEST(NarrowPlaces, ATooNarrowBodyIsRefusedWithItsWidth) {
  const auto made = divide_into_cells(body_of(test::rectangle({3, 5}, {2, 1e-6}), Kind::polygons, 0.2), {}, 1e6);
  const Diagnostic* wrong = std::get_if<Diagnostic>(&made);
  ASSERT_NE(wrong, nullptr);
  EXPECT_NE(wrong->message.find("body 'b' is only 1e-06 wide near (3"), std::string::npos) << wrong->message;
}

// The faces of a slit have no material between them: however thin it is, they are not looked at piece by piece, and ask
// for no small cells. A strip of material that is as thin does.
TEST(NarrowPlaces, FacesOfASlitAreNotDividedFromEachOther) {
  const auto seen = [](double width, bool gaps) {
    const model::Body body = body_of(
        test::polygon({{0, 0}, {1, 0}, {1, 1}, {0.5 + width, 1}, {0.5 + width, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}},
                      {"bottom", "right", "top", "face", "end", "other_face", "other_top", "left"}),
        Kind::polygons, 0.1);
    int looks = 0;
    const CrackNet none(body);
    const NarrowPlaces places = narrow_places(line_net(body, none), {}, [&looks](const Vec2&) { return ++looks, 0.1; },
                                              0.1, {.gaps = gaps, .most = 1e4});
    return std::pair(looks, places.width);
  };
  for (const double width : {1e-2, 1e-4, 1e-7}) {
    EXPECT_LT(seen(width, false).first, 200) << width;
    EXPECT_EQ(seen(width, false).second, 0.0) << width;
    EXPECT_NEAR(seen(width, true).second, width, 1e-3 * width);
  }
  EXPECT_GT(seen(1e-7, true).first, 2000);
}

TEST(NarrowPlaces, AWideBodyIsDividedAsAsked) {
  const model::Body body = body_of(test::rectangle({0, 0}, {3, 1}), Kind::polygons, 0.25);
  const auto made = divide_into_cells(body, {}, 1e6);
  EXPECT_EQ(mesh_in(made)->edges[0].size(), 12u);
  EXPECT_EQ(mesh_in(made)->edges[1].size(), 4u);
}

}  // namespace
}  // namespace scabo::mesh
