#include "scabo/result/recovery.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/result/solutions.hpp"

namespace scabo::result {
namespace {

using namespace scabo::test;

const Mat2 gradient = (Mat2() << 1.1e-3, -0.4e-3, 0.7e-3, -0.9e-3).finished();

Vec2 point_of(const Grid& grid, std::size_t i) { return {grid.points[3 * i], grid.points[3 * i + 1]}; }

void expect_linear_field(const analysis::StaticSolution& solution, double tolerance) {
  const Recovery recovery(solution);
  const Grid& grid = recovery.grid();
  const Field field = linear_field(gradient);
  const Fields fields = recovery.fields(solution, increment_of(solution, field).fields);
  const UniformStress expected = stress_of(gradient, solution.model.analysis.plane);
  const double scale = expected.in_plane.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < grid.point_count(); ++i) {
    const Vec2 u(fields.displacement[3 * i], fields.displacement[3 * i + 1]);
    EXPECT_LT((u - field(point_of(grid, i))).norm(), 1e-12) << "point " << i;
    EXPECT_NEAR(fields.stress_xx[i], expected.in_plane[0], tolerance * scale) << "point " << i;
    EXPECT_NEAR(fields.stress_yy[i], expected.in_plane[1], tolerance * scale) << "point " << i;
    EXPECT_NEAR(fields.stress_xy[i], expected.in_plane[2], tolerance * scale) << "point " << i;
    EXPECT_NEAR(fields.stress_zz[i], expected.zz, tolerance * scale) << "point " << i;
    const float tensor[] = {fields.stress_xx[i], fields.stress_yy[i], fields.stress_zz[i], fields.stress_xy[i], 0, 0};
    for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(fields.stress[6 * i + c], tensor[c]);
  }
}

constexpr double single_precision = 2e-7;

TEST(Recovery, LinearFieldIsExactInADistortedPolygon) {
  for (const model::Plane plane : {model::Plane::stress, model::Plane::strain})
    for (const int order : {1, 2, 3, 5})
      expect_linear_field(solution_of(model_of({elastic("body", pentagon(), 0.7, order)}, plane)), single_precision);
}

TEST(Recovery, LinearFieldIsExactInFiniteElements) {
  for (const model::Plane plane : {model::Plane::stress, model::Plane::strain})
    expect_linear_field(solution_of(model_of({finite_elements("body", {1.0, -2.0}, {3.0, 1.0}, 0.4)}, plane)),
                        single_precision);
}

TEST(Recovery, RigidMotionCarriesNoStress) {
  const auto solution = solution_of(model_of(
      {elastic("a", pentagon(), 0.5), finite_elements("b", {5.0, 0.0}, {1.0, 1.0}, 0.5)}, model::Plane::strain));
  const Field turn = [](const Vec2& x) { return Vec2(0.3 - 0.01 * x.y(), -0.2 + 0.01 * x.x()); };
  const Recovery recovery(solution);
  const Fields fields = recovery.fields(solution, increment_of(solution, turn).fields);
  for (const float value : fields.von_mises) EXPECT_LT(value, 1e-8 * (0.01 * young));
}

// Hanging under its own weight without lateral contraction: s_yy = rho g y, u_y = rho g y^2 / 2 E.
TEST(Recovery, BodyForceIsPartOfTheInterior) {
  const double weight = 9.81 * density;
  auto solution = solution_of(model_of({elastic("a", pentagon(), 0.7, 2)}, model::Plane::stress, 0.0));
  auto increment =
      increment_of(solution, [&](const Vec2& x) { return Vec2(0.0, weight * x.y() * x.y() / (2.0 * young)); });
  increment.fields.interior[0].resize(1);
  increment.fields.interior[0][0].loads = element::body_force_loads(solution.cells[0][0]->ring, {0.0}, {-weight}, 0.5);
  const Recovery recovery(solution);
  const Fields fields = recovery.fields(solution, increment.fields);
  for (std::size_t i = 0; i < recovery.grid().point_count(); ++i) {
    const double y = recovery.grid().points[3 * i + 1];
    EXPECT_NEAR(fields.stress_yy[i], weight * y, 1e-6 * weight);
    EXPECT_NEAR(fields.stress_xx[i], 0.0, 1e-6 * weight);
    EXPECT_NEAR(fields.displacement[3 * i + 1], weight * y * y / (2.0 * young), 1e-14);
  }
}

/// A square of 8 x 8 equal cells, which share one super-element.
analysis::StaticSolution equal_cells(int order) {
  model::Body body = elastic("a", rectangle({0.0, 0.0}, {2.0, 2.0}), 0.25, order);
  body.mesh.kind = model::MeshKind::quadtree;
  auto solution = solution_of(model_of({body}, model::Plane::strain));
  for (auto& cell : solution.cells[0]) cell = solution.cells[0][0];
  return solution;
}

TEST(Recovery, LinearFieldIsExactInEqualCells) {
  for (const int order : {1, 2, 3}) {
    const auto solution = equal_cells(order);
    ASSERT_EQ(solution.cells[0].size(), 64u);
    ASSERT_GT(64u, 4 * solution.cells[0][0]->ring.nodes.size());  // a map is worth its cost
    expect_linear_field(solution, single_precision);
  }
}

// A load of zero inside a cell asks for its field itself, not for the map that equal cells share.
TEST(Recovery, EqualCellsHaveTheFieldOfEach) {
  const auto solution = equal_cells(2);
  const Field bent = [](const Vec2& x) {
    return Vec2(7.0 + 1e-3 * x.x() * x.y() * x.y(), -3.0 + 2e-3 * std::sin(x.x() - 0.3 * x.y()));
  };
  auto increment = increment_of(solution, bent);
  const Recovery recovery(solution);
  const Fields mapped = recovery.fields(solution, increment.fields);
  increment.fields.interior[0].resize(64);
  for (auto& interior : increment.fields.interior[0])
    interior.loads = element::body_force_loads(solution.cells[0][0]->ring, {0.0}, {0.0}, 0.5);
  const Fields plain = recovery.fields(solution, increment.fields);
  const double largest = *std::max_element(plain.von_mises.begin(), plain.von_mises.end());
  ASSERT_GT(largest, 1e-3 * young);
  for (std::size_t i = 0; i < recovery.grid().point_count(); ++i) {
    EXPECT_NEAR(mapped.displacement[3 * i], plain.displacement[3 * i], 1e-13 * 7.0) << i;
    EXPECT_NEAR(mapped.displacement[3 * i + 1], plain.displacement[3 * i + 1], 1e-13 * 7.0) << i;
    EXPECT_NEAR(mapped.stress_xx[i], plain.stress_xx[i], single_precision * largest) << i;
    EXPECT_NEAR(mapped.stress_yy[i], plain.stress_yy[i], single_precision * largest) << i;
    EXPECT_NEAR(mapped.stress_xy[i], plain.stress_xy[i], single_precision * largest) << i;
    EXPECT_NEAR(mapped.stress_zz[i], plain.stress_zz[i], single_precision * largest) << i;
  }
}

TEST(Recovery, FirstPointsAreTheNodesAndTheLastIsTheCentre) {
  const auto solution = solution_of(model_of(
      {finite_elements("a", {0.0, 0.0}, {1.0, 1.0}, 0.5), elastic("b", pentagon(), 0.7)}, model::Plane::stress));
  const Recovery recovery(solution);
  const Grid& grid = recovery.grid();
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t i = 0; i < solution.mesh.bodies[b].nodes.size(); ++i)
      EXPECT_EQ(point_of(grid, grid.first_point[b] + i), solution.mesh.bodies[b].nodes[i]);
  EXPECT_EQ(point_of(grid, grid.point_count() - 1), solution.mesh.bodies[1].cells[0].centre);
  EXPECT_EQ(grid.point_body.front(), 1);
  EXPECT_EQ(grid.point_body.back(), 2);
  EXPECT_EQ(grid.first_point.back(), grid.point_count());
}

TEST(Recovery, CellsCoverTheBodyOnce) {
  const model::Body body = elastic("body", pentagon(), 0.6, 3);
  const double area = body.outline.area();
  const auto solution = solution_of(model_of({body}, model::Plane::stress));
  const Recovery recovery(solution);
  const Grid& grid = recovery.grid();
  double sum = 0.0;
  for (std::size_t cell = 0, begin = 0; cell < grid.cell_count(); ++cell) {
    const auto end = static_cast<std::size_t>(grid.offsets[cell]);
    double twice = 0.0;
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t next = k + 1 < end ? k + 1 : begin;
      twice += cross(point_of(grid, static_cast<std::size_t>(grid.connectivity[k])),
                     point_of(grid, static_cast<std::size_t>(grid.connectivity[next])));
    }
    EXPECT_GT(twice, 0.0) << "cell " << cell;
    sum += 0.5 * twice;
    begin = end;
  }
  EXPECT_NEAR(sum, area, 1e-12 * area);
}

TEST(Recovery, RingsAreNarrowAtTheBoundary) {
  for (const double size : {2.0, 0.3, 0.02}) {
    const mesh::Mesh mesh = mesh::make_mesh(model_of({elastic("body", pentagon(), size, 1)}, model::Plane::stress));
    const std::vector<double> levels = ring_levels(element::ring_of(mesh.bodies[0].cells[0], mesh.bodies[0].nodes));
    EXPECT_EQ(levels.front(), 1.0);
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
      EXPECT_GT(levels[i], levels[i + 1]);
      const double further = i + 2 < levels.size() ? levels[i + 2] : 0.0;
      EXPECT_LE(levels[i] - levels[i + 1], (levels[i + 1] - further) * (1.0 + 1e-9));
    }
    EXPECT_GT(levels.back(), 0.05);
  }
}

// Strain along a side of elements of order 2, whose lengths a differ, from nodal displacements: right to rounding where
// it is linear. Where it is 3 x^2, the mean between two Gauss points is too large by 0.54 (a / 2)^2 at the ends of
// elements, and the value in their middles by (a / 2)^2; at the ends themselves it would be too small by 2 (a / 2)^2,
// and contours would be jagged.
TEST(Recovery, StressAlongQuadraticElementsDoesNotZigzag) {
  const model::Outline block =
      polygon({{0.0, 0.0}, {0.6, 0.0}, {2.0, 0.0}, {2.0, 1.4}, {0.0, 1.4}}, {"a", "b", "c", "d", "e"});
  const model::Model model = model_of({elastic("body", block, 0.7, 2)}, model::Plane::stress);
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const element::Ring ring = element::ring_of(mesh.bodies[0].cells[0], mesh.bodies[0].nodes);
  const Vec2 centre = mesh.bodies[0].cells[0].centre;
  const RingSampling sampling = ring_sampling(ring, element::sectors_of(model, mesh.bodies[0].cells[0]), false);
  for (const double power : {2.0, 3.0}) {
    std::vector<double> strain(sampling.nodes.size(), 0.0);
    for (const RingSampling::Sample& sample : sampling.samples) {
      const std::vector<int>& nodes = ring.elements[sample.element].nodes;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        strain[static_cast<std::size_t>(sample.point)] += sample.weight *
                                                          sample.B2(0, 2 * static_cast<Eigen::Index>(i)) *
                                                          std::pow(centre.x() + ring.node(nodes[i]).x(), power);
    }
    int seen = 0;
    for (std::size_t point = 0; point < strain.size(); ++point) {
      const Vec2 x = centre + ring.node(sampling.nodes[point]);
      if (std::abs(x.y()) > 1e-12 || x.x() < 0.1 || x.x() > 1.9) continue;
      ++seen;
      const double error = strain[point] - power * std::pow(x.x(), power - 1.0), half = 0.35;
      if (power == 2.0) EXPECT_NEAR(error, 0.0, 1e-12) << x.x();
      if (power == 3.0) EXPECT_GT(error, 0.4 * half * half) << x.x();
      if (power == 3.0) EXPECT_LT(error, 1.01 * half * half) << x.x();
    }
    EXPECT_EQ(seen, 5);
  }
}

// Few points of a model are sampled twice as finely: where drawing between the points of the usual rings leaves kinks
// of a quarter of a ring's curvature, a sixteenth is left.
TEST(Recovery, FineRingsHalveTheUsualOnes) {
  const mesh::Mesh mesh = mesh::make_mesh(model_of({elastic("body", pentagon(), 2.0, 1)}, model::Plane::stress));
  const element::Ring ring = element::ring_of(mesh.bodies[0].cells[0], mesh.bodies[0].nodes);
  const std::vector<double> usual = ring_levels(ring), fine = ring_levels(ring, true);
  ASSERT_EQ(fine.size(), 2 * usual.size());
  for (std::size_t i = 0; i < usual.size(); ++i) EXPECT_NEAR(fine[2 * i], usual[i], 1e-9) << i;
}

// Between two nodes of a coarse boundary there is one more point, whose stress follows the displacements exactly where
// these are polynomials of the elements' order. Elements of order 1 have none.
TEST(Recovery, CoarseBoundariesHavePointsBetweenNodes) {
  for (const int order : {1, 2, 3, 5}) {
    const model::Model model = model_of({elastic("body", pentagon(), 2.0, order)}, model::Plane::stress);
    const mesh::Mesh mesh = mesh::make_mesh(model);
    const element::Ring ring = element::ring_of(mesh.bodies[0].cells[0], mesh.bodies[0].nodes);
    const RingSampling sampling = ring_sampling(ring, element::sectors_of(model, mesh.bodies[0].cells[0]), false, true);
    ASSERT_EQ(sampling.between.size(), order == 1 ? 0 : ring.nodes.size());
    for (std::size_t e = 0; e < sampling.points.size(); ++e)
      for (std::size_t i = 0; i < sampling.points[e].size(); ++i) {
        const auto point = static_cast<std::size_t>(sampling.points[e][i]);
        EXPECT_EQ(point >= sampling.nodes.size(), order > 1 && i % 2 == 1);
        if (i == 0) continue;
        const auto place = [&](int p) {
          return sampling.at(static_cast<std::size_t>(p), [&](int node) { return ring.node(node); });
        };
        const Vec2 first = place(sampling.points[e].front()), last = place(sampling.points[e].back());
        EXPECT_GT((place(sampling.points[e][i]) - place(sampling.points[e][i - 1])).dot(last - first), 0.0);
        EXPECT_NEAR(cross(place(sampling.points[e][i]) - first, last - first), 0.0, 1e-12);
      }
    std::vector<double> weight(sampling.size(), 0.0);
    for (const RingSampling::Sample& sample : sampling.samples)
      weight[static_cast<std::size_t>(sample.point)] += sample.weight;
    for (const double sum : weight) EXPECT_NEAR(sum, 1.0, 1e-14);
  }
}

// Strain along a side of elements of order 1 whose displacement is x^2: 2 x, constant in each element and right in its
// middle. Interpolated to nodes and extrapolated to corners it is right there too; the mean of the two sides of a
// corner would be wrong by the length of an element.
TEST(Recovery, StressOfLinearElementsIsRightAtCornersToo) {
  const model::Outline block =
      polygon({{0.0, 0.0}, {0.6, 0.0}, {2.0, 0.0}, {2.0, 1.4}, {0.0, 1.4}}, {"a", "b", "c", "d", "e"});
  const model::Model model = model_of({elastic("body", block, 0.3, 1)}, model::Plane::stress);
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const element::Ring ring = element::ring_of(mesh.bodies[0].cells[0], mesh.bodies[0].nodes);
  const Vec2 centre = mesh.bodies[0].cells[0].centre;
  const RingSampling sampling = ring_sampling(ring, element::sectors_of(model, mesh.bodies[0].cells[0]), false, true);
  std::vector<double> strain(sampling.size(), 0.0), weight(sampling.size(), 0.0);
  for (const RingSampling::Sample& sample : sampling.samples) {
    const auto point = static_cast<std::size_t>(sample.point);
    const std::vector<int>& nodes = ring.elements[sample.element].nodes;
    const double along = ring.node(nodes.back()).x() - ring.node(nodes.front()).x();
    if (std::abs(along) < 1e-12) continue;  // of the upright side at a corner
    weight[point] += sample.weight;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      strain[point] += sample.weight * sample.B2(0, 2 * static_cast<Eigen::Index>(i)) *
                       std::pow(centre.x() + ring.node(nodes[i]).x(), 2.0);
  }
  int corners = 0;
  for (std::size_t point = 0; point < strain.size(); ++point) {
    const Vec2 x = centre + ring.node(sampling.nodes[point]);
    if (std::abs(x.y()) > 1e-12) continue;
    const bool corner = x.x() < 1e-9 || x.x() > 2.0 - 1e-9;
    corners += corner;
    EXPECT_NEAR(weight[point], corner ? 0.5 : 1.0, 1e-14);
    EXPECT_NEAR(strain[point] / weight[point], 2.0 * x.x(), 1e-12) << x.x();
  }
  EXPECT_EQ(corners, 2);
}

// Rings of a cell are as wide as its boundary nodes are apart, at the boundary; of one with few nodes, and in a body of
// many cells, there is one ring half way.
TEST(Recovery, LargeCellsHaveMoreRings) {
  const auto levels_of = [](double size, bool fine) {
    const mesh::Mesh mesh = mesh::make_mesh(model_of({elastic("body", pentagon(), size, 2)}, model::Plane::stress));
    return cell_levels(element::ring_of(mesh.bodies[0].cells[0], mesh.bodies[0].nodes), fine);
  };
  EXPECT_EQ(levels_of(100.0, true), (std::vector<double>{1.0, 0.5}));
  EXPECT_EQ(levels_of(0.1, false), (std::vector<double>{1.0, 0.5}));
  std::size_t before = 2;
  for (const double size : {0.5, 0.2, 0.1}) {
    const std::vector<double> levels = levels_of(size, true);
    EXPECT_GT(levels.size(), before);
    before = levels.size();
    for (std::size_t i = 0; i + 2 < levels.size(); ++i)
      EXPECT_NEAR(levels[i + 1] - levels[i + 2], 1.5 * (levels[i] - levels[i + 1]), 1e-12);
    EXPECT_LE(levels.back(), 1.5 * 1.5 * (levels[levels.size() - 2] - levels.back()));  // as wide inside
  }
}

TEST(Recovery, RigidBodyIsItsMovedOutline) {
  const model::Outline disc = outline({arc("lower", {1.0, 2.0}, 0.5, pi, pi), arc("upper", {1.0, 2.0}, 0.5, 0.0, pi)});
  const auto solution = solution_of(model_of({rigid("punch", disc)}, model::Plane::strain));
  const Recovery recovery(solution);
  const Grid& grid = recovery.grid();
  const Fields fields =
      recovery.fields(solution, increment_of(solution, linear_field(gradient), {0.01, -0.02, 0.003}).fields);
  EXPECT_EQ(grid.cell_count(), 1U);
  EXPECT_EQ(grid.point_count(), 120U);
  for (std::size_t i = 0; i < grid.point_count(); ++i) {
    const Vec2 arm = point_of(grid, i) - Vec2(1.0, 2.0);
    EXPECT_NEAR(arm.norm(), 0.5, 1e-15);
    EXPECT_NEAR(fields.displacement[3 * i], 0.01 - 0.003 * arm.y(), 1e-15);
    EXPECT_NEAR(fields.displacement[3 * i + 1], -0.02 + 0.003 * arm.x(), 1e-15);
    EXPECT_EQ(fields.von_mises[i], 0.0F);
  }
}

}  // namespace
}  // namespace scabo::result
