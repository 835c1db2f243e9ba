// Rates of convergence in the energy norm: |u - u_h|_E ~ h^p for smooth solutions, p the order of the edges.
#include <gtest/gtest.h>

#include <complex>

#include "scabo/element/plane/stiffness.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"
#include "scabo/system/body_system.hpp"
#include "scabo/system/loads.hpp"
#include "theory/rings.hpp"
#include "verification/stress_error.hpp"

namespace scabo::element {
namespace {

using namespace test;

struct ExactField {
  std::function<Vec2(const Vec2&)> displacement;
  std::function<Vec3(const Vec2&)> stress;
  double energy = 0.0;
};

struct Discrete {
  Vector u;
  double energy, reaction;  // reaction: of the constraints, relative to the largest nodal force
};

/// The discrete solution and its strain energy: exact tractions on the whole boundary, three isostatic
/// constraints with the exact displacements at two corners (the first, in x and y, and the last, in x).
Discrete discrete(const Ring& ring, int last_corner, const Mat3& D, const ExactField& exact) {
  const auto solution = solve_super_element(ring, D, 1.0);
  const Vector f = system::traction_forces(
      ring.elements, ring.nodes, 1.0, [&](const Vec2& x, const Vec2& n) { return traction_of(exact.stress(x), n); });
  std::vector<system::Constraint> constraints(3);
  constraints[0].dof = 0;
  constraints[1].dof = 1;
  constraints[2].dof = 2 * last_corner;
  system::Stiffness stiffness;
  stiffness.dense = std::make_shared<const Matrix>(solution.K);
  const auto body = system::elastic_body(stiffness, ring.nodes, constraints);
  const Vec2 first = exact.displacement(ring.nodes[0]);
  const Vec2 last = exact.displacement(ring.nodes[static_cast<std::size_t>(last_corner)]);
  const Vector u = body->displacement(f, Eigen::Vector3d(first.x(), first.y(), last.x()));
  return {u, body->elastic_energy(u), largest(body->reactions(u, f)) / largest(f)};
}

/// Timoshenko's cantilever: L = 8, D = 4, E = 3e7, nu = 0.3, P = 1000, plane stress; sheared parabolically at
/// both ends and clamped by the bending stress at x = 0. Coordinates about the centre.
ExactField timoshenko() {
  constexpr double L = 8, D = 4, E = 3e7, nu = 0.3, P = 1000, I = D * D * D / 12;
  ExactField exact;
  exact.displacement = [](const Vec2& at) {
    const double x = at.x() + 0.5 * L, y = at.y();
    return Vec2(P * y / (6 * E * I) * ((6 * L - 3 * x) * x + (2 + nu) * (y * y - D * D / 4)),
                -P / (6 * E * I) * (3 * nu * y * y * (L - x) + (4 + 5 * nu) * D * D * x / 4 + (3 * L - x) * x * x));
  };
  exact.stress = [](const Vec2& at) {
    const double x = at.x() + 0.5 * L, y = at.y();
    return Vec3(P * (L - x) * y / I, 0.0, -P / (2 * I) * (D * D / 4 - y * y));
  };
  // 1/2 int stress' D^-1 stress: bending and shear.
  exact.energy = P * P * L * L * L / (6 * E * I) + P * P * L * (1 + nu) * D * D / (10 * E * I);
  return exact;
}

TEST(ConvergenceRate, EnergyOfTimoshenkosCantilever) { EXPECT_NEAR(timoshenko().energy, 0.637333, 5e-7); }

/// One row: order of the edges, and the elements along the shorter side of the two meshes compared.
struct Row {
  int order, coarse, fine;
};
std::ostream& operator<<(std::ostream& out, const Row& row) { return out << "order " << row.order; }

class TimoshenkoCantilever : public testing::TestWithParam<Row> {};

TEST_P(TimoshenkoCantilever, ConvergesWithTheOrderOfItsEdges) {
  const Row row = GetParam();
  const int order = row.order, coarse = row.coarse, fine = row.fine;
  const ExactField exact = timoshenko();
  const Mat3 D = elasticity(3e7, 0.3);
  const auto error = [&](int n) {  // in the energy norm, relative
    const Ring ring = rectangle_ring(8, 4, 2 * n, n, order);
    return std::sqrt(1.0 - discrete(ring, 5 * n * order, D, exact).energy / exact.energy);
  };
  if (order >= 3) {  // a cubic solution: exact
    const Ring ring = rectangle_ring(8, 4, 2 * coarse, coarse, order);
    const Discrete result = discrete(ring, 5 * coarse * order, D, exact);
    EXPECT_NEAR(result.energy / exact.energy, 1.0, 1e-12);
    EXPECT_LT(result.reaction, 1e-12);  // the tractions balance
    return;
  }
  const double e_coarse = error(coarse), e_fine = error(fine);
  const double rate = std::log(e_coarse / e_fine) / std::log(static_cast<double>(fine) / coarse);
  RecordProperty("rate", testing::PrintToString(rate));
  EXPECT_NEAR(rate, order, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Orders, TimoshenkoCantilever,
                         testing::Values(Row{1, 8, 16}, Row{2, 4, 8}, Row{3, 1, 2}, Row{4, 1, 2}));

/// A smooth solution that no polynomial meets: phi = exp(c z), psi = exp(d z) in 2 G u = kappa phi - z
/// conj(phi') - conj(psi); its energy from the work of its tractions on a fine boundary.
ExactField exponential(double young, double poisson, double waves = 1.0) {
  using Complex = std::complex<double>;
  const Complex c = waves * Complex(1.2, 1.0), d = waves * Complex(-0.8, 1.4);
  const double G = young / (2 * (1 + poisson)), kappa = (3 - poisson) / (1 + poisson);
  ExactField exact;
  exact.displacement = [=](const Vec2& x) {
    const Complex z(x.x(), x.y());
    const Complex u =
        (kappa * std::exp(c * z) - z * std::conj(c * std::exp(c * z)) - std::conj(std::exp(d * z))) / (2 * G);
    return Vec2(u.real(), u.imag());
  };
  exact.stress = [=](const Vec2& x) {
    const Complex z(x.x(), x.y());
    const double sum = 4.0 * (c * std::exp(c * z)).real();
    const Complex difference = 2.0 * (std::conj(z) * c * c * std::exp(c * z) + d * std::exp(d * z));
    return Vec3(0.5 * (sum - difference.real()), 0.5 * (sum + difference.real()), 0.5 * difference.imag());
  };
  const Ring fine = polygon_ring({{-1.0, -0.8}, {1.2, -0.9}, {0.9, 1.0}, {-0.8, 0.7}}, 8, 12);
  const Vector u = at_nodes(fine.nodes, exact.displacement);
  exact.energy = 0.5 * u.dot(system::traction_forces(fine.elements, fine.nodes, 1.0, [&](const Vec2& x, const Vec2& n) {
    return traction_of(exact.stress(x), n);
  }));
  return exact;
}

class SmoothSolution : public testing::TestWithParam<Row> {};

TEST_P(SmoothSolution, ConvergesWithTheOrderOfItsEdges) {
  const Row row = GetParam();
  const int order = row.order, coarse = row.coarse, fine = row.fine;
  const ExactField exact = exponential(1.0, 0.3);
  const auto error = [&](int n) {
    const Ring ring = polygon_ring({{-1.0, -0.8}, {1.2, -0.9}, {0.9, 1.0}, {-0.8, 0.7}}, n, order);
    return std::sqrt(std::abs(1.0 - discrete(ring, 3 * n * order, elasticity(1.0, 0.3), exact).energy / exact.energy));
  };
  const double e_coarse = error(coarse), e_fine = error(fine);
  const double rate = std::log(e_coarse / e_fine) / std::log(static_cast<double>(fine) / coarse);
  RecordProperty("rate", testing::PrintToString(rate));
  RecordProperty("error", testing::PrintToString(e_fine));
  // Order 4 is not asymptotic yet, 3.88; on finer meshes its error drowns in the rounding of the energy, about 4e-14.
  EXPECT_GT(rate, order - 0.15);
  EXPECT_LT(rate, order + 0.1);
}

INSTANTIATE_TEST_SUITE_P(Orders, SmoothSolution,
                         testing::Values(Row{1, 32, 64}, Row{2, 16, 32}, Row{3, 8, 16}, Row{4, 4, 8}));

// Orders 1 to 8 by the stress itself, in which nothing cancels. Pairs of meshes down to errors of 1e-10.
TEST(StressOfASmoothSolution, ConvergesWithTheOrderOfItsEdges) {
  const ExactField exact = exponential(1.0, 0.3);
  const Mat3 D = elasticity(1.0, 0.3);
  for (const Row& row : {Row{1, 16, 32}, Row{2, 8, 16}, Row{3, 6, 12}, Row{4, 5, 10}, Row{5, 8, 16}, Row{6, 6, 12},
                         Row{7, 5, 10}, Row{8, 3, 6}}) {
    const int order = row.order, coarse = row.coarse, fine = row.fine;
    const auto error = [&](int n) {
      const Ring ring = polygon_ring({{-1.0, -0.8}, {1.2, -0.9}, {0.9, 1.0}, {-0.8, 0.7}}, n, order);
      const auto solution = solve_super_element(ring, D, 1.0);
      const auto modal = modal_solution(solution);
      const Discrete result = discrete(ring, 3 * n * order, D, exact);
      return stress_error(ring, RadialField(solution, modal, result.u), D, exact.stress);
    };
    const double e_coarse = error(coarse), e_fine = error(fine);
    const double rate = std::log2(e_coarse / e_fine);
    std::cout << "order " << order << ": error " << e_fine << ", rate " << rate << "\n";
    EXPECT_GT(rate, order - 0.15) << "order " << order << ", errors " << e_coarse << ", " << e_fine;
    EXPECT_LT(rate, order + 0.15) << "order " << order << ", errors " << e_coarse << ", " << e_fine;
  }
}

}  // namespace
}  // namespace scabo::element
