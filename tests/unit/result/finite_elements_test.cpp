// Finite elements from the model file to the results: loads inside in closed form, recovered stress, contact, modes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scabo/analysis/modal/modal_analysis.hpp"
#include "scabo/input/read_model.hpp"
#include "scabo/result/point_tables.hpp"
#include "scabo/result/probe.hpp"
#include "scabo/result/recovery.hpp"
#include "unit/mesh/cell_meshes.hpp"
#include "unit/result/solutions.hpp"

namespace scabo::result {
namespace {

using namespace test;

model::Model parsed(const std::string& text) { return input::parse_model(text, "test.yaml", {}); }

/// A bar from (1, 2) to (5, 3) of thickness 0.5 in finite elements of 0.5: E = 200, nu as given, expansion 1e-3.
analysis::StaticSolution bar(int order, double nu, const std::string& plane, const std::string& supports,
                             const std::string& load) {
  return analysis::solve_static(parsed(fmt::format(R"(
scabo: 1
analysis: {{thickness: 0.5, plane: {}}}
materials: {{stuff: {{young: 200, poisson: {}, density: 3, expansion: 1e-3}}}}
bodies:
  bar: {{material: stuff, shape: {{rectangle: {{corner: [1, 2], size: [4, 1]}}}},
        mesh: {{kind: fem, size: 0.5, order: {}}}}}
supports: {}
loads: {{load: {}}}
)",
                                                   plane, nu, order, supports, load)));
}

constexpr const char* determinate = "[{on: bar.bottom_left, fix: [x, y]}, {on: bar.bottom_right, fix: [y]}]";
constexpr const char* both_ends =
    "[{on: bar.left, fix: [x]}, {on: bar.right, fix: [x]}, {on: bar.bottom_left, fix: [y]}]";

const analysis::IncrementResult& solved(const analysis::StaticSolution& solution) {
  if (solution.outcome != analysis::Outcome::solved) throw std::runtime_error(solution.reason);
  return solution.increments.back();
}

const std::vector<Vec2> places = {{1.0, 2.0}, {1.3, 2.1}, {3.0, 2.5}, {4.4, 2.95}, {5.0, 3.0}};

std::vector<PointResult> at_places(const analysis::StaticSolution& solution) {
  std::vector<mesh::OutputPoint> points;
  for (const Vec2& x : places) points.push_back({"p", 0, x, 0.0});
  const analysis::IncrementResult& increment =
      solved(solution);  // first: without one there are no elements to evaluate
  return PointEvaluation(solution, points, 1).at(solution, increment);
}

Fields fields_of(const analysis::StaticSolution& solution) {
  const analysis::IncrementResult& increment = solved(solution);
  return Recovery(solution).fields(solution, increment.fields);
}

double largest_stress(const analysis::StaticSolution& solution) {
  const Fields fields = fields_of(solution);
  double most = 0.0;
  for (const float value : fields.von_mises) most = std::max(most, std::abs(static_cast<double>(value)));
  return most;
}

class BarOfOrder : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(FiniteElements, BarOfOrder, testing::Values(1, 2));

TEST_P(BarOfOrder, ExpandsFreelyWithoutStress) {
  const auto solution = bar(GetParam(), 0.3, "stress", determinate, "{on: bar, temperature: 20}");
  const auto values = at_places(solution);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_LT((values[i].values.displacement - 0.02 * (places[i] - Vec2(1, 2))).norm(), 1e-13);
    EXPECT_LT(values[i].values.stress.norm(), 1e-11);
    EXPECT_LT(std::abs(values[i].energy_density), 1e-13);
  }
  EXPECT_LT(largest_stress(solution), 1e-11);
}

// In plane strain (1 + nu) alpha T in the plane, and -E alpha T across it.
TEST_P(BarOfOrder, ExpandsInPlaneStrain) {
  const auto solution = bar(GetParam(), 0.3, "strain", determinate, "{temperature: 20}");
  for (const PointResult& value : at_places(solution)) {
    EXPECT_NEAR(value.values.strain[0], 1.3 * 0.02, 1e-13);
    EXPECT_LT(value.values.stress.norm(), 1e-11);
    EXPECT_NEAR(value.stress_zz, -200 * 0.02, 1e-11);
  }
  const Fields fields = fields_of(solution);
  for (const float zz : fields.stress_zz) EXPECT_NEAR(zz, -4.0, 1e-6);
}

TEST_P(BarOfOrder, BetweenTwoWallsIsCompressed) {
  const auto solution = bar(GetParam(), 0.3, "stress", both_ends, "{on: bar, temperature: 20}");
  for (const PointResult& value : at_places(solution)) {
    EXPECT_LT((value.values.stress - element::Vec3(-4.0, 0, 0)).norm(), 1e-11);
    EXPECT_NEAR(value.energy_density, 0.5 * 4.0 * 4.0 / 200, 1e-12);
  }
  EXPECT_NEAR(solved(solution).reactions[0].x(), 4.0 * 0.5, 1e-11);
  EXPECT_NEAR(solved(solution).reactions[1].x(), -4.0 * 0.5, 1e-11);
}

// Warmer above than below, the free bar becomes an arc of curvature alpha dT/dy: exact in quadratic elements.
TEST(FiniteElements, BendFreelyUnderALinearTemperature) {
  const auto solution = bar(2, 0.3, "stress", determinate, "{on: bar, temperature: {constant: -4, y: 2}}");
  const auto values = at_places(solution);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_LT(values[i].values.stress.norm(), 1e-11);
    const double strain = 1e-3 * (-4 + 2 * places[i].y());
    EXPECT_NEAR(values[i].values.strain[0], strain, 1e-13);
    EXPECT_NEAR(values[i].values.strain[1], strain, 1e-13);
  }
  // Between its supports the lower edge, which keeps its length, rises by curvature s (L - s) / 2 in their middle.
  EXPECT_NEAR(values[2].values.displacement.y() - 1e-3 * 0.25, 0.5 * 2e-3 * 2 * 2, 1e-12);
  EXPECT_LT(largest_stress(solution), 1e-11);
}

// b = b1 x along x on a bar held at x = 1, free at x = 5, nu = 0: the nodes of one-dimensional elements at the ends of
// elements are exact, E u = b1 (25 (x - 1) / 2 - (x^3 - 1) / 6).
TEST_P(BarOfOrder, IsPulledByABodyForceThatGrowsAlongIt) {
  const auto solution =
      bar(GetParam(), 0.0, "stress", "[{on: bar.left, fix: [x, y]}]", "{on: bar, body_force: {x: [6, 0]}}");
  const analysis::IncrementResult& increment = solved(solution);
  EXPECT_NEAR(increment.reactions[0].x(), -0.5 * 6 * (25 - 1) / 2, 1e-11);  // on an area of 4 x 1
  for (const double x : {1.5, 2.0, 3.0, 5.0}) {
    const auto value = value_at(solution, increment.fields, 0, {x, 2.5});
    ASSERT_TRUE(value);
    EXPECT_NEAR(value->displacement.x(), 6.0 / 200 * (12.5 * (x - 1) - (x * x * x - 1) / 6), 1e-12);
  }
}

TEST_P(BarOfOrder, WeightAndConstantBodyForceAreTheSame) {
  const char* held = "[{on: bar.left, fix: [x, y]}]";
  const auto weight = bar(GetParam(), 0.3, "stress", held, "{gravity: [2, -10]}"),
             force = bar(GetParam(), 0.3, "stress", held, "{on: bar, body_force: [6, -30]}");
  EXPECT_NEAR(solved(weight).reactions[0].y(), 3 * 10 * 4 * 0.5, 1e-10);
  EXPECT_LT((solved(weight).fields.displacements[0] - solved(force).fields.displacements[0]).norm(),
            1e-14 * solved(weight).fields.displacements[0].norm());
}

// Two blocks of elements of either order: the same pressure at every pair, and the force of the load.
TEST_P(BarOfOrder, CarriesAUniformPressureThroughAContact) {
  const auto solution = analysis::solve_static(parsed(fmt::format(R"(
scabo: 1
materials: {{m: {{young: 200, poisson: 0.3}}}}
bodies:
  lower: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{kind: fem, size: 0.25, order: {0}}}}}
  upper: {{material: m, shape: {{rectangle: {{corner: [0, 1], size: [2, 1]}}}}, mesh: {{kind: fem, size: 0.25, order: {0}}}}}
supports:
  - {{on: lower.bottom, fix: [y]}}
  - {{on: lower.bottom_left, fix: [x]}}
  - {{on: upper.top_left, fix: [x]}}
loads: {{press: {{on: upper.top, pressure: 3}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.3}}}}
)",
                                                                  GetParam())));
  const auto& pairs = solved(solution).contacts[0].pairs;
  EXPECT_EQ(pairs.size(), GetParam() == 1 ? 9U : 17U);
  for (const auto& pair : pairs) EXPECT_NEAR(pair.pressure, 3.0, 1e-9);
  EXPECT_NEAR(solved(solution).contacts[0].normal_force, 6.0, 1e-9);
}

TEST_P(BarOfOrder, HasThreeRigidModesAndItsMass) {
  const auto result = analysis::solve_modal(parsed(fmt::format(R"(
scabo: 1
analysis: {{type: modal, modes: 4, thickness: 0.5}}
materials: {{stuff: {{young: 200, poisson: 0.3, density: 3}}}}
bodies:
  bar: {{material: stuff, shape: {{rectangle: {{corner: [1, 2], size: [4, 1]}}}}, mesh: {{kind: fem, size: 0.5, order: {}}}}}
)",
                                                               GetParam())));
  EXPECT_NEAR(result.total_mass, 3 * 4 * 0.5, 1e-12);
  ASSERT_EQ(result.modes.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(result.modes[k].rigid, k < 3);
}

// A body whose cells are of all kinds, made by hand.
struct Strip {
  const char* name;
  int order;
  bool triangles;
  std::uint8_t vtk;
};
class EveryStrip : public testing::TestWithParam<Strip> {
 protected:
  /// A distorted strip of 3 x 2 cells; those on the right of another material.
  static analysis::StaticSolution solution() {
    model::Model model = model_of({elastic("body", rectangle({0, 0}, {3, 2}), 1.0)}, model::Plane::stress);
    model.materials[0].expansion = {1e-3, 1e-3, 1e-3};
    model.materials.push_back(model.materials[0]);
    model.materials[1].young = 3 * young;
    model.materials[1].expansion = {2e-3, 2e-3, 2e-3};
    analysis::StaticSolution made;
    made.mesh.bodies = {mapped_grid(3, 2, GetParam().order, GetParam().triangles, [](const Vec2& x) {
      return Vec2(x.x() + 0.1 * x.y() * x.x(), x.y() * (1.0 + 0.05 * x.x()));
    })};
    for (mesh::Cell& cell : made.mesh.bodies[0].cells)
      if (cell.centre.x() > 2.0) cell.materials = {1};
    made.cells = {element::SolvedCells(made.mesh.bodies[0].cells.size())};
    made.model = std::move(model);
    return made;
  }
};
INSTANTIATE_TEST_SUITE_P(FiniteElements, EveryStrip,
                         testing::Values(Strip{"triangle3", 1, true, 5}, Strip{"triangle6", 2, true, 22},
                                         Strip{"quad4", 1, false, 9}, Strip{"quad8", 2, false, 23}),
                         [](const auto& info) { return std::string(info.param.name); });

const Mat2 strip_gradient = (Mat2() << 1.1e-3, -0.4e-3, 0.7e-3, -0.9e-3).finished();

// Where materials meet there is a point for each, with its own stress.
TEST_P(EveryStrip, LinearFieldAndTemperatureGiveTheStressOfEachMaterial) {
  const auto solution = this->solution();
  auto increment = increment_of(solution, linear_field(strip_gradient));
  increment.fields.interior[0].resize(solution.cells[0].size());
  for (auto& interior : increment.fields.interior[0]) interior.temperature = {0.5};
  const Recovery recovery(solution);
  const Fields fields = recovery.fields(solution, increment.fields);
  for (const std::uint8_t type : recovery.grid().types) EXPECT_EQ(type, GetParam().vtk);
  EXPECT_EQ(recovery.grid().cell_count(), GetParam().triangles ? 12U : 6U);
  EXPECT_EQ(recovery.grid().point_count(), solution.mesh.bodies[0].nodes.size() + (GetParam().order == 1 ? 3U : 5U));
  std::array<element::Vec3, 2> expected;
  for (std::size_t m = 0; m < 2; ++m) {
    const double alpha = m == 0 ? 1e-3 : 2e-3;
    expected[m] = (m == 0 ? 1.0 : 3.0) *
                  stress_of(strip_gradient - 0.5 * alpha * Mat2::Identity(), model::Plane::stress).in_plane;
  }
  std::array<int, 2> found{};
  for (std::size_t i = 0; i < recovery.grid().point_count(); ++i) {
    const std::size_t m = std::abs(fields.stress_xx[i] / expected[0][0] - 1.0) < 1e-6 ? 0 : 1;
    ++found[m];
    EXPECT_NEAR(fields.stress_xx[i], expected[m][0], 3e-7 * expected[m].norm());
    EXPECT_NEAR(fields.stress_yy[i], expected[m][1], 3e-7 * expected[m].norm());
    EXPECT_NEAR(fields.stress_xy[i], expected[m][2], 3e-7 * expected[m].norm());
  }
  EXPECT_EQ(found[1], GetParam().order == 1 ? 6 : GetParam().triangles ? 15 : 13);

  const Probe probe(solution, increment.fields, 0);
  for (const Vec2& x : {Vec2(0.7, 0.4), Vec2(1.9, 1.3), Vec2(3.2, 1.7)}) {
    const auto values = probe.at(x);
    ASSERT_TRUE(values);
    EXPECT_LT((values->displacement - linear_field(strip_gradient)(x)).norm(), 1e-15);
    const std::size_t m = x.x() > 3.0 ? 1 : 0;
    EXPECT_LT((values->stress - expected[m]).norm(), 1e-12 * expected[m].norm());
  }
  EXPECT_FALSE(probe.at({-0.1, 0.5}));
}

TEST_P(EveryStrip, APointSlightlyOutsideLiesOnTheNearestSide) {
  const auto solution = this->solution();
  const CellLocator locator(solution.mesh.bodies[0], solution.cells[0]);
  for (const Vec2& x : {Vec2(0.5, 0.0), Vec2(1.7, 0.0), Vec2(2.6, 0.0)}) {
    const CellPlace place = locator.nearest(x - Vec2(0, 1e-3));
    EXPECT_FALSE(locator.find(x - Vec2(0, 1e-3)));
    const auto element =
        element::finite_element_of(solution.mesh.bodies[0].cells[place.cell], solution.mesh.bodies[0].nodes);
    EXPECT_LT((element::position_in(element, place.natural) - x).norm(), 1e-12);
  }
  const CellPlace far = locator.nearest({9.0, 9.0});  // the corner
  const auto element =
      element::finite_element_of(solution.mesh.bodies[0].cells[far.cell], solution.mesh.bodies[0].nodes);
  EXPECT_LT((element::position_in(element, far.natural) - Vec2(3.6, 2.3)).norm(), 1e-12);
}

}  // namespace
}  // namespace scabo::result
