// The mesh of a contact does not depend on the order in which the bodies are given, nor on the unit or the angle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "scabo/input/read_model.hpp"
#include "scabo/mesh/mesh.hpp"
#include "support/random.hpp"

namespace scabo::mesh {
namespace {

struct Layout {
  std::array<double, 4> sizes;
  std::array<int, 4> orders;
  std::array<const char*, 4> kinds{"superelement", "superelement", "superelement", "superelement"};
  std::array<std::size_t, 4> listing{0, 1, 2, 3};
  double unit = 1.0, angle = 0.0;
};

/// Four quadrilaterals between three joints that do not end in the same points: one edge has two contacts on each side.
model::Model model_of(const Layout& layout) {
  const Vec2 p(-0.25, -0.6), q(0.15, 0.6), c = p + 0.43 * (q - p), d = p + 0.5 * (q - p);
  const std::array<std::vector<Vec2>, 4> shapes{{{p, {1.0, -0.6}, {1.0, 0.0}, c},
                                                 {c, {1.0, 0.0}, {1.0, 0.6}, q},
                                                 {{-1.0, -0.6}, p, d, {-1.0, 0.05}},
                                                 {d, q, {-1.0, 0.6}, {-1.0, 0.05}}}};
  std::string text = "scabo: 1\nmaterials: {m: {young: 1e9, poisson: 0.3}}\nbodies:\n";
  for (const std::size_t b : layout.listing) {
    std::string vertices;
    for (const Vec2& x : shapes[b])
      vertices += fmt::format("[{:.17g}, {:.17g}], ",
                              layout.unit * (std::cos(layout.angle) * x.x() - std::sin(layout.angle) * x.y()),
                              layout.unit * (std::sin(layout.angle) * x.x() + std::cos(layout.angle) * x.y()));
    text += fmt::format(
        "  b{}: {{material: m, shape: {{polygon: {{vertices: [{}]}}}}, mesh: {{kind: {}, size: {:.17g}, order: "
        "{}}}}}\n",
        b, vertices, layout.kinds[b], layout.sizes[b] * layout.unit, layout.orders[b]);
  }
  return input::parse_model(text +
                                "supports: [{on: b3.edge_3, fix: [x, y]}, {on: b1.edge_2, fix: [x, y]}]\n"
                                "loads: {p: {on: b0.edge_1, pressure: 1}}\ncontacts: {all: {between: all}}\n",
                            "test.yaml");
}

/// For every contact, by the names of its two edges, the positions of its pairs, turned back and in the first unit.
std::map<std::array<std::string, 2>, std::vector<Vec2>> pairs_of(const Layout& layout) {
  const model::Model model = model_of(layout);
  const Mesh mesh = make_mesh(model);
  std::map<std::array<std::string, 2>, std::vector<Vec2>> all;
  for (const Interface& interface : mesh.interfaces) {
    const model::Contact& contact = model.contacts[static_cast<std::size_t>(interface.contact)];
    std::array<std::string, 2> key{contact.a.text, contact.b.text};
    std::sort(key.begin(), key.end());
    for (const ContactPair& pair : interface.pairs) {
      const Vec2 x = 0.5 / layout.unit * (pair.point_a + pair.point_b);
      const double cosine = std::cos(layout.angle), sine = std::sin(layout.angle);
      all[key].push_back(Vec2(cosine * x.x() + sine * x.y(), cosine * x.y() - sine * x.x()));
    }
    std::sort(all[key].begin(), all[key].end(), [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
  }
  return all;
}

void expect_same(const Layout& one, const Layout& other) {
  const auto expected = pairs_of(one), found = pairs_of(other);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [key, points] : expected) {
    ASSERT_TRUE(found.contains(key)) << key[0] << ' ' << key[1];
    const std::vector<Vec2>& of_other = found.at(key);
    ASSERT_EQ(of_other.size(), points.size()) << key[0] << ' ' << key[1];
    for (std::size_t k = 0; k < points.size(); ++k) EXPECT_LT((of_other[k] - points[k]).norm(), 1e-12) << k;
  }
}

// Before, the contact of b1 and b3 had 21 or 25 pairs: whether two break points were joined depended on whether the
// element beside them had been divided for another contact by then.
TEST(ListingOrder, OfBodiesChangesNoPair) {
  std::vector<Layout> layouts{{{0.1, 0.35, 0.2, 0.2}, {1, 4, 1, 2}}};
  std::mt19937 random(41);
  for (int k = 0; k < 30; ++k) {
    Layout layout{};
    for (std::size_t b = 0; b < 4; ++b) {
      layout.sizes[b] = test::uniform(random, 0.07, 0.4);
      layout.orders[b] = test::whole(random, 1, 4);
      if (k % 3 == 2) layout.kinds[b] = b % 2 == 0 ? "polygons" : "quadtree";
    }
    layouts.push_back(layout);
  }
  for (const Layout& layout : layouts) {
    SCOPED_TRACE(fmt::format("sizes {} {} {} {}, orders {} {} {} {}", layout.sizes[0], layout.sizes[1], layout.sizes[2],
                             layout.sizes[3], layout.orders[0], layout.orders[1], layout.orders[2], layout.orders[3]));
    Layout twin = layout;
    for (const std::array<std::size_t, 4>& listing :
         {std::array<std::size_t, 4>{0, 3, 2, 1}, {3, 2, 1, 0}, {1, 0, 3, 2}, {2, 0, 1, 3}}) {
      twin.listing = listing;
      expect_same(layout, twin);
    }
  }
}

/// Two rollers of one size, divided otherwise, whose sides face the same edge of the floor: 95 and 82 pairs, or 99
/// and 81.
TEST(ListingOrder, OfContactsChangesNoPair) {
  const std::string bodies = R"(
scabo: 1
materials: {m: {young: 1e9, poisson: 0.3}}
bodies:
  floor:
    material: m
    shape: {rectangle: {corner: [-1, -0.4], size: [3.78, 0.4]}}
    mesh: {size: 0.54, order: 3, refine: [{near: [0, 0], size: 0.041}, {near: [1.14, 0], size: 0.041}]}
  d1:
    material: m
    shape: {outline: [{line: {to: [-0.3, 0.7]}}, {arc: {to: [0.3, 0.7], centre: [0, 0.4]}, name: below}]}
    mesh: {size: 0.14, order: 4, refine: [{near: [0, 0], size: 0.041}]}
  d2:
    material: m
    shape: {outline: [{line: {to: [0.84, 0.7]}}, {arc: {to: [1.44, 0.7], centre: [1.14, 0.4]}, name: below}]}
    mesh: {size: 0.072, order: 2, refine: [{near: [1.14, 0], size: 0.025}]}
supports: [{on: floor.bottom, fix: [x, y]}]
loads: {p: {on: floor.left, pressure: 1}}
contacts:
)";
  const std::string first = "  c1: {between: [floor.top, d1.below], gap: -0.01, fit_in: step_1}\n",
                    second = "  c2: {between: [floor.top, d2.below], gap: -0.01, fit_in: step_1}\n";
  std::vector<std::map<std::string, std::size_t>> pairs;
  for (const std::string& contacts : {first + second, second + first}) {
    const model::Model model = input::parse_model(bodies + contacts, "test.yaml");
    for (const Interface& interface : make_mesh(model).interfaces) {
      if (pairs.empty() || pairs.back().size() == 2) pairs.emplace_back();
      pairs.back()[model.contacts[static_cast<std::size_t>(interface.contact)].name] = interface.pairs.size();
    }
  }
  EXPECT_EQ(pairs[0], pairs[1]);
}

TEST(ListingOrder, UnitsAndAnglesChangeNoPair) {
  const Layout layout{{0.1, 0.35, 0.2, 0.2}, {1, 4, 1, 2}};
  for (const double unit : {1e3, 1e-3})
    for (const double angle : {0.0, 0.7, 2.5}) {
      Layout twin = layout;
      twin.unit = unit;
      twin.angle = angle;
      expect_same(layout, twin);
    }
}

}  // namespace
}  // namespace scabo::mesh
