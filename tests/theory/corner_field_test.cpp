// Exponents and generalised factors of notches and bimaterial corners, where exponents merge too.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "scabo/element/plane/stress_intensity.hpp"
#include "theory/open_rings.hpp"

namespace scabo::element {
namespace {

using namespace test;
using std::numbers::pi;

const Mat3 steel = elasticity(1.0, 0.3, model::Plane::strain);

// Williams' symmetric and antisymmetric singular fields of a notch with free faces, closed form (Muskhelishvili's
// potentials): 2 mu (u + i v) = kappa phi - z conj(phi') - conj(psi), phi = A z^lambda, psi = B z^lambda, about the
// bisector x1.
Vec2 notch_field(const Kolosov& m, double lambda, double half, bool symmetric, double r, double t) {
  using C = std::complex<double>;
  const double sign = symmetric ? 1.0 : -1.0;
  const C unit = symmetric ? C(1, 0) : C(0, 1);
  // Free face at t = half: psi's coefficient from lambda A e^(i(lambda-1)t) ... = 0
  const double ratio = -(lambda * std::cos(2 * half) + sign * std::cos(2 * lambda * half));
  const C phi = unit * std::polar(std::pow(r, lambda), lambda * t), z = std::polar(r, t);
  const C slope = unit * lambda * std::polar(std::pow(r, lambda - 1), (lambda - 1) * t);
  const C psi = unit * ratio * std::polar(std::pow(r, lambda), lambda * t);
  const C w = (m.kappa * phi - z * std::conj(slope) - std::conj(psi)) / (2 * m.mu);
  return {w.real(), w.imag()};
}

// On the bisector s_tt = s_22, s_rt = s_12 of that field: s_22 - s_11 + 2 i s_12 = 2 (conj(z) phi'' + psi'), s_11 +
// s_22 = 4 Re phi'.
Vec2 notch_stress(double lambda, double half, bool symmetric) {
  using C = std::complex<double>;
  const double sign = symmetric ? 1.0 : -1.0;
  const C unit = symmetric ? C(1, 0) : C(0, 1);
  const double ratio = -(lambda * std::cos(2 * half) + sign * std::cos(2 * lambda * half));
  const C slope = unit * lambda, sum = unit * (lambda * (lambda - 1)) + unit * ratio * lambda;
  const C difference = 2.0 * sum;
  return {(4 * slope.real() + difference.real()) / 2, difference.imag() / 2};
}

TEST(CornerField, NotchFactorsOfWilliamsFields) {
  const Kolosov m(1.0, 0.3, model::Plane::strain);
  const double opening = 1.5 * pi, half = 0.75 * pi;
  const Ring ring = sector_ring(-half, opening, {}, pi / 4, 12);  // bisector along x
  const auto solution = solve_super_element(ring, steel, 1.0);
  const CornerAnalysis analysis(ring, steel, solution, 0.2);
  const double lambda[2] = {analysis.modes().singular[0].T(0, 0), analysis.modes().singular[1].T(0, 0)};
  for (const bool symmetric : {true, false}) {
    const double power = lambda[symmetric ? 0 : 1];
    const Vector u = at_nodes(ring.nodes, [&](const Vec2& x) {
      return notch_field(m, power, half, symmetric, x.norm(), std::atan2(x.y(), x.x()));
    });
    const StressIntensity found = analysis.of(u);
    ASSERT_EQ(found.kind, CornerKind::corner);
    ASSERT_EQ(found.terms.size(), 2u);
    const Vec2 expected = std::sqrt(2 * pi) * notch_stress(power, half, symmetric);
    const std::size_t own = symmetric ? 0 : 1;
    EXPECT_LT((*found.terms[own].limit - expected).norm(), 1e-8 * expected.norm());
    EXPECT_LT(found.terms[1 - own].limit->norm(), 1e-8 * expected.norm());
    EXPECT_NEAR(found.K_I, expected[0] * std::pow(0.2, power - 0.5), 1e-8);
    EXPECT_NEAR(found.K_II, expected[1] * std::pow(0.2, power - 0.5), 1e-8);
    EXPECT_FALSE(found.G.has_value());
  }
}

// A crack is a notch of 360 degrees: on the ray ahead the generalised factors are K_I and K_II at any distance.
TEST(CornerField, OfACrackAreItsStressIntensityFactors) {
  const Kolosov m(1.0, 0.3, model::Plane::strain);
  const Ring ring = cracked_square(1, 12, 0.5);
  const Vector u = around_tip(ring, [&](double r, double t) { return williams(m, 1.5, -0.4, 0.2, r, t); });
  const auto modes = singular_modes(solve_super_element(ring, steel, 1.0));
  for (const double angle : {pi, pi - 0.3, pi + 0.5}) {  // s_tt, s_rt of Williams' field
    const double t = angle - pi, c = std::cos(t / 2), s = std::sin(t / 2);
    const Vec2 expected(1.5 * c * c * c + 0.4 * 3 * s * c * c, 1.5 * s * c * c - 0.4 * c * (1 - 3 * s * s));
    for (const double r : {1.0, 1e-3}) {
      Vec2 sum = Vec2::Zero();
      for (const ModeGroup& group : modes.singular)
        sum += generalised_factors(ray_traction({ring, steel}, group, angle), group, group.Q * u, r);
      EXPECT_LT((sum - expected).norm(), 1e-8) << angle << " " << r;
    }
  }
}

// Tractions by the equilibrium of an element gain twice the digits that raw stress does for each order.
TEST(CornerField, TractionsOnRaysConvergeWithTwiceTheOrder) {
  const double half = 0.75 * pi;
  double errors[2];
  for (int i : {0, 1}) {
    const Ring ring = sector_ring(-half, 1.5 * pi, {}, pi / (8 << i), 2);
    const auto modes = singular_modes(solve_super_element(ring, steel, 1.0));
    const ModeGroup& group = modes.singular.front();
    const RayTraction ray = ray_traction({ring, steel}, group, half);
    // s_tt on the bisector for a unit opening of the faces: free of the mode's own scale.
    const double opening = group.Phi(group.Phi.rows() - 1, 0) - group.Phi(1, 0);
    const Kolosov m(1.0, 0.3, model::Plane::strain);
    const double lambda = 0.54448373678;
    const double exact =
        notch_stress(lambda, half, true)[0] /
        (notch_field(m, lambda, half, true, 1.0, half) - notch_field(m, lambda, half, true, 1.0, -half)).y();
    errors[i] = std::abs(ray.F(0, 0) / opening / exact - 1.0);
  }
  RecordProperty("errors", testing::PrintToString(errors));
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3.7);
  EXPECT_LT(errors[1], 1e-4);
}

/// Two materials on the angles [0, first] and [first, first + second].
struct Wedges {
  Ring ring;
  Elasticity D;
};
Wedges wedges(double ratio, double first, double second) {
  Ring ring = sector_ring(0.0, first + second, {first}, 0.7, 10);
  std::vector<Mat3> laws;
  for (const double angle : middle_angles(ring))
    laws.push_back(elasticity(angle < first ? ratio : 1.0, 0.3, model::Plane::strain));
  return {std::move(ring), Elasticity(std::move(laws))};
}

/// The two lowest exponents.
std::vector<std::complex<double>> lowest(double ratio, double first, double second) {
  const Wedges w = wedges(ratio, first, second);
  auto values = modal_solution(solve_super_element(w.ring, w.D, 1.0)).exponents;
  return {values[2], values[3]};
}

// Between a real pair and a complex one the exponents merge, and the field gets a logarithm. What the factors say there
// must be what they say a little to either side, however ill-conditioned the single modes are.
TEST(CornerField, FactorsAreContinuousWhereExponentsMerge) {
  const double ratio = 10.0, first = pi;
  double real = 0.5 * pi, complex = pi;  // second wedge
  ASSERT_EQ(lowest(ratio, first, real)[0].imag(), 0.0);
  ASSERT_NE(lowest(ratio, first, complex)[0].imag(), 0.0);
  for (int halving = 0; halving < 45; ++halving) {
    const double middle = 0.5 * (real + complex);
    const auto values = lowest(ratio, first, middle);
    (values[0].imag() == 0.0 ? real : complex) = middle;
  }
  const auto merged = lowest(ratio, first, real);
  EXPECT_LT(std::abs(merged[0] - merged[1]), 1e-5);
  EXPECT_LT(merged[1].real(), 0.99);
  RecordProperty("angle", testing::PrintToString(real * 180 / pi));
  RecordProperty("exponent", testing::PrintToString(merged[0].real()));

  const auto factors = [&](double second) {
    const Wedges w = wedges(ratio, first, second);
    const auto solution = solve_super_element(w.ring, w.D, 1.0);
    const CornerAnalysis analysis(w.ring, w.D, solution, 0.3);
    const Vector u = at_nodes(
        w.ring.nodes, [](const Vec2& x) { return Vec2(0.3 * x.x() - x.y() * x.y(), x.x() + 0.5 * x.y() * x.x()); });
    return analysis.of(u);
  };
  const StressIntensity there = factors(real);
  ASSERT_FALSE(there.terms.empty());
  EXPECT_EQ(there.terms.front().exponents.size(), 2u);
  EXPECT_TRUE(there.terms.front().defective);
  const double size = std::hypot(there.K_I, there.K_II);
  for (const double step : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const StressIntensity below = factors(real - step), above = factors(real + step);
    for (const auto& [one, other] : {std::pair(below, there), std::pair(above, there)}) {
      EXPECT_NEAR(one.K_I, other.K_I, (10.0 * step + 1e-10) * size) << step;
      EXPECT_NEAR(one.K_II, other.K_II, (10.0 * step + 1e-10) * size) << step;
    }
  }
}

// xi^T of the small block against the propagation of the whole S, which knows of no groups.
TEST(CornerField, TheSingularPartStaysItselfOnTheWayToTheCentre) {
  const Wedges w = wedges(10.0, pi, 2.2);
  const auto solution = solve_super_element(w.ring, w.D, 1.0);
  const auto modes = singular_modes(solution);
  const ModalSolution modal = modal_solution(solution);
  ASSERT_FALSE(modes.singular.empty());
  for (const ModeGroup& group : modes.singular) {
    const Vector c = Vector::LinSpaced(group.size(), 1.0, -0.5), u = group.Phi * c;
    EXPECT_LT((group.Q * u - c).norm(), 1e-11 * group.projection_norm);
    const RadialField field(solution, modal, u);
    for (const double xi : {0.5, 1e-2, 1e-5}) {
      const Vector expected = group.displacement(xi, c);
      EXPECT_LT((field.at(xi).u - expected).norm(), 1e-9 * u.norm() * std::pow(xi, modal.slowest)) << xi;
    }
  }
}

}  // namespace
}  // namespace scabo::element
