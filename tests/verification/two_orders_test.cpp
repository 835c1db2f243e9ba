// Effectivity of the error estimate by two orders: estimated over true error in the energy norm. The true error is that
// against an energy in closed form or against the same boundary with elements of much higher order.
#include "scabo/element/plane/two_orders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numeric>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/system/body_system.hpp"
#include "scabo/system/loads.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;

using Stress = std::function<Vec3(const Vec2&)>;

/// The same boundary with elements of order `more` higher.
Ring raised(const Ring& ring, int more) {
  Ring fine;
  std::vector<int> first(ring.nodes.size(), -1);
  const auto shared = [&](int node) {
    int& number = first[static_cast<std::size_t>(node)];
    if (number < 0)
      number = static_cast<int>(fine.nodes.size()), fine.nodes.push_back(ring.nodes[static_cast<std::size_t>(node)]);
    return number;
  };
  for (std::size_t e = 0; e < ring.elements.size(); ++e) {
    const mesh::LineElement& old = ring.elements[e];
    mesh::LineElement element{{shared(old.nodes.front())}};
    const auto points = geometry::lobatto_points(static_cast<int>(old.nodes.size()) - 1 + more);
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      element.nodes.push_back(static_cast<int>(fine.nodes.size()));
      fine.nodes.push_back(boundary_position(ring, static_cast<int>(e), points[k]));
    }
    element.nodes.push_back(shared(old.nodes.back()));
    fine.elements.push_back(std::move(element));
  }
  return fine;
}

struct Solved {
  Ring ring;
  Matrix K;
  Vector u;
};

Vector forces(const Ring& ring, const Stress& stress) {
  return system::traction_forces(ring.elements, ring.nodes, 1.0,
                                 [&](const Vec2& x, const Vec2& n) { return traction_of(stress(x), n); });
}

/// Three constraints at the first and the farthest node hold the body.
Solved solve(const Ring& ring, const Mat3& D, const Vector& f) {
  Solved solved{ring, solve_super_element(ring, D, 1.0).K, {}};
  std::size_t far = 0;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i)
    if ((ring.nodes[i] - ring.nodes[0]).norm() > (ring.nodes[far] - ring.nodes[0]).norm()) far = i;
  const Vec2 arm = ring.nodes[far] - ring.nodes[0];
  std::vector<system::Constraint> constraints(3);
  constraints[0].dof = 0;
  constraints[1].dof = 1;
  constraints[2].dof = static_cast<int>(2 * far) + (std::abs(arm.x()) > std::abs(arm.y()) ? 1 : 0);
  system::Stiffness stiffness;
  stiffness.dense = std::make_shared<const Matrix>(solved.K);
  solved.u = system::elastic_body(stiffness, ring.nodes, constraints)->displacement(f, Eigen::Vector3d::Zero());
  return solved;
}

/// Tractions of a stress field on the whole boundary.
Solved solve(const Ring& ring, const Mat3& D, const Stress& stress) { return solve(ring, D, forces(ring, stress)); }

double difference(const Solved& a, const Solved& b) {
  return squared_difference({a.ring.elements, a.K, a.u, b.ring.elements, b.K, b.u});
}

double energy(const Solved& solved) { return 0.5 * solved.u.dot(solved.K * solved.u); }

Vec3 cantilever_stress(const Vec2& at) {  // Timoshenko: L = 8, D = 4, P = 1000, about the centre
  constexpr double L = 8, H = 4, P = 1000, I = H * H * H / 12;
  const double x = at.x() + 0.5 * L, y = at.y();
  return {P * (L - x) * y / I, 0.0, -P / (2 * I) * (H * H / 4 - y * y)};
}

Vec3 smooth_stress(const Vec2& x) {  // Kolosov and Muskhelishvili, phi = exp(c z), psi = exp(d z)
  using Complex = std::complex<double>;
  const Complex z(x.x(), x.y()), c(1.2, 1.0), d(-0.8, 1.4);
  const double sum = 4.0 * (c * std::exp(c * z)).real();
  const Complex difference = 2.0 * (std::conj(z) * c * c * std::exp(c * z) + d * std::exp(d * z));
  return {0.5 * (sum - difference.real()), 0.5 * (sum + difference.real()), 0.5 * difference.imag()};
}

/// Kirsch: a hole of radius 1 in a plate pulled along x by 1. `x` about the hole's centre.
Vec3 kirsch_stress(const Vec2& x) {
  const double r = x.norm(), theta = std::atan2(x.y(), x.x()), a2 = 1.0 / (r * r), a4 = a2 * a2;
  const double c2 = std::cos(2 * theta), c4 = std::cos(4 * theta), s2 = std::sin(2 * theta), s4 = std::sin(4 * theta);
  return {1 - a2 * (1.5 * c2 + c4) + 1.5 * a4 * c4, -a2 * (0.5 * c2 - c4) - 1.5 * a4 * c4,
          -a2 * (0.5 * s2 + s4) + 1.5 * a4 * s4};
}

/// Quarter of a plate, 4 x 4, with the hole's quarter cut out, seen from (2.3, 2.3).
Ring quarter_with_hole(int n, int order) {
  const Vec2 centre(2.3, 2.3);
  const auto side = [&](const Vec2& a, const Vec2& b, double t) { return Vec2(a + t * (b - a) - centre); };
  const std::vector<std::function<Vec2(double)>> sides = {
      [&](double t) {
        return side({1, 0}, {4, 0}, t);
      },
      [&](double t) {
        return side({4, 0}, {4, 4}, t);
      },
      [&](double t) {
        return side({4, 4}, {0, 4}, t);
      },
      [&](double t) {
        return side({0, 4}, {0, 1}, t);
      },
      [&](double t) {
        const double angle = 0.5 * std::numbers::pi * (1 - t);
        return Vec2(Vec2(std::cos(angle), std::sin(angle)) - centre);
      }};
  const auto points = geometry::lobatto_points(order);
  Ring ring;
  for (const auto& along : sides)
    for (int part = 0; part < n; ++part) {
      mesh::LineElement element;
      for (int k = 0; k <= order; ++k) element.nodes.push_back(static_cast<int>(ring.nodes.size()) + k);
      for (int k = 0; k < order; ++k)
        ring.nodes.push_back(along((part + 0.5 * (points[static_cast<std::size_t>(k)] + 1)) / n));
      ring.elements.push_back(element);
    }
  ring.elements.back().nodes.back() = 0;
  return ring;
}

struct Case {
  const char* name;
  std::function<Ring(int n, int order)> ring;
  Stress stress;
};
std::vector<Case> cases() {
  return {{"Timoshenko", [](int n, int p) { return rectangle_ring(8, 4, 2 * n, n, p); }, cantilever_stress},
          {"smooth",
           [](int n, int p) {
             return polygon_ring({{-1.0, -0.8}, {1.2, -0.9}, {0.9, 1.0}, {-0.8, 0.7}}, 2 * n, p);
           },
           smooth_stress},
          {"Kirsch", quarter_with_hole, [](const Vec2& x) { return kirsch_stress(x + Vec2(2.3, 2.3)); }}};
}

TEST(ErrorByTwoOrders, IsBetweenHalfAndTwiceTheTrueErrorOfSmoothSolutions) {
  const Mat3 D = elasticity(3e7, 0.3);
  for (const Case& of : cases())
    for (const int order : {1, 2, 3, 5})
      for (const int n : {2, 3}) {
        if (std::string(of.name) == "Timoshenko" && order >= 3) continue;  // exact
        const Ring ring = of.ring(n, order);
        const Solved coarse = solve(ring, D, of.stress), wider = solve(raised(ring, 1), D, of.stress),
                     exact = solve(raised(ring, 4), D, of.stress);
        const double truth = std::sqrt(difference(coarse, exact)), estimated = std::sqrt(difference(coarse, wider));
        const double effectivity = estimated / truth;
        if (truth < 1e-6 * std::sqrt(2 * energy(exact))) continue;  // near rounding
        EXPECT_GT(effectivity, 0.5) << of.name << ", order " << order;
        EXPECT_LT(effectivity, 1.01) << of.name << ", order " << order;  // 1, but for the quadrature of the tractions
      }
}

TEST(ErrorByTwoOrders, IsTheDifferenceOfEnergies) {  // without contact and loads inside: Galerkin
  const Mat3 D = elasticity(3e7, 0.3);
  for (const Case& of : cases()) {
    const Ring ring = of.ring(2, 2), fine = raised(ring, 1);
    const Vector F = forces(fine, of.stress);
    Vector f(static_cast<Eigen::Index>(2 * ring.nodes.size()));  // P'F: the same load, not integrated anew
    for (Eigen::Index i = 0; i < f.size(); ++i)
      f[i] = F.dot(prolonged(ring.elements, Vector::Unit(f.size(), i), fine.elements, F.size()));
    const Solved coarse = solve(ring, D, f), wider = solve(fine, D, F);
    const double squared = difference(coarse, wider);
    EXPECT_NEAR(squared, 2 * (energy(wider) - energy(coarse)), 1e-8 * squared + 1e-13 * energy(wider)) << of.name;
  }
}

TEST(ErrorByTwoOrders, OfTimoshenkosCantileverIsThatOfItsEnergy) {
  const Ring ring = rectangle_ring(8, 4, 8, 4, 2);
  const Mat3 D = elasticity(3e7, 0.3);
  const Solved coarse = solve(ring, D, cantilever_stress), wider = solve(raised(ring, 1), D, cantilever_stress);
  constexpr double exact = 1e6 * 512 / (6 * 3e7 * 64.0 / 12) + 1e6 * 8 * 1.3 * 16 / (10 * 3e7 * 64.0 / 12);
  EXPECT_NEAR(exact, 0.637333, 5e-7);
  EXPECT_NEAR(difference(coarse, wider), 2 * (exact - energy(coarse)), 1e-5 * (exact - energy(coarse)));
}

TEST(ErrorByTwoOrders, EnergiesOfSectorsSumToTheWholeAndAreLargestWhereStressVariesMost) {
  const Mat3 D = elasticity(3e7, 0.3);
  const Stress stress = [](const Vec2& x) { return kirsch_stress(x + Vec2(2.3, 2.3)); };
  const auto sectors = [&](const Solved& a, const Solved& b) {
    const auto of_a = solve_super_element(a.ring, D, 1.0), of_b = solve_super_element(b.ring, D, 1.0);
    const auto modes_of_a = modal_solution(of_a), modes_of_b = modal_solution(of_b);
    return sector_differences({a.ring, of_a, modes_of_a, a.u}, {b.ring, of_b, modes_of_b, b.u}, D);
  };
  const auto total = [](const std::vector<double>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); };
  double ratio = 0.0;
  for (const int n : {2, 4}) {
    const Ring ring = quarter_with_hole(n, 2);
    const Solved coarse = solve(ring, D, stress), wider = solve(raised(ring, 1), D, stress);
    const std::vector<double> found = sectors(coarse, wider);
    // The common factor is that of the area: 1/2.
    ratio = 0.5 * total(found) / difference(coarse, wider);
    EXPECT_NEAR(ratio, 1.0, 0.1) << n;
    const auto worst = std::max_element(found.begin(), found.end()) - found.begin();
    EXPECT_TRUE(worst == 0 || worst >= 4 * n - 1) << worst;  // the hole, or beside it
  }
}

TEST(ErrorByTwoOrders, IsZeroForFieldsThatTheElementsHold) {
  const Mat3 D = elasticity(3e7, 0.3);
  const Ring ring = quarter_with_hole(2, 2);
  const Stress uniform_stress = [](const Vec2&) { return Vec3(1.0, -2.0, 0.5); };
  const Solved coarse = solve(ring, D, uniform_stress), wider = solve(raised(ring, 1), D, uniform_stress);
  EXPECT_LT(std::sqrt(difference(coarse, wider) / (2 * energy(wider))), 1e-6);
}

}  // namespace
}  // namespace scabo::element
