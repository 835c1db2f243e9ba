// Lengths by hand: Gauss-Lobatto's weights times half the length of an element.
#include "scabo/system/tributary_lengths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "unit/mesh/models.hpp"

namespace scabo::system {
namespace {

std::vector<double> lengths_of(const model::Model& model) {
  return tributary_lengths(0, model, mesh::make_mesh(model));
}

void expect_lengths(const std::vector<double>& lengths, const std::vector<double>& expected) {
  ASSERT_EQ(lengths.size(), expected.size());
  for (std::size_t i = 0; i < lengths.size(); ++i) EXPECT_NEAR(lengths[i], expected[i], 1e-14) << i;
}

TEST(TributaryLengths, OfStraightQuadraticElementsAreSixths) {
  const auto model = test::pair_of(test::elastic("lower", test::rectangle({0, 0}, {2, 1}), 1.0, 2), "top",
                                   test::elastic("upper", test::rectangle({0, 1}, {2, 1}), 1.0, 2), "bottom");
  expect_lengths(lengths_of(model), {1. / 6, 4. / 6, 2. / 6, 4. / 6, 1. / 6});
}

// The floor goes on to both sides: its elements beside the block carry nothing. Either way round.
TEST(TributaryLengths, CountOnlyElementsThatTakePart) {
  const auto floor = test::elastic("floor", test::rectangle({-1, 0}, {3, 1}), 1.0, 2),
             block = test::elastic("block", test::rectangle({0, 1}, {1, 1}), 1.0, 2);
  expect_lengths(lengths_of(test::pair_of(floor, "top", block, "bottom")), {1. / 6, 4. / 6, 1. / 6});
  expect_lengths(lengths_of(test::pair_of(block, "bottom", floor, "top")), {1. / 6, 4. / 6, 1. / 6});
}

// Two elements of order 1 have the nodes of one of order 2: both sides get elements of half the length and order 2.
TEST(TributaryLengths, OfOtherOrdersAreThoseOfTheElementsMadeAlike) {
  const auto lower = test::elastic("lower", test::rectangle({0, 0}, {2, 1}), 1.0, 2),
             upper = test::elastic("upper", test::rectangle({0, 1}, {2, 1}), 0.5, 1);
  std::vector<double> expected;
  for (const double sixths : {1., 4., 2., 4., 2., 4., 2., 4., 1.}) expected.push_back(0.5 * sixths / 6);
  expect_lengths(lengths_of(test::pair_of(lower, "top", upper, "bottom")), expected);
  expect_lengths(lengths_of(test::pair_of(upper, "bottom", lower, "top")), expected);
}

// A quarter of a cylinder in a bore whose radius is larger by the gap: elements of both turn by the same angle, so that
// all lengths are those on the circle between. Parabolas through three points of it, by hand.
TEST(TributaryLengths, AreTheMeanOfBothSides) {
  const auto quarter = [](const char* name, double inner, double outer) {
    model::Body body = test::elastic(
        name,
        test::outline({test::line("base", {inner, 0}, {outer, 0}), test::arc("outer", {0, 0}, outer, 0.0, test::pi / 2),
                       test::line("side", {0, outer}, {0, inner}),
                       test::arc("inner", {0, 0}, inner, test::pi / 2, -test::pi / 2)}),
        0.5, 2);
    body.mesh.kind = model::MeshKind::polygons;
    return body;
  };
  const auto cylinder = quarter("cylinder", 0.5, 1.0), sleeve = quarter("sleeve", 1.2, 1.7);
  const std::vector<double> lengths = lengths_of(test::pair_of(cylinder, "outer", sleeve, "inner"));
  ASSERT_GE(lengths.size(), 5u);
  const double elements = 0.5 * (static_cast<double>(lengths.size()) - 1), turn = test::pi / 2 / elements, r = 1.1,
               along = 2 * std::sin(turn / 2) - std::sin(turn) / 2,
               across = 2 * (1 - std::cos(turn / 2)) - (1 - std::cos(turn)) / 2;
  std::vector<double> expected(lengths.size(), 4 * r / 3 * std::sin(turn / 2));
  for (std::size_t i = 2; i + 1 < lengths.size(); i += 2) expected[i] = 2 * r / 3 * along;
  expected.front() = expected.back() = r / 3 * std::hypot(along, across);
  expect_lengths(lengths, expected);
  expect_lengths(lengths_of(test::pair_of(sleeve, "inner", cylinder, "outer")), expected);
}

// On an arc they add up to its length as elements shrink. The other side is rigid and has none.
TEST(TributaryLengths, OfAnArcAddUpToItsLength) {
  const auto sum_for = [](double size) {
    const auto disc = test::elastic("disc",
                                    test::outline({test::arc("lower", {0, 2}, 2.0, -test::pi, test::pi),
                                                   test::arc("upper", {0, 2}, 2.0, 0.0, test::pi)}),
                                    size, 2);
    const auto cup = test::rigid(
        "cup", test::outline({test::line("bottom", {-3, -1}, {3, -1}), test::line("right", {3, -1}, {3, 2}),
                              test::line("rim_right", {3, 2}, {2, 2}), test::arc("bore", {0, 2}, 2.0, 0.0, -test::pi),
                              test::line("rim_left", {-2, 2}, {-3, 2}), test::line("left", {-3, 2}, {-3, -1})}));
    const auto lengths = lengths_of(test::pair_of(cup, "bore", disc, "lower"));
    return std::accumulate(lengths.begin(), lengths.end(), 0.0);
  };
  EXPECT_NEAR(sum_for(0.4), 2.0 * test::pi, 1e-3);
  EXPECT_NEAR(sum_for(0.1), 2.0 * test::pi, 1e-5);
}

}  // namespace
}  // namespace scabo::system
