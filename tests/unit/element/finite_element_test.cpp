// Triangles and quadrilaterals with linear and quadratic sides, one element at a time.
#include "scabo/element/plane/finite_element.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scabo/geometry/line_basis.hpp"
#include "support/decompositions.hpp"
#include "theory/rings.hpp"
#include "unit/mesh/cell_meshes.hpp"

namespace scabo::element {
namespace {

using namespace test;

constexpr double thickness = 0.2;

const std::vector<Vec2> triangle_corners = {Vec2(0.2, -0.1), Vec2(2.1, 0.4), Vec2(0.7, 1.9)};
const std::vector<Vec2> quad_corners = {Vec2(0, 0), Vec2(2, 0.3), Vec2(2.4, 1.9), Vec2(-0.3, 1.5)};

const std::vector<Vec2> parallelogram_corners = {Vec2(0, 0), Vec2(2, 0.3), Vec2(2.4, 1.9), Vec2(0.4, 1.6)};

struct Kind {
  const char* name;
  FiniteElementKind kind;
  bool curved;
  int corners() const { return kind == FiniteElementKind::triangle3 || kind == FiniteElementKind::triangle6 ? 3 : 4; }
  int order() const { return kind == FiniteElementKind::triangle3 || kind == FiniteElementKind::quad4 ? 1 : 2; }
};

FiniteElement element_of(const std::vector<Vec2>& corners, int order, double bulge = 0.0) {
  CellMesh made(order);
  std::vector<int> numbers;
  for (const Vec2& x : corners) numbers.push_back(made.node(x));
  const mesh::Cell cell = made.add(mesh::CellKind::finite_element, numbers);
  if (order == 2)
    for (const mesh::LineElement& side : cell.boundary) {
      const auto at = [&](int i) -> Vec2& { return made.mesh.nodes[static_cast<std::size_t>(side.nodes[i])]; };
      const Vec2 along = at(2) - at(0);
      at(1) += bulge * Vec2(along.y(), -along.x()) + 0.5 * bulge * along;
    }
  return finite_element_of(cell, made.mesh.nodes);
}

class EveryKind : public testing::TestWithParam<Kind> {
 protected:
  FiniteElement element() const {
    return element_of(GetParam().corners() == 3 ? triangle_corners : quad_corners, GetParam().order(),
                      GetParam().curved ? 0.08 : 0.0);
  }
};

INSTANTIATE_TEST_SUITE_P(FiniteElement, EveryKind,
                         testing::Values(Kind{"triangle3", FiniteElementKind::triangle3, false},
                                         Kind{"triangle6", FiniteElementKind::triangle6, false},
                                         Kind{"curved_triangle6", FiniteElementKind::triangle6, true},
                                         Kind{"quad4", FiniteElementKind::quad4, false},
                                         Kind{"quad8", FiniteElementKind::quad8, false},
                                         Kind{"curved_quad8", FiniteElementKind::quad8, true}),
                         [](const auto& info) { return std::string(info.param.name); });

/// Values of a function at the nodes, two per node.
template <typename Field>
ElementVector values_of(const FiniteElement& element, Field field) {
  ElementVector u(2 * element.size());
  for (int i = 0; i < element.size(); ++i) u.segment<2>(2 * i) = field(element.x[static_cast<std::size_t>(i)]);
  return u;
}

/// int f dA with Gauss points on its own: 8 x 8 points in a quadrilateral, or in a square collapsed to the triangle.
template <typename Function>
double integral(const FiniteElement& element, Function f) {
  const geometry::GaussRule rule = geometry::gauss_rule(8);
  const bool triangle = element.corners() == 3;
  double sum = 0.0;
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = 0; j < 8; ++j) {
      Vec2 at(rule.points[i], rule.points[j]);
      double weight = rule.weights[i] * rule.weights[j];
      if (triangle) {
        const double r = 0.5 * (1.0 + at.x()), s = 0.5 * (1.0 + at.y());
        at = {r, (1.0 - r) * s};
        weight *= 0.25 * (1.0 - r);
      }
      constexpr double h = 0.5;  // positions are at most quadratic along r and s: central differences are exact
      const Vec2 by_r = (position_in(element, at + Vec2(h, 0)) - position_in(element, at - Vec2(h, 0))) / (2 * h);
      const Vec2 by_s = (position_in(element, at + Vec2(0, h)) - position_in(element, at - Vec2(0, h))) / (2 * h);
      sum += weight * cross(by_r, by_s) * f(position_in(element, at));
    }
  return sum;
}

TEST_P(EveryKind, HasItsKindAndItsNodesInTheirOrder) {
  const FiniteElement element = this->element();
  EXPECT_EQ(element.kind, GetParam().kind);
  EXPECT_EQ(element.corners(), GetParam().corners());
  EXPECT_EQ(element.size(), GetParam().corners() * GetParam().order());
  const auto natural = natural_nodes(element.kind);
  ASSERT_EQ(static_cast<int>(natural.size()), element.size());
  for (std::size_t i = 0; i < natural.size(); ++i)
    EXPECT_LT((position_in(element, natural[i]) - element.x[i]).norm(), 1e-15);
  EXPECT_TRUE(is_well_shaped(element));
}

TEST_P(EveryKind, IsExactForLinearFields) {
  const FiniteElement element = this->element();
  const Mat3 D = elasticity(10e9, 0.3);
  Mat2 gradient;
  gradient << 1e-3, 2e-3, -1e-3, 5e-4;
  const ElementVector u = values_of(element, [&](const Vec2& x) { return Vec2(gradient * x); });
  const Vec3 strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0)), stress = D * strain;
  const Vec2 natural = 0.3 * natural_nodes(element.kind)[1] + 0.2 * natural_nodes(element.kind)[2];
  const PointValues values = finite_element_values(element, u, D, natural);
  EXPECT_LT((values.displacement - gradient * position_in(element, natural)).norm(), 1e-17);
  EXPECT_LT(largest(values.strain - strain), 1e-17);
  EXPECT_LT(largest(values.stress - stress), 1e-14 * largest(stress));
  const Vec3 free(1e-4, 2e-4, -3e-4);
  EXPECT_LT(largest(finite_element_values(element, u, {D, free}, natural, 1.0).stress - D * (strain - free)),
            1e-14 * largest(stress));

  const ElementMatrix K = finite_element_stiffness(element, D, thickness);
  EXPECT_EQ(K, K.transpose());
  // Nodal forces of the traction on a side: halves, or int N_i dx/deta deta of a quadratic side.
  ElementVector f = ElementVector::Zero(2 * element.size());
  const int corners = element.corners();
  for (int side = 0; side < corners; ++side) {
    const int from = side, to = (side + 1) % corners, middle = corners + side;
    const auto x = [&](int i) { return element.x[static_cast<std::size_t>(i)]; };
    const auto force = [&](const Vec2& along) {
      return Vec2(thickness * traction_of(stress, Vec2(along.y(), -along.x())));
    };
    if (GetParam().order() == 1) {
      f.segment<2>(2 * from) += 0.5 * force(x(to) - x(from));
      f.segment<2>(2 * to) += 0.5 * force(x(to) - x(from));
      continue;
    }
    // int N_i dx/deta deta, by hand.
    f.segment<2>(2 * from) += force(4 * x(middle) - 3 * x(from) - x(to)) / 6;
    f.segment<2>(2 * to) += force(3 * x(to) - 4 * x(middle) + x(from)) / 6;
    f.segment<2>(2 * middle) += 4 * force(x(to) - x(from)) / 6;
  }
  EXPECT_LT(largest(K * u - f), 1e-13 * largest(f));
}

TEST_P(EveryKind, HasThreeRigidMotionsAndNoOtherZeroMode) {
  const FiniteElement element = this->element();
  const ElementMatrix K = finite_element_stiffness(element, elasticity(1.0, 0.3), thickness);
  for (const ElementVector& motion : {values_of(element, [](const Vec2&) { return Vec2(1, 0); }),
                                      values_of(element, [](const Vec2&) { return Vec2(0, 1); }),
                                      values_of(element, [](const Vec2& x) { return Vec2(-x.y(), x.x()); })})
    EXPECT_LT(largest(K * motion), 1e-15 * K.cwiseAbs().rowwise().sum().maxCoeff() * largest(motion) * 4);
  const Vector values = symmetric_eigenvalues(K);
  EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-14 * values.maxCoeff());
  EXPECT_GT(values[3], 0.01 * values.maxCoeff());
}

// In straight triangles and in parallelograms the integrand is a polynomial.
TEST_P(EveryKind, HasTheStiffnessOfManyMoreIntegrationPoints) {
  const FiniteElement element =
      element_of(GetParam().corners() == 3 ? triangle_corners : parallelogram_corners, GetParam().order());
  const Mat3 D = elasticity(1.0, 0.3);
  const ElementMatrix K = finite_element_stiffness(element, D, 1.0);
  // Energy of a field by other Gauss points.
  std::mt19937 random(7);
  ElementVector u(2 * element.size());
  for (double& value : u) value = uniform(random, -1.0, 1.0);
  const double energy = integral(element, [&](const Vec2& x) {
    const PointValues values = finite_element_values(element, u, D, *natural_coordinates(element, x));
    return values.stress.dot(values.strain);
  });
  EXPECT_NEAR(u.dot(K * u), energy, 1e-13 * energy);
}

TEST_P(EveryKind, MassIsThatOfItsArea) {
  const FiniteElement element = this->element();
  const double density = 2500.0, area = integral(element, [](const Vec2&) { return 1.0; });
  const ElementMatrix M = finite_element_mass(element, density, thickness);
  for (int c = 0; c < 2; ++c) {
    const ElementVector r = values_of(element, [c](const Vec2&) { return Vec2(c == 0, c == 1); });
    EXPECT_NEAR(r.dot(M * r), density * area * thickness, 1e-14 * density * area * thickness);
  }
  EXPECT_TRUE(is_positive_definite(M));
  if (GetParam().curved) return;
  // Kinetic energy of a rotation: second moments.
  const ElementVector turn = values_of(element, [](const Vec2& x) { return Vec2(-x.y(), x.x()); });
  const double polar = integral(element, [](const Vec2& x) { return x.squaredNorm(); });
  EXPECT_NEAR(turn.dot(M * turn), density * thickness * polar, 1e-14 * density * thickness * polar);
}

TEST_P(EveryKind, BodyForceHasItsResultantAndMoments) {
  const FiniteElement element = this->element();
  const LinearField b_x{3.0, -1.0, 0.5}, b_y{-2.0, 0.7, 1.5};
  const ElementVector f = finite_element_body_force(element, b_x, b_y, thickness);
  const double scale = f.lpNorm<1>();
  const auto work = [&](const auto& field) { return f.dot(values_of(element, field)); };
  const auto exact = [&](const auto& field) {
    return thickness * integral(element, [&](const Vec2& x) { return Vec2(b_x.at(x), b_y.at(x)).dot(field(x)); });
  };
  const auto along_x = [](const Vec2&) { return Vec2(1, 0); };
  const auto along_y = [](const Vec2&) { return Vec2(0, 1); };
  const auto turn = [](const Vec2& x) { return Vec2(-x.y(), x.x()); };
  const auto stretch = [](const Vec2& x) { return Vec2(x.x(), 2.0 * x.y()); };
  // With curved sides moments are polynomials of a higher degree than the rules integrate.
  const bool exactly = !GetParam().curved;
  EXPECT_NEAR(work(along_x), exact(along_x), 1e-14 * scale);
  EXPECT_NEAR(work(along_y), exact(along_y), 1e-14 * scale);
  EXPECT_NEAR(work(turn), exact(turn), (exactly ? 1e-14 : 1e-3) * scale);
  EXPECT_NEAR(work(stretch), exact(stretch), (exactly ? 1e-14 : 1e-3) * scale);
}

TEST_P(EveryKind, FreeUniformExpansionHasNoStress) {
  const FiniteElement element = this->element();
  const Mat3 D = elasticity(210e9, 0.3);
  const Vec3 unit(1.2e-5, 0.8e-5, 0.3e-5);
  const double T = 40.0;
  const ElementVector u = values_of(element, [&](const Vec2& x) {
    return Vec2(T * Vec2(unit[0] * x.x() + 0.5 * unit[2] * x.y(), 0.5 * unit[2] * x.x() + unit[1] * x.y()));
  });
  const ElementVector f = finite_element_thermal_force(element, {D, unit}, {T}, thickness);
  EXPECT_LT(largest(finite_element_stiffness(element, D, thickness) * u - f), 1e-13 * largest(f));
  for (const Vec2& natural : natural_nodes(element.kind))
    EXPECT_LT(largest(finite_element_values(element, u, {D, unit}, natural, T).stress),
              1e-14 * largest(D) * T * 1.2e-5);
}

// A temperature that is linear in x and y bends: u is quadratic, which straight triangles of order 2 and parallelograms
// represent.
TEST(FiniteElement, FreeExpansionByALinearTemperatureHasNoStressInQuadraticElements) {
  const Mat3 D = elasticity(210e9, 0.3);
  const double alpha = 1.2e-5;
  const LinearField T{20.0, -7.0, 11.0};
  for (const FiniteElement& element : {element_of(triangle_corners, 2), element_of(parallelogram_corners, 2)}) {
    const ElementVector u = values_of(element, [&](const Vec2& x) {
      const double squares = 0.5 * (x.x() * x.x() - x.y() * x.y()), product = x.x() * x.y();
      return Vec2(alpha * Vec2(T.constant * x.x() + T.per_x * squares + T.per_y * product,
                               T.constant * x.y() + T.per_x * product - T.per_y * squares));
    });
    const Vec3 unit(alpha, alpha, 0.0);
    const ElementVector f = finite_element_thermal_force(element, {D, unit}, T, thickness);
    EXPECT_LT(largest(finite_element_stiffness(element, D, thickness) * u - f), 1e-13 * largest(f));
    for (const Vec2& natural : natural_nodes(element.kind)) {
      const Vec3 free = T.at(position_in(element, natural)) * unit;
      EXPECT_LT(largest(finite_element_values(element, u, {D, free}, natural, 1.0).stress),
                1e-13 * largest(D) * alpha * 40);
    }
  }
}

// int x^4 dA = 4! / 6! on the unit triangle: the highest degree that the rule of the 6-node triangle integrates.
TEST(FiniteElement, TriangleRuleIsExactForDegreeFour) {
  const FiniteElement element = element_of({{0, 0}, {1, 0}, {0, 1}}, 2);
  const ElementMatrix M = finite_element_mass(element, 1.0, 1.0);
  const auto moment = [&](const auto& a, const auto& b) {
    return values_of(element, a).dot(M * values_of(element, b));
  };
  const auto xx = [](const Vec2& x) { return Vec2(x.x() * x.x(), 0.0); };
  const auto xy = [](const Vec2& x) { return Vec2(x.x() * x.y(), 0.0); };
  const auto yy = [](const Vec2& x) { return Vec2(x.y() * x.y(), 0.0); };
  EXPECT_NEAR(moment(xx, xx), 24.0 / 720.0, 1e-16);
  EXPECT_NEAR(moment(xx, xy), 6.0 / 720.0, 1e-17);
  EXPECT_NEAR(moment(xy, xy), 4.0 / 720.0, 1e-17);
  EXPECT_NEAR(moment(xx, yy), 4.0 / 720.0, 1e-17);
  EXPECT_NEAR(moment(yy, yy), 24.0 / 720.0, 1e-16);
}

TEST_P(EveryKind, FindsNaturalCoordinatesOfPointsInsideOnSidesAndAtCorners) {
  const FiniteElement element = this->element();
  const auto nodes = natural_nodes(element.kind);
  std::vector<Vec2> places(nodes.begin(), nodes.end());
  std::mt19937 random(11);
  for (int k = 0; k < 200; ++k) {
    Vec2 at(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
    if (element.corners() == 4)
      at = 2.0 * at - Vec2(1, 1);
    else if (at.sum() > 1.0)
      at = Vec2(1, 1) - at;
    places.push_back(at);
  }
  for (const Vec2& natural : places) {
    const auto found = natural_coordinates(element, position_in(element, natural));
    ASSERT_TRUE(found) << natural.transpose();
    EXPECT_LT((*found - natural).norm(), 1e-12) << natural.transpose();
  }
  EXPECT_FALSE(natural_coordinates(element, {10.0, 0.0}));
}

// Points just outside of a side belong to no element; the nearest point lies on that side, at the right distance.
TEST_P(EveryKind, FindsTheNearestPointOfItsSides) {
  const FiniteElement element = this->element();
  const auto nodes = natural_nodes(element.kind);
  const auto corners = static_cast<std::size_t>(element.corners());
  for (std::size_t side = 0; side < corners; ++side)
    for (const double t : {-0.7, 0.0, 0.4}) {
      const auto on_side = [&](double at) {
        return position_in(element, 0.5 * (1 - at) * nodes[side] + 0.5 * (1 + at) * nodes[(side + 1) % corners]);
      };
      const Vec2 along = (on_side(t + 1e-4) - on_side(t - 1e-4)).normalized();
      for (const double distance : {1e-3, 1e-2}) {
        const Vec2 x = on_side(t) + distance * Vec2(along.y(), -along.x());
        EXPECT_FALSE(natural_coordinates(element, x));
        const NearestOnSides nearest = nearest_on_sides(element, x);
        EXPECT_NEAR(nearest.distance, distance, 1e-9);
        EXPECT_LT((position_in(element, nearest.natural) - on_side(t)).norm(), 1e-6);
      }
    }
}

TEST(FiniteElement, LocatesPointsInVeryDistortedQuadrilaterals) {
  std::mt19937 random(5);
  int tried = 0;
  for (int k = 0; k < 2000; ++k) {
    std::vector<Vec2> corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (Vec2& x : corners) x += 0.95 * Vec2(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0));
    const FiniteElement element = element_of(corners, 1 + k % 2);
    if (!(least_jacobian(element) > 1e-3)) continue;
    ++tried;
    const Vec2 natural(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0));
    const auto found = natural_coordinates(element, position_in(element, natural));
    ASSERT_TRUE(found) << k;
    EXPECT_LT((*found - natural).norm(), 1e-10) << k;
  }
  EXPECT_GT(tried, 800);
}

TEST(FiniteElement, KnowsFoldedShapes) {
  const FiniteElement turned = element_of({{0, 0}, {0, 1}, {1, 0}}, 1);  // clockwise
  EXPECT_DOUBLE_EQ(least_jacobian(turned), -1.0);
  EXPECT_FALSE(is_well_shaped(turned));
  EXPECT_FALSE(is_well_shaped(element_of({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 1)));      // a bow tie
  EXPECT_FALSE(is_well_shaped(element_of({{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}}, 2)));  // not convex
  EXPECT_FALSE(is_well_shaped(element_of({{0, 0}, {1, 0}, {2, 0}}, 1)));              // no area
  // Nodes at the quarter of two sides: the Jacobian vanishes at their corner, where strains are infinite.
  FiniteElement quarter = element_of({{0, 0}, {1, 0}, {0, 1}}, 2);
  quarter.x[3] = {0.25, 0.0};
  quarter.x[5] = {0.0, 0.25};
  EXPECT_NEAR(least_jacobian(quarter), 0.0, 1e-16);
  EXPECT_TRUE(is_well_shaped(quarter));
  const ElementVector u = values_of(quarter, [](const Vec2& x) { return Vec2(x.x(), 0.0); });
  EXPECT_TRUE(std::isnan(finite_element_values(quarter, u, Mat3(Mat3::Identity()), {0, 0}).stress[0]));
  EXPECT_TRUE(finite_element_stiffness(quarter, elasticity(1.0, 0.3), 1.0).allFinite());
  quarter.x[3] = {0.2, 0.0};  // beyond the quarter
  quarter.x[5] = {0.0, 0.3};
  EXPECT_FALSE(is_well_shaped(quarter));
}

TEST(FiniteElement, RefusesOtherCells) {
  CellMesh made(2);
  std::vector<int> numbers;
  for (const Vec2& x : regular_polygon(5, 1.0, 0.0)) numbers.push_back(made.node(x));
  const mesh::Cell pentagon = made.add(mesh::CellKind::finite_element, numbers);
  EXPECT_THROW(finite_element_of(pentagon, made.mesh.nodes), BrokenInvariant);
  mesh::Cell mixed = made.add(mesh::CellKind::finite_element, {0, 1, 2});
  mixed.boundary[1].nodes = {1, 2};
  EXPECT_THROW(finite_element_of(mixed, made.mesh.nodes), BrokenInvariant);
}

}  // namespace
}  // namespace scabo::element
