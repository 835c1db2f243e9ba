// Body forces and temperatures that grow along x or y alone, each coefficient by itself, against closed forms.
#include <fmt/format.h>

#include "run.hpp"
#include "scabo/result/point_tables.hpp"

namespace scabo::verification {
namespace {

/// A plate from (1, 0.5) to (3, 1.5) of thickness 0.25, E = 10, expansion 1e-3, held as `supports` say.
std::string linear_load_plate(double poisson, const std::string& supports, const std::string& load, int order = 3) {
  return fmt::format(R"(
scabo: 1
analysis: {{thickness: 0.25}}
materials: {{stuff: {{young: 10, poisson: {}, expansion: 1e-3}}}}
bodies:
  plate: {{material: stuff, shape: {{rectangle: {{corner: [1, 0.5], size: [2, 1]}}}}, mesh: {{size: 1, order: {}}}}}
supports: {}
loads: {{load: {{on: plate, {}}}}}
)",
                     poisson, order, supports, load);
}

std::vector<result::PointResult> at_points(const analysis::StaticSolution& solution, const std::vector<Vec2>& places) {
  std::vector<mesh::OutputPoint> points;
  for (const Vec2& x : places) points.push_back({"p", 0, x, 0.0});
  return result::PointEvaluation(solution, points, 1).at(solution, last(solution));
}

// Integrals over 1 < x < 3, 0.5 < y < 1.5: of 1 it is 2, of x 4, of y 2.
TEST(LinearBodyForce, EveryCoefficientAloneIsCarriedByTheSupports) {
  const struct {
    const char* load;
    Vec2 total;
  } cases[] = {{"body_force: {constant: [3, 0]}", {6.0, 0.0}}, {"body_force: {constant: [0, 3]}", {0.0, 6.0}},
               {"body_force: {x: [3, 0]}", {12.0, 0.0}},       {"body_force: {x: [0, 3]}", {0.0, 12.0}},
               {"body_force: {y: [3, 0]}", {6.0, 0.0}},        {"body_force: {y: [0, 3]}", {0.0, 6.0}}};
  for (const auto& [load, total] : cases) {
    const auto solution = run(linear_load_plate(0.3, "[{on: plate.left, fix: [x, y]}]", load));
    const Vec2 reaction = last(solution).reactions.front();
    EXPECT_NEAR(reaction.x(), -0.25 * total.x(), 1e-11) << load;
    EXPECT_NEAR(reaction.y(), -0.25 * total.y(), 1e-11) << load;
  }
}

// Standing or hanging by an edge, without Poisson's ratio: s' = -b z, s = b (z1^2 - z^2) / 2 with s = 0 at the free end
// z1, u = int s / E. A cubic, exact with elements of order 3.
TEST(LinearBodyForce, GrowingAlongABarIsExactInside) {
  const double b = 3.0, E = 10.0;
  const auto stress = [&](double z, double end) { return 0.5 * b * (end * end - z * z); };
  const auto displacement = [&](double z, double from, double end) {
    return 0.5 * b / E * (end * end * (z - from) - (z * z * z - from * from * from) / 3.0);
  };
  const std::vector<Vec2> places = {{1.3, 0.6}, {1.9, 1.1}, {2.7, 1.4}};
  const auto upright = run(linear_load_plate(0.0, "[{on: plate.bottom, fix: [x, y]}]", "body_force: {y: [0, 3]}"));
  const auto lying = run(linear_load_plate(0.0, "[{on: plate.left, fix: [x, y]}]", "body_force: {x: [3, 0]}"));
  const auto up = at_points(upright, places), along = at_points(lying, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec2& x = places[i];
    EXPECT_NEAR(up[i].values.displacement.y(), displacement(x.y(), 0.5, 1.5), 1e-12) << i;
    EXPECT_NEAR(up[i].values.stress[1], stress(x.y(), 1.5), 1e-11) << i;
    EXPECT_NEAR(along[i].values.displacement.x(), displacement(x.x(), 1.0, 3.0), 1e-12) << i;
    EXPECT_NEAR(along[i].values.stress[0], stress(x.x(), 3.0), 1e-11) << i;
  }
}

// Temperature that is linear in x and y stresses no plate that is free to bend. About the corner (1, 0.5), where the
// plate is held, with T = g X or g Y of X = x - 1, Y = y - 0.5 and what it is at the corner:
//
//     g X: u = a g [(X^2 - Y^2) / 2, X Y],    g Y: u = a g [X Y, (Y^2 - X^2) / 2] + rotation
TEST(LinearTemperature, EveryCoefficientAloneBendsAFreePlateWithoutStress) {
  const double a = 1e-3, g = 40.0;
  const std::string supports = "[{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: y}]";
  const std::vector<Vec2> places = {{1.4, 0.7}, {2.1, 1.1}, {2.9, 1.3}};
  const struct {
    const char* load;
    double constant, per_x, per_y;
  } cases[] = {{"temperature: {constant: 40}", g, 0.0, 0.0},
               {"temperature: {x: 40}", 0.0, g, 0.0},
               {"temperature: {y: 40}", 0.0, 0.0, g}};
  for (const auto& [load, constant, per_x, per_y] : cases) {
    const auto solution = run(linear_load_plate(0.3, supports, load, 2));
    const auto found = at_points(solution, places);
    const double at_corner = constant + per_x * 1.0 + per_y * 0.5,
                 rotation = a * per_y * 2.0 / 2.0;  // brings (3, 0.5) back to its support
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double X = places[i].x() - 1.0, Y = places[i].y() - 0.5;
      const Vec2 u = a * at_corner * Vec2(X, Y) + a * per_x * Vec2(0.5 * (X * X - Y * Y), X * Y) +
                     a * per_y * Vec2(X * Y, 0.5 * (Y * Y - X * X)) + rotation * Vec2(-Y, X);
      EXPECT_LT((found[i].values.displacement - u).norm(), 1e-12) << load << " at point " << i;
      EXPECT_LT(found[i].values.stress.norm(), 1e-10) << load << " at point " << i;  // of E a g = 0.4
    }
  }
}

}  // namespace
}  // namespace scabo::verification
