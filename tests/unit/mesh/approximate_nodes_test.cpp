// The estimate of how many nodes a division has, against divisions.
#include "scabo/mesh/plane/approximate_nodes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "models.hpp"
#include "scabo/mesh/plane/many_cells.hpp"

namespace scabo::mesh {
namespace {

using Kind = model::MeshKind;

model::Body body_of(model::Outline outline, Kind kind, double size, int order,
                    std::vector<model::LocalSize> refine = {}) {
  model::Body body = test::elastic("b", std::move(outline), size, order);
  body.mesh.kind = kind;
  body.mesh.refine = std::move(refine);
  return body;
}

model::LocalSize at(const Vec2& x, double size) { return {x, -1, size, {}}; }
model::LocalSize along(int edge, double size) { return {std::nullopt, edge, size, {}}; }

/// Rings of points with sizes around the re-entrant corner of an L, as one writes them to grade a mesh by hand.
std::vector<model::LocalSize> rings(double ratio, int count) {
  std::vector<model::LocalSize> sizes;
  double radius = 1.0;
  for (int k = 0; k < count; ++k, radius *= ratio)
    for (int i = 0; i < 12; ++i)
      sizes.push_back(at(test::polar({0, 0}, radius, -0.5 * test::pi + 1.5 * test::pi * i / 11), 0.125 * radius));
  sizes.push_back(at({0, 0}, 0.125 * radius));
  return sizes;
}

const model::Outline ell =
    test::polygon({{0, 0}, {0, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0}}, {"a", "b", "c", "d", "e", "f"});
const model::Outline square = test::rectangle({0, 0}, {1, 1});
const model::Outline beam = test::rectangle({0, 0}, {10, 0.3});

TEST(ApproximateNodes, AreThoseOfTheDivisionWithinAFactorOfThree) {
  const std::vector<model::LocalSize> corner{at({0, 0}, 1e-4)},
      twice{at({0, 0}, 1e-4), at({0, 0}, 1e-4), at({0, 0}, 1.1e-4)}, edge{along(0, 5e-3)},
      both{along(0, 5e-3), at({1, 1}, 1e-3), along(1, 5e-3)};
  for (const Kind kind : {Kind::polygons, Kind::quadtree, Kind::fem})
    for (const int order : {1, 2, 4}) {
      if (kind == Kind::fem && order > 2) continue;
      for (const model::Body& body :
           {body_of(square, kind, 0.03, order), body_of(square, kind, 0.1, order, corner),
            body_of(square, kind, 0.1, order, twice), body_of(square, kind, 0.1, order, edge),
            body_of(square, kind, 0.1, order, both), body_of(beam, kind, 0.1, order),
            body_of(beam, kind, 0.3, order, {at({5, 0.3}, 1e-3)}), body_of(ell, kind, 0.125, order, rings(0.6, 4)),
            body_of(ell, kind, 0.125, order, rings(0.6, 20))}) {
        const auto made = divide_into_cells(body, {}, 1e9);
        ASSERT_TRUE(std::holds_alternative<BodyMesh>(made)) << std::get<Diagnostic>(made).message;
        const double ratio = approximate_nodes(body) / static_cast<double>(std::get<BodyMesh>(made).nodes.size());
        const std::string which =
            fmt::format("kind {}, order {}, {} edges, size {}, {} places", static_cast<int>(kind), order,
                        body.outline.edges.size(), body.mesh.size, body.mesh.refine.size());
        RecordProperty(which, fmt::format("{:.2f}", ratio));
        EXPECT_GT(ratio, 1.0 / 3.0) << which;
        EXPECT_LT(ratio, 3.0) << which;
      }
    }
}

TEST(ApproximateNodes, OfSizesFarTooSmall) {
  // Hexagons of an area of size^2: two corners and three sides for each, and a node inside each side.
  EXPECT_NEAR(approximate_nodes(body_of(test::rectangle({0, 0}, {2, 1}), Kind::polygons, 1e-5, 2)), 1e11, 1e6);
  // Beside an edge of length 1, the integral of dx / (s + 0.3 x)^2 = 1 / (0.3 s).
  EXPECT_GT(approximate_nodes(body_of(square, Kind::polygons, 0.1, 1, {along(0, 1e-9)})), 3e9);
  EXPECT_LT(approximate_nodes(body_of(square, Kind::polygons, 0.1, 2, {at({0.5, 0.5}, 1e-12)})), 1e5);
}

}  // namespace
}  // namespace scabo::mesh
