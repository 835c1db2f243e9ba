// Stress intensity factors, T-stress and energy release rate of exact crack-tip fields, given on the boundary of a
// super-element: what goes in must come out.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "scabo/element/plane/stress_intensity.hpp"
#include "theory/open_rings.hpp"

namespace scabo::element {
namespace {

using namespace test;
using std::numbers::pi;

StressIntensity factors_of(const Ring& ring, const Elasticity& D, const Vector& u,
                           std::optional<double> length = std::nullopt) {
  return CornerAnalysis(ring, D, solve_super_element(ring, D, 1.0), length).of(u);
}

void expect_factors(const StressIntensity& found, double K_I, double K_II, double tolerance) {
  const double size = std::hypot(K_I, K_II);
  EXPECT_NEAR(found.K_I, K_I, tolerance * size);
  EXPECT_NEAR(found.K_II, K_II, tolerance * size);
  EXPECT_NEAR(*found.J, *found.G, tolerance * *found.G);
}

Mat3 orthotropic(double E1, double E2, double G12, double nu12, double angle) {
  Mat3 compliance;
  compliance << 1 / E1, -nu12 / E1, 0, -nu12 / E1, 1 / E2, 0, 0, 0, 1 / G12;
  return rotated_elasticity(compliance.inverse(), -angle);
}

TEST(CrackField, IsotropicWilliamsTermsComeBack) {
  for (const auto plane : {model::Plane::stress, model::Plane::strain})
    for (const double angle : {0.0, 0.7, -2.5}) {
      const Kolosov m(3.0, 0.3, plane);
      const Ring ring = cracked_square(1, 10, angle, 2.0);
      const Vector u = around_tip(ring, [&](double r, double t) { return williams(m, 2.0, -0.7, 0.9, r, t); });
      const StressIntensity found = factors_of(ring, elasticity(3.0, 0.3, plane), u);
      ASSERT_EQ(found.kind, CornerKind::crack);
      EXPECT_EQ(found.epsilon, 0.0);
      expect_factors(found, 2.0, -0.7, 1e-9);
      EXPECT_NEAR(*found.T_left, 0.9, 1e-9);
      EXPECT_NEAR(*found.T_right, 0.9, 1e-9);
      EXPECT_NEAR(*found.G, (4.0 + 0.49) / m.young, 1e-9);  // Irwin
    }
}

TEST(CrackField, OrthotropicFieldComesBack) {
  for (const double axes : {0.0, 0.5, 1.2}) {
    const Mat3 D = orthotropic(10.0, 1.0, 0.6, 0.25, axes), a = D.inverse();
    const Ring ring = cracked_square(2, 10);
    const double T = 0.4;
    const Vector u = around_tip(ring, [&](double r, double t) {
      const Vec2 x(r * std::cos(t), r * std::sin(t));
      return Vec2(sih_paris_irwin(a, 1.0, 0.6, r, t) + T * Vec2(a(0, 0) * x.x() + a(0, 2) * x.y(), a(0, 1) * x.y()));
    });
    const StressIntensity found = factors_of(ring, D, u);
    expect_factors(found, 1.0, 0.6, 1e-9);
    EXPECT_NEAR(*found.T_left, T, 1e-8);
  }
}

TEST(CrackField, InterfaceCrackComesBackWithItsReferenceLength) {
  for (const double ratio : {2.0, 10.0, 1000.0, 0.1})
    for (const double length : {1.0, 0.01}) {
      const Kolosov above(ratio, 0.3, model::Plane::strain), below(1.0, 0.3, model::Plane::strain);
      const Ring ring = cracked_square(1, 12);
      std::vector<Mat3> D;
      for (double angle : middle_angles(ring))
        D.push_back(elasticity(angle < pi ? 1.0 : ratio, 0.3, model::Plane::strain));
      const double e11 = 0.3;
      const Vector u = around_tip(ring, [&](double r, double t) {
        return interface_crack(above, below, {1.0, 0.5}, length, e11, r, t);
      });
      const StressIntensity found = factors_of(ring, D, u, length);
      ASSERT_EQ(found.kind, CornerKind::interface_crack);
      EXPECT_NEAR(found.epsilon, interface_epsilon(above, below), 1e-13);
      expect_factors(found, 1.0, 0.5, 1e-9);
      EXPECT_NEAR(*found.T_left, e11 * above.young, 1e-9 * e11 * above.young);
      EXPECT_NEAR(*found.T_right, e11 * below.young, 1e-9 * e11 * below.young);
      // 1/E* (K_I^2 + K_II^2) / cosh^2(pi eps), Hutchinson and Suo 1992
      const double e_star = 2.0 / (1 / above.young + 1 / below.young), cosine = std::cosh(pi * found.epsilon);
      EXPECT_NEAR(*found.G, 1.25 / (e_star * cosine * cosine), 1e-9 * *found.G);
    }
}

// No closed form: the traction ahead, from the equilibrium of an element, against the opening behind, from the nodes.
// The reference length and the direction of the oscillation must agree.
TEST(CrackField, BetweenAnisotropicHalvesTheTractionAheadBelongsToTheOpeningBehind) {
  const Mat3 above = orthotropic(10.0, 1.0, 0.6, 0.25, 0.4), below = orthotropic(1.0, 3.0, 0.5, 0.1, -1.0);
  for (const double angle : {0.0, 1.1}) {
    const Ring ring = cracked_square(2, 10, angle);
    std::vector<Mat3> D;
    for (double at : middle_angles(ring)) D.push_back(rotated_elasticity(at < pi ? below : above, -angle));
    const Vector u = around_tip(ring, [](double r, double t) { return Vec2(r * t, std::cos(t) + 0.3 * t * r); });
    const Elasticity law(D);
    const auto solution = solve_super_element(ring, law, 1.0);
    for (const double length : {1.0, 0.05}) {
      const CornerAnalysis analysis(ring, law, solution, length);
      const StressIntensity found = analysis.of(u);
      ASSERT_EQ(found.kind, CornerKind::interface_crack);
      ASSERT_EQ(analysis.modes().singular.size(), 1u);
      const ModeGroup& group = analysis.modes().singular.front();
      EXPECT_NEAR(group.exponents[0].real(), 0.5, 1e-9);
      EXPECT_NEAR(std::abs(group.exponents[0].imag()), std::abs(found.epsilon), 1e-9);
      EXPECT_GT(std::abs(found.epsilon), 0.01);
      const Vec2 ahead = generalised_factors(ray_traction({ring, law}, group, pi), group, group.Q * u, length);
      const double size = std::hypot(found.K_I, found.K_II);
      EXPECT_NEAR(ahead[0], found.K_I, 1e-8 * size);
      EXPECT_NEAR(ahead[1], found.K_II, 1e-8 * size);
      EXPECT_NEAR(*found.J, *found.G, 1e-4 * *found.G);  // of a field that the boundary resolves less well
    }
  }
}

// The factors are tensors: the same body turned has the same.
TEST(CrackField, TheFrameIsTheCracks) {
  const Mat3 D = orthotropic(4.0, 1.0, 0.6, 0.25, 0.4);
  const auto field = [](double r, double t) { return Vec2(r * t, std::cos(t) + 0.3 * t * r); };
  const Ring here = cracked_square(2, 6), there = cracked_square(2, 6, 2.0);
  const StressIntensity a = factors_of(here, D, around_tip(here, field)),
                        b = factors_of(there, rotated_elasticity(D, -2.0), around_tip(there, field));
  const double size = std::hypot(a.K_I, a.K_II);
  EXPECT_NEAR(a.K_I, b.K_I, 1e-11 * size);
  EXPECT_NEAR(a.K_II, b.K_II, 1e-11 * size);
  EXPECT_NEAR(*a.T_left, *b.T_left, 1e-10 * size);
  EXPECT_NEAR(*a.J, *b.J, 1e-10 * *a.J);
}

}  // namespace
}  // namespace scabo::element
