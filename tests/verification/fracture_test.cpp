// Stress intensity factors, exponents and T-stress against closed forms and published numbers, by one super-element
// with its scaling centre at the tip. None has more than 200 degrees of freedom.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "scabo/element/plane/stress_intensity.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "support/decompositions.hpp"
#include "theory/open_rings.hpp"

namespace scabo::element {
namespace {

using namespace test;
using std::numbers::pi;

constexpr Eigen::Index most = 200;  // degrees of freedom

/// Displacement of a body without supports under a stress given on its boundary: rigid motions are held by nothing but
/// equilibrium.
template <typename Stress>
Vector free_body(const Ring& ring, const SuperElementSolution& solution, Stress stress) {
  const Eigen::Index n = solution.K.rows();
  Vector f = Vector::Zero(n);
  for (const mesh::LineElement& line : ring.elements) {
    const int order = static_cast<int>(line.nodes.size()) - 1;
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
    const geometry::GaussRule rule = geometry::gauss_rule(order + 4);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Vector N = basis.values(rule.points[q]);
      const BoundaryPoint point = boundary_point(ring, line, N, basis.derivatives(rule.points[q]));
      const Vec2 normal(point.x_eta.y(), -point.x_eta.x());  // outward, times ds / deta
      for (std::size_t i = 0; i < line.nodes.size(); ++i)
        f.segment<2>(2 * line.nodes[i]) +=
            N[static_cast<Eigen::Index>(i)] * rule.weights[q] * traction_of(stress(point.x), normal);
    }
  }
  Matrix R(n, 3);
  R.col(0) = at_nodes(ring.nodes, [](const Vec2&) { return Vec2(1, 0); });
  R.col(1) = at_nodes(ring.nodes, [](const Vec2&) { return Vec2(0, 1); });
  R.col(2) = at_nodes(ring.nodes, [](const Vec2& x) { return Vec2(-x.y(), x.x()); });
  EXPECT_LT((R.transpose() * f).norm(), 1e-10 * f.norm() * R.norm());
  const Matrix Q = orthonormal_columns(R);
  return solve_ldlt(solution.K + solution.K.trace() / static_cast<double>(n) * Q * Q.transpose(), f);
}

const Mat3 steel = elasticity(1.0, 0.3, model::Plane::strain);

// Numbers of two independent programs; half-height h, width W, crack a from the edge.
TEST(Fracture, SingleEdgeCrackUnderUniformTension) {
  const double cases[][3] = {
      {1, 0.5, 2.82546}, {0.5, 0.5, 3.00876}, {1, 0.4, 2.11276}, {1, 0.2, 1.36804}, {1, 0.6, 4.0333}};
  for (const auto& [h, a, expected] : cases) {
    const std::vector<Vec2> corners = {{-a, 0}, {-a, -h}, {1 - a, -h}, {1 - a, h}, {-a, h}, {-a, 0}};
    const Ring ring = open_ring(corners, std::vector<int>{1, 2, 2, 2, 1}, 12);
    const auto solution = solve_super_element(ring, steel, 1.0);
    EXPECT_LE(solution.K.rows(), most);
    const Vector u = free_body(ring, solution, [&, top = h](const Vec2& x) {
      return std::abs(x.y()) > 0.999999 * top ? Vec3(0, 1, 0) : Vec3(0, 0, 0);
    });
    const StressIntensity found = CornerAnalysis(ring, steel, solution).of(u);
    const double factor = found.K_I / std::sqrt(pi * a);
    EXPECT_NEAR(factor, expected, 1e-4 * expected);
    EXPECT_NEAR(found.K_II, 0.0, 1e-9);
    EXPECT_NEAR(factor, expected, 1e-5 * expected);  // the published ones have six digits
    EXPECT_NEAR(*found.J, *found.G, 1e-4 * *found.G);
  }
}

// 1.1215222552 / (1 - a/d)^(3/2), d the diameter (Gregory 1979): 2.2698 for a = 1.5 in a disk of radius 2.
void expect_disk(double R, double a, double expected) {
  // The circle as the tip sees it, cut into arcs; nodes on the circle.
  const std::vector<double> points = geometry::lobatto_points(12);
  Ring ring;
  const int parts = 8;
  const Vec2 centre(R - a, 0.0);
  for (int part = 0; part < parts; ++part) {
    mesh::LineElement line;
    for (int k = part == 0 ? 0 : 1; k <= 12; ++k) {
      const double angle = -pi + 2 * pi * (part + 0.5 * (points[static_cast<std::size_t>(k)] + 1)) / parts;
      ring.nodes.push_back(centre + R * Vec2(std::cos(angle), std::sin(angle)));
    }
    for (int k = 0; k <= 12; ++k) line.nodes.push_back(12 * part + k);
    ring.elements.push_back(line);
  }
  ring.nodes.front() = ring.nodes.back() = Vec2(-a, 0.0);
  const auto solution = solve_super_element(ring, steel, 1.0);
  EXPECT_LE(solution.K.rows(), most);
  const Vector u = free_body(ring, solution, [](const Vec2&) { return Vec3(1, 1, 0); });
  const StressIntensity found = CornerAnalysis(ring, steel, solution).of(u);
  EXPECT_NEAR(found.K_I / std::sqrt(pi * a), expected, 1e-4 * expected);
  EXPECT_NEAR(found.K_I / std::sqrt(pi * a), 1.1215222552 * std::pow(1.0 - 0.5 * a / R, -1.5), 1e-5 * expected);
  EXPECT_NEAR(found.K_II, 0.0, 1e-9);
}

TEST(Fracture, EdgeCrackedDiskUnderRadialTension) {
  expect_disk(2.0, 1.5, 2.2698);
  expect_disk(1.0, 1.5, 8.97218);
}

// Infinite plate with a crack of length 2a turned by b from the normal of the tension: exact displacement
// (Muskhelishvili) on a square about one tip. Here K_I, K_II and T are all closed forms.
TEST(Fracture, InclinedCrackInAnInfinitePlate) {
  const double a = 1.0, s = 1.0;
  const Kolosov m(1.0, 0.3, model::Plane::strain);
  for (const double b : {0.0, 0.3, pi / 4, 1.2}) {
    const double s11 = s * std::sin(b) * std::sin(b), s22 = s * std::cos(b) * std::cos(b),
                 s12 = s * std::sin(b) * std::cos(b);
    const Ring ring = cracked_square(1, 12, 0.4, 0.8);
    const Vector u = around_tip(ring, [&](double r, double t) {
      using C = std::complex<double>;
      const C c(0.5 * s22, -0.5 * s12), x = std::polar(r, t);
      const double A = 0.25 * (s11 - s22);
      const C root = std::polar(std::sqrt(r), 0.5 * t) * std::sqrt(x + 2.0 * a), z = x + a;
      const C phi = c * root + A * z,
              omega = c * std::conj(std::polar(std::sqrt(r), 0.5 * t)) * std::sqrt(std::conj(x) + 2.0 * a) -
                      A * std::conj(z);
      const C slope = c * z / root + A;
      const C w = (m.kappa * phi - omega - (x - std::conj(x)) * std::conj(slope)) / (2 * m.mu);
      return Vec2(w.real(), w.imag());
    });
    const StressIntensity found = CornerAnalysis(ring, steel, solve_super_element(ring, steel, 1.0)).of(u);
    EXPECT_NEAR(found.K_I, s * std::sqrt(pi * a) * std::cos(b) * std::cos(b), 1e-11);
    EXPECT_NEAR(found.K_II, s * std::sqrt(pi * a) * std::sin(b) * std::cos(b), 1e-11);
    EXPECT_NEAR(*found.T_left, -s * std::cos(2 * b), 1e-10);
  }
}

// Tension with pressed faces: the factors of the tension, and the modes take no part in the pressure.
TEST(Fracture, PressureOnTheFacesLeavesTheFactorsOfTheModes) {
  const Kolosov m(1.0, 0.3, model::Plane::strain);
  const Ring ring = cracked_square(1, 12);
  const double p = 0.8;
  const Vec3 strain = steel.inverse() * Vec3(0, -p, 0);
  const Vector u = around_tip(ring, [&](double r, double t) {
    return Vec2(williams(m, 1.0, 0.4, 0.0, r, t) + r * Vec2(strain[0] * std::cos(t), strain[1] * std::sin(t)));
  });
  const auto solution = solve_super_element(ring, steel, 1.0);
  const std::vector<RadialLoad> loads = {face_load(ring, Face::first, 0.0, {0, -p}, 1.0),
                                         face_load(ring, Face::last, 0.0, {0, p}, 1.0)};
  std::vector<RadialLoad> together;
  add_radial_loads(together, loads, 1.0);
  const StressIntensity found = CornerAnalysis(ring, steel, solution).of(u, together);
  EXPECT_NEAR(found.K_I, 1.0, 1e-8);
  EXPECT_NEAR(found.K_II, 0.4, 1e-8);
  EXPECT_FALSE(found.J.has_value());
  EXPECT_FALSE(found.T_left.has_value());
}

// Williams 1952: sin(lambda w) = +- lambda sin(w), w = 270 degrees.
TEST(Fracture, ExponentsOfThe270DegreeCorner) {
  const Ring ring = sector_ring(0.3, 1.5 * pi, {}, pi / 4, 12);
  const auto modes = singular_modes(solve_super_element(ring, steel, 1.0));
  ASSERT_EQ(modes.singular.size(), 2u);
  EXPECT_NEAR(modes.singular[0].T(0, 0), 0.544483737, 1e-8);
  EXPECT_NEAR(modes.singular[1].T(0, 0), 0.90852919, 1e-8);
}

TEST(Fracture, ExponentsOfAnInterfaceCrack) {
  const double cases[][2] = {{2, 0.0304074}, {10, 0.0758118}, {1000, 0.0933513}};
  for (const auto& [ratio, expected] : cases) {
    const Ring ring = cracked_square(1, 12);
    std::vector<Mat3> laws;
    for (const double angle : middle_angles(ring))
      laws.push_back(elasticity(angle < pi ? ratio : 1.0, 0.3, model::Plane::strain));
    const Elasticity D(laws);
    const auto modes = singular_modes(solve_super_element(ring, D, 1.0));
    ASSERT_EQ(modes.singular.size(), 1u);
    for (const auto& value : modes.singular.front().exponents) {
      EXPECT_NEAR(value.real(), 0.5, 1e-7);
      EXPECT_NEAR(std::abs(value.imag()), expected, 1e-7);
    }
  }
}

}  // namespace
}  // namespace scabo::element
