// The mass matrix of a super-element: int over the body of rho u.u, u(xi) = xi^S u(1).
#include "scabo/element/facet/mass.hpp"
#include "scabo/element/plane/stiffness.hpp"

#include <gtest/gtest.h>

#include "scabo/geometry/line_basis.hpp"
#include "support/decompositions.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;

struct Solved {
  Ring ring;
  SuperElementSolution solution;
  ModalSolution modal;
  Solved(Ring r, const Mat3& D, double thickness = 1.0)
      : ring(std::move(r)), solution(solve_super_element(ring, D, thickness)), modal(modal_solution(solution)) {}
  Matrix mass(const std::vector<double>& density, double thickness = 1.0) const {
    return mass_matrix(ring, solution, modal, density, thickness);
  }
};

Vector translation(const Ring& ring, int component) {
  return at_nodes(ring.nodes, [&](const Vec2&) { return component == 0 ? Vec2(1, 0) : Vec2(0, 1); });
}

/// int_0^1 xi (xi^S)' M0 xi^S dxi by Gauss points in t, xi = t^4 (exponents may lie near 0.5), with the dense
/// exponential of the whole S = E0^-1 (K - E1').
Matrix by_quadrature(const Ring& ring, const Mat3& D, const Matrix& K, const std::vector<double>& density) {
  const CoefficientMatrices matrices = coefficient_matrices(ring, D, 1.0);
  Matrix S = solve_cholesky(Matrix(matrices.E0), K - Matrix(matrices.E1).transpose());
  const Matrix M0 = boundary_mass(ring, density, 1.0);
  const geometry::GaussRule rule = geometry::gauss_rule(120);
  Matrix M = Matrix::Zero(K.rows(), K.cols());
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const double t = 0.5 * (1.0 + rule.points[q]), xi = t * t * t * t;
    const Matrix power = exponential(S * std::log(xi));
    M += (0.5 * rule.weights[q] * 4.0 * t * t * t * xi) * power.transpose() * M0 * power;
  }
  return M;
}

/// A square with a crack along the negative x axis: the mouth is doubled, the chain runs from its lower to its upper
/// node.
Ring cracked_square(int divisions, int order) {
  Ring closed = polygon_ring({{-1, 0}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, divisions, order);
  Ring ring;
  ring.nodes = closed.nodes;
  ring.elements = closed.elements;
  ring.elements.back().nodes.back() = static_cast<int>(ring.nodes.size());
  ring.nodes.push_back(ring.nodes.front());
  return ring;
}

struct Case {
  const char* name;
  Ring ring;
  Mat3 D;
};

std::vector<Case> cases() {
  const std::vector<Vec2> skew = {{-0.7, -0.9}, {1.1, -0.6}, {1.4, 0.2}, {0.3, 0.4}, {-0.2, 1.3}, {-1.0, 0.1}};
  const Mat3 D = elasticity(10.0, 0.3), strain = elasticity(1.0, 0.4999, model::Plane::strain);
  return {{"no symmetry", polygon_ring(skew, 1, 2), D},
          {"four blocks", rectangle_ring(3, 1, 2, 1, 2), D},
          {"four blocks in one", unsplit(rectangle_ring(3, 1, 2, 1, 2)), D},
          {"nearly incompressible", polygon_ring(skew, 1, 3), strain},
          {"crack", cracked_square(1, 2), D}};
}

std::vector<double> density_for_each(const Ring& ring) {
  std::vector<double> density;
  for (std::size_t e = 0; e < ring.elements.size(); ++e) density.push_back(1.0 + 0.7 * static_cast<double>(e % 3));
  return density;
}

TEST(Mass, AgreesWithQuadratureOverXi) {
  for (const Case& c : cases()) {
    const Solved solved(c.ring, c.D);
    for (const auto& density : {std::vector<double>{2.0}, density_for_each(c.ring)}) {
      const Matrix M = solved.mass(density), oracle = by_quadrature(c.ring, c.D, solved.solution.K, density);
      EXPECT_LT(largest(M - oracle), 1e-11 * largest(oracle)) << c.name << ", densities: " << density.size();
    }
  }
}

TEST(Mass, AnOpenRingHasExponentsNearOneHalf) {
  const Solved solved(cracked_square(2, 3), elasticity(1.0, 0.3));
  int singular = 0;
  for (const auto& exponent : solved.modal.exponents) singular += std::abs(exponent - 0.5) < 1e-2;
  EXPECT_EQ(singular, 2);
}

TEST(Mass, OfATranslationIsThatOfTheBody) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Ring ring = polygon_ring(random_star(random, std::pow(10.0, uniform(random, -3, 3))), whole(random, 1, 2),
                                   whole(random, 1, 5));
    const Solved solved(ring, random_elasticity(random), 0.7);
    double area = 0.0;
    for (std::size_t i = 0; i < ring.nodes.size(); ++i)  // straight edges
      area += 0.5 * cross(ring.nodes[i], ring.nodes[(i + 1) % ring.nodes.size()]);
    const Matrix M = solved.mass({2400.0}, 0.7);
    const double mass = 2400.0 * 0.7 * area;
    EXPECT_EQ(largest(M - M.transpose()), 0.0);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        EXPECT_NEAR(translation(ring, a).dot(M * translation(ring, b)), a == b ? mass : 0.0, 1e-12 * mass);
  }
}

// Linear fields are in the space of xi^S u(1): their kinetic energy is exact. Second moments of a polygon by Green's
// theorem.
TEST(Mass, OfLinearVelocitiesIsExact) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<Vec2> corners = random_star(random);
    const Ring ring = polygon_ring(corners, whole(random, 1, 2), whole(random, 1, 5));
    const Solved solved(ring, random_elasticity(random));
    Mat2 moments = Mat2::Zero();  // int x x' dA over triangles at the origin
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 &p = corners[i], &q = corners[(i + 1) % corners.size()];
      moments += cross(p, q) / 24.0 * ((p + q) * (p + q).transpose() + p * p.transpose() + q * q.transpose());
    }
    const Matrix M = solved.mass({3.0});
    Mat2 G;
    G << uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1);
    const Vector u = at_nodes(ring.nodes, [&](const Vec2& x) { return Vec2(G * x); });
    const double exact = 3.0 * (G * moments * G.transpose()).trace();
    EXPECT_NEAR(u.dot(M * u), exact, 1e-12 * exact);
  }
}

TEST(Mass, IsPositiveDefinite) {
  std::mt19937 random(11);
  double least = 1.0;
  for (int trial = 0; trial < 20; ++trial) {
    const Solved solved(polygon_ring(random_star(random), 1, whole(random, 1, 8)), random_elasticity(random));
    const Vector values = symmetric_eigenvalues(solved.mass({1.0}));
    least = std::min(least, values.minCoeff() / values.maxCoeff());
  }
  EXPECT_GT(least, 1e-10);
  RecordProperty("least", testing::PrintToString(least));
}

TEST(Mass, IsTheSameWhetherSymmetriesAreUsedOrNot) {
  const Ring ring = rectangle_ring(6, 1.5, 16, 4, 2);
  const Mat3 D = elasticity(10e9, 0.3);
  const Matrix split = Solved(ring, D).mass({1.0}), whole_ring = Solved(unsplit(ring), D).mass({1.0});
  EXPECT_LT(largest(split - whole_ring), 1e-11 * largest(split));
}

// Curved edges: a disk of 8 arcs of order 4, its nodes on the circle.
TEST(Mass, OfACurvedBodyIsThatOfItsPolynomialOutline) {
  Ring ring = polygon_ring(regular_polygon(8, 1.0, 0.1), 1, 4);
  for (Vec2& x : ring.nodes) x.normalize();
  const Solved solved(ring, elasticity(1.0, 0.3));
  const Vector along = translation(ring, 0);
  const double area = 0.5 * test::uniform_body_force(ring, Vec2(1.0, 0.0), 1.0).front().g.sum();
  EXPECT_NEAR(area, std::numbers::pi, 1e-5);
  EXPECT_NEAR(along.dot(solved.mass({1.0}) * along), area, 1e-13);
}

}  // namespace
}  // namespace scabo::element
