// The inside of a super-element: u(xi) = xi^S u(1), body forces, and scaled boundary coordinates.
#include "scabo/element/plane/interior_field.hpp"

#include <gtest/gtest.h>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/system/loads.hpp"
#include "support/decompositions.hpp"
#include "support/long_double.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;
using std::numbers::pi;

const std::vector<Vec2> skew = {{-0.7, -0.9}, {1.1, -0.6}, {1.4, 0.2}, {0.3, 0.4}, {-0.2, 1.3}, {-1.0, 0.1}};

/// xi^S u and its slope S xi^S u / xi by the dense exponential of the whole S = E0^-1 (K - E1'), in long
/// double. S t = 0 of the translations is made exact: what rounding of K leaves of it is a slope of 1 / xi.
struct Oracle {
  LongMatrix S;
  double rounding;  // of S in double: eps times the condition of E0: 5e-15, 5e-12 where the material is nearly
                    // incompressible
  Oracle(const Ring& ring, const Mat3& D, const Matrix& K) {
    const CoefficientMatrices matrices = coefficient_matrices(ring, D, 1.0);
    const LongMatrix E0 = Matrix(matrices.E0).cast<long double>(), E1 = Matrix(matrices.E1).cast<long double>();
    S = long_double::solve_lu(E0, K.cast<long double>() - E1.transpose());
    const Vector sizes = symmetric_eigenvalues(Matrix(matrices.E0));
    rounding = std::numeric_limits<double>::epsilon() * sizes.maxCoeff() / sizes.minCoeff();
    for (Eigen::Index component : {0, 1}) {
      LongVector t = LongVector::Zero(S.cols());
      for (Eigen::Index i = component; i < t.size(); i += 2) t[i] = 1.0L;
      S -= (S * t).eval() * t.transpose() / t.squaredNorm();
    }
  }
  LongVector at(const Vector& u, double xi) const {
    return long_double::exponential(S * std::log(static_cast<long double>(xi))) * u.cast<long double>();
  }
};

TEST(InteriorField, AgreesWithTheDenseMatrixExponential) {
  const Mat3 D = elasticity(10e9, 0.3), strain = elasticity(1.0, 0.4999, model::Plane::strain);
  const std::vector<std::pair<Ring, Mat3>> cases = {{polygon_ring(skew, 2, 2), D},
                                                    {rectangle_ring(6, 1.5, 4, 1, 2), D},  // four blocks
                                                    {unsplit(rectangle_ring(6, 1.5, 4, 1, 2)), D},
                                                    {polygon_ring(skew, 1, 3), strain},
                                                    {polygon_ring(rectangle(1, 1), 2, 1), strain}};
  std::mt19937 random(5);
  double worst = 0.0;
  for (const auto& [ring, elastic] : cases) {
    const auto solution = solve_super_element(ring, elastic, 1.0);
    const auto modal = modal_solution(solution);
    const Oracle oracle(ring, elastic, solution.K);
    const Vector u =
        at_nodes(ring.nodes, [&](const Vec2&) { return Vec2(uniform(random, -1, 1), uniform(random, -1, 1)); });
    const RadialField field(solution, modal, u, {});
    for (double xi : {1.0, 0.999, 0.9, 0.5, 0.1, 0.01}) {
      const auto values = field.at(xi);
      const LongVector exact = oracle.at(u, xi), slope = oracle.S * exact / static_cast<long double>(xi);
      const double error = largest(values.u - exact.cast<double>());
      const double slope_error = largest(values.u_xi - slope.cast<double>()) / largest(slope.cast<double>());
      EXPECT_LT(error, 1e-12 + 4 * oracle.rounding) << xi;
      EXPECT_LT(slope_error, 1e-12 + 4 * oracle.rounding) << xi;
      worst = std::max({worst, error, slope_error});
    }
  }
  RecordProperty("worst", testing::PrintToString(worst));
}

// Boundary displacements that jump from node to node, on 1,120 degrees of freedom, whose exponents lie up to 44 degrees
// from the real axis: on every ring, alone and together with others, the exponential is the dense one. S is far from
// normal: contours that were exact just where the exponents lie were wrong by 9e-8 on 1,600 degrees of freedom.
TEST(InteriorField, OfRoughBoundaryDisplacementsAgreesWithTheDenseMatrixExponential) {
  const auto solution = solve_super_element(rectangle_ring(6.0, 1.5, 112, 28, 2), elasticity(1.0, 0.3), 1.0);
  const linalg::SchurExponential modes(solution.blocks.front().S);
  const Eigen::Index n = modes.T().rows();
  const Vector c = Vector::NullaryExpr(n, [](Eigen::Index k) { return std::sin(1.3 * static_cast<double>(k * k)); });
  const double shift = 1.0;
  std::vector<double> s;
  for (int k = 0; k < 20; ++k) s.push_back(-2.9 * std::pow(0.83, k));
  const Matrix together = modes.propagate(c, {}, s, shift);
  for (const std::size_t k : {0u, 5u, 9u, 14u, 19u}) {
    const Matrix A = s[k] * (modes.T() - shift * Matrix::Identity(n, n));
    const Vector expected = exponential(A) * c;
    EXPECT_LT((modes.propagate(c, {}, s[k], shift) - expected).norm(), 1e-12 * c.norm()) << s[k];
    EXPECT_LT((together.col(static_cast<Eigen::Index>(k)) - expected).norm(), 1e-12 * c.norm()) << s[k];
  }
}

TEST(InteriorField, IsTheBoundaryAtTheBoundaryAndFiniteAtTheCentre) {
  const Ring ring = rectangle_ring(6, 1.5, 8, 2, 2);
  const Mat3 D = elasticity(10e9, 0.3);
  const auto solution = solve_super_element(ring, D, 1.0);
  const auto modal = modal_solution(solution);
  const Vector u = at_nodes(ring.nodes, [](const Vec2& x) { return Vec2(std::sin(x.x()), std::cos(2 * x.y())); });
  const RadialField field(solution, modal, u, {});
  EXPECT_LT(largest(field.at(1.0).u - u), 1e-13);
  const PointValues centre = point_values(ring, field.at(0.0), D, 0, 0.0);
  const PointValues near = point_values(ring, field.at(1e-6), D, 7, 0.3);
  EXPECT_TRUE(centre.stress.allFinite());
  // All rays meet in one displacement and one stress.
  EXPECT_LT(largest(centre.displacement - near.displacement), 1e-5);
  EXPECT_LT(largest(centre.stress - near.stress), 1e-4 * largest(centre.stress));
}

TEST(InteriorField, LinearFieldIsExactDownToTheCentre) {
  Mat2 gradient;
  gradient << 1e-3, 2e-3, -1e-3, 5e-4;
  const Mat3 D = elasticity(10e9, 0.3);
  const Vec3 stress = D * Vec3(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
  for (const Ring& ring :
       {rectangle_ring(6, 1.5, 4, 1, 2), rectangle_ring(6, 1.5, 16, 4, 2), polygon_ring(skew, 3, 3)}) {
    const auto solution = solve_super_element(ring, D, 1.0);
    const auto modal = modal_solution(solution);
    const RadialField field(solution, modal, at_nodes(ring.nodes, [&](const Vec2& x) { return Vec2(gradient * x); }),
                            {});
    for (double xi : {1e-1, 1e-2, 1e-4, 1e-6, 1e-9, 0.0}) {
      double error = 0.0;
      const auto values = field.at(xi);
      for (int e = 0; e < static_cast<int>(ring.elements.size()); ++e)
        error = std::max(error, largest(point_values(ring, values, D, e, 0.3).stress - stress) / largest(stress));
      EXPECT_LT(error, 1e-10) << "xi = " << xi;
    }
  }
}

// Differences of the displacement field are its strain: u_xi and u_part belong to u.
TEST(InteriorField, StrainIsTheGradientOfDisplacement) {
  const Ring ring = polygon_ring(skew, 2, 3);
  const Mat3 D = elasticity(1.0, 0.2);
  const auto solution = solve_super_element(ring, D, 1.0);
  const auto modal = modal_solution(solution);
  const Vector u = at_nodes(ring.nodes, [](const Vec2& x) { return Vec2(std::sin(3 * x.y()), std::cos(2 * x.x())); });
  const Vector F_b = solution.K * u;  // any load per node: the field only has to be consistent
  const RadialField field(solution, modal, u, {RadialLoad{2.0, F_b, {}}});
  const auto displacement = [&](const Vec2& x) {
    const ScaledPoint at = locate(ring, x).value();
    return point_values(ring, field.at(at.xi), D, at.element, at.eta).displacement;
  };
  for (int e = 0; e < static_cast<int>(ring.elements.size()); ++e) {
    const Vec2 x = 0.6 * boundary_position(ring, e, 0.37);
    const double h = 1e-5;
    const Vec2 by_x = (displacement(x + Vec2(h, 0)) - displacement(x - Vec2(h, 0))) / (2 * h);
    const Vec2 by_y = (displacement(x + Vec2(0, h)) - displacement(x - Vec2(0, h))) / (2 * h);
    const PointValues values = point_values(ring, field.at(0.6), D, e, 0.37);
    EXPECT_LT(largest(values.strain - Vec3(by_x.x(), by_y.y(), by_x.y() + by_y.x())), 1e-7 * largest(values.strain));
    EXPECT_LT(largest(values.stress - D * values.strain), 1e-14);
  }
}

/// A bar of width w and height h, hung by its top: stress_yy = rho g y above its lower end; closed form for
/// any nu.
struct HangingBar {
  double width = 1.5, height = 4.0, weight = 25e3, young = 30e9, poisson = 0.0;
  Vec2 displacement(const Vec2& x) const {  // about the centre of the bar
    const double y = x.y() + 0.5 * height, c = weight / young;
    return {-poisson * c * x.x() * y, 0.5 * c * (y * y - height * height + poisson * x.x() * x.x())};
  }
  Vec3 stress(const Vec2& x) const { return {0.0, weight * (x.y() + 0.5 * height), 0.0}; }
};

class GravityField : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(GravityField, HangingBarIsExact) {
  HangingBar bar;
  bar.poisson = std::get<1>(GetParam());
  const Mat3 D = elasticity(bar.young, bar.poisson);
  const double thickness = 0.4;
  const Ring ring = rectangle_ring(bar.width, bar.height, 2, 3, std::get<0>(GetParam()));
  const auto solution = solve_super_element(ring, D, thickness);
  const auto modal = modal_solution(solution);
  const Vector u = at_nodes(ring.nodes, [&](const Vec2& x) { return bar.displacement(x); });
  const std::vector<RadialLoad> loads = uniform_body_force(ring, Vec2(0.0, -bar.weight), thickness);
  const RadialField field(solution, modal, u, loads);
  const double most = largest(u), most_stress = bar.weight * bar.height;
  for (int e = 0; e < static_cast<int>(ring.elements.size()); ++e)
    for (double xi : {1.0, 0.7, 0.2, 1e-3}) {
      const Vec2 x = xi * boundary_position(ring, e, 0.4);
      const PointValues values = point_values(ring, field.at(xi), D, e, 0.4);
      EXPECT_LT(largest(values.displacement - bar.displacement(x)) / most, 1e-13);
      EXPECT_LT(largest(values.stress - bar.stress(x)) / most_stress, 1e-11);
    }
  // The nodal forces at the top carry the weight; all others nothing.
  const Vector reaction = solution.K * u - equivalent_load(solution, loads);
  const double total = bar.weight * bar.width * bar.height * thickness;
  double top = 0.0;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    if (ring.nodes[i].y() > 0.4999 * bar.height)
      top += reaction[at + 1];
    else
      EXPECT_LT(largest(reaction.segment<2>(at)), 1e-11 * total);
  }
  EXPECT_NEAR(top / total, 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(OrdersAndPoissons, GravityField,
                         testing::Combine(testing::Values(2, 3, 6), testing::Values(0.0, 0.3)));

// h sums to the body's weight and has its moment about the scaling centre, wherever that lies: h'R = int b'R
// dA.
TEST(BodyLoad, SumsToTheWeightWithTheMomentOfTheWeight) {
  std::mt19937 random(6);
  for (int k = 0; k < 50; ++k) {
    const std::vector<Vec2> vertices = random_star(random);
    const Ring ring = polygon_ring(vertices, 1 + k % 2, 1 + k % 3);
    double area = 0.0;
    Vec2 first_moment = Vec2::Zero();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec2 &a = vertices[i], &b = vertices[(i + 1) % vertices.size()];
      area += 0.5 * cross(a, b);
      first_moment += cross(a, b) / 6.0 * (a + b);
    }
    const Vec2 b(0.3, -1.0);
    const auto solution = solve_super_element(ring, elasticity(1.0, 0.3), 1.0);
    const Vector h = equivalent_load(solution, uniform_body_force(ring, b, 1.0));
    Vec2 sum = Vec2::Zero();
    double moment = 0.0;
    for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
      const Vec2 force = h.segment<2>(static_cast<Eigen::Index>(2 * i));
      sum += force;
      moment += cross(ring.nodes[i], force);
    }
    EXPECT_LT(largest(sum - area * b), 1e-12);
    EXPECT_NEAR(moment, cross(first_moment, b), 1e-12);
  }
}

/// A quarter of a ring sector with arcs, as its scaling centre sees it: edges that are not straight.
Ring disc(int elements, int order) {
  const std::vector<double> points = geometry::lobatto_points(order);
  Ring ring;
  const Vec2 centre(0.2, -0.1);
  for (int e = 0; e < elements; ++e) {
    mesh::LineElement element;
    for (int k = 0; k <= order; ++k) element.nodes.push_back((e * order + k) % (elements * order));
    for (int k = 0; k < order; ++k) {
      const double angle = 2.0 * pi * (e + 0.5 * (points[static_cast<std::size_t>(k)] + 1.0)) / elements;
      ring.nodes.push_back(Vec2(std::cos(angle), std::sin(angle)) - centre);
    }
    ring.elements.push_back(element);
  }
  return ring;
}

TEST(ScaledCoordinates, LocateIsTheInverse) {
  std::mt19937 random(7);
  std::vector<Ring> rings = {disc(6, 2), disc(4, 5), rectangle_ring(20, 1, 5, 1, 1)};
  for (int k = 0; k < 30; ++k) rings.push_back(polygon_ring(random_star(random), 2, 1 + k % 4));
  for (const Ring& ring : rings)
    for (int k = 0; k < 40; ++k) {
      const int element = whole(random, 0, static_cast<int>(ring.elements.size()) - 1);
      const double xi = uniform(random, 0.01, 1.0), eta = uniform(random, -0.999, 0.999);
      const auto at = locate(ring, xi * boundary_position(ring, element, eta));
      ASSERT_TRUE(at.has_value());
      EXPECT_EQ(at->element, element);
      EXPECT_NEAR(at->xi, xi, 1e-12);
      EXPECT_NEAR(at->eta, eta, 1e-11);
    }
}

// A centre near a corner: an element that spans more than a right angle, one end near and one far.
TEST(ScaledCoordinates, LocateFindsPointsOfWideElements) {
  const Ring ring = polygon_ring({{-0.05, -0.1}, {3.0, -0.1}, {-0.05, 2.0}}, 1, 1);
  for (int element = 0; element < 3; ++element)
    for (double eta : {-0.999, -0.5, 0.0, 0.5, 0.999}) {
      const auto at = locate(ring, 0.5 * boundary_position(ring, element, eta));
      ASSERT_TRUE(at.has_value()) << "element " << element << ", eta = " << eta;
      EXPECT_EQ(at->element, element);
      EXPECT_NEAR(at->xi, 0.5, 1e-12);
    }
}

TEST(ScaledCoordinates, BoundaryCentreAndOutside) {
  std::mt19937 random(8);
  std::vector<Ring> rings = {disc(6, 2), rectangle_ring(6, 1.5, 4, 1, 2)};
  for (int k = 0; k < 30; ++k) rings.push_back(polygon_ring(random_star(random), 2, 1 + k % 4));
  for (const Ring& ring : rings) {
    EXPECT_EQ(locate(ring, Vec2::Zero()).value().xi, 0.0);
    for (std::size_t i = 0; i < ring.nodes.size(); ++i) {  // a node belongs to an element that has it
      const auto at = locate(ring, ring.nodes[i]);
      ASSERT_TRUE(at.has_value());
      EXPECT_NEAR(at->xi, 1.0, 1e-12);
      EXPECT_LE(at->xi, 1.0);
      EXPECT_LT(largest(boundary_position(ring, at->element, at->eta) - ring.nodes[i]), 1e-9);
      EXPECT_FALSE(locate(ring, 1.0001 * ring.nodes[i]).has_value());
    }
    for (int element = 0; element < static_cast<int>(ring.elements.size()); ++element) {
      const Vec2 x = boundary_position(ring, element, uniform(random, -1, 1));
      EXPECT_FALSE(locate(ring, 1.0001 * x).has_value());
      EXPECT_FALSE(locate(ring, 50.0 * x).has_value());
      EXPECT_TRUE(locate(ring, 1e-9 * x).has_value());
    }
  }
}

}  // namespace
}  // namespace scabo::element
