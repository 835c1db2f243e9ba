#include "scabo/analysis/growth/criteria.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace scabo::analysis {

namespace {

constexpr double pi = std::numbers::pi, pi2 = pi * pi, pi4 = pi2 * pi2, pi6 = pi4 * pi2;

// Coefficients of F_ij in powers of m = a / pi, even ones of F11 and F22, odd ones of F12 and F21.
constexpr double F11[] = {1.0,
                          -3.0 * pi2 / 8.0,
                          pi2 - 5.0 * pi4 / 128.0,
                          pi2 / 9.0 - 11.0 * pi4 / 72.0 + 119.0 * pi6 / 15360.0,
                          5.07790,
                          -2.88312,
                          -0.0925,
                          2.996,
                          -4.059,
                          1.63,
                          4.1};
constexpr double F12[] = {-3.0 * pi / 2.0,
                          10.0 * pi / 3.0 + pi* pi2 / 16.0,
                          -2.0 * pi - 133.0 * pi* pi2 / 180.0 + 59.0 * pi* pi4 / 1280.0,
                          12.313906,
                          -7.32433,
                          1.5793,
                          4.0216,
                          -6.915,
                          4.21,
                          4.56};
constexpr double F21[] = {pi / 2.0,
                          -4.0 * pi / 3.0 - pi* pi2 / 48.0,
                          -2.0 * pi / 3.0 + 13.0 * pi* pi2 / 30.0 - 59.0 * pi* pi4 / 3840.0,
                          -6.176023,
                          4.44112,
                          -1.5340,
                          -2.0700,
                          4.684,
                          -3.95,
                          -1.32};
constexpr double F22[] = {1.0,
                          -4.0 - 3.0 * pi2 / 8.0,
                          8.0 / 3.0 + 29.0 * pi2 / 18.0 - 5.0 * pi4 / 128.0,
                          -32.0 / 15.0 - 4.0 * pi2 / 9.0 - 1159.0 * pi4 / 7200.0 + 119.0 * pi6 / 15360.0,
                          10.58254,
                          -4.78511,
                          -1.8804,
                          7.280,
                          -7.591,
                          0.25,
                          12.5};

double series(std::span<const double> coefficients, double square) {
  double sum = 0.0;
  for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * square + coefficients[k];
  return sum;
}

/// Where `increases` turns from true to false between two angles; it does so once.
template <typename Increases>
double turning_point(double low, double high, const Increases& increases) {
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (increases(middle) ? low : high) = middle;
  }
}

// The criteria for K_I >= 0 and K_II <= 0, where angles are not negative.

Kink hoop_stress_at_distance(const Vec2& K, double T) {
  const auto stress = [&](double a) {  // eq. (7)
    const double c = std::cos(0.5 * a), s = std::sin(a);
    return c * (K[0] * c * c - 1.5 * K[1] * s) + T * s * s;
  };
  const auto slope = [&](double a) {
    const double c = std::cos(0.5 * a), s = std::sin(0.5 * a);
    return -1.5 * c * c * s * K[0] - 1.5 * K[1] * (c * std::cos(a) - 0.5 * s * std::sin(a)) + T * std::sin(2.0 * a);
  };
  constexpr double degree = pi / 180.0;
  double nearest = 0.0;
  for (int k = 1; k < 180; ++k)
    if (stress(k * degree) > stress(nearest)) nearest = k * degree;
  const double a =
      turning_point(std::max(0.0, nearest - degree), nearest + degree, [&](double at) { return slope(at) > 0.0; });
  return {a, stress(a)};
}

Kink hoop_stress(const Vec2& K, double T) {
  if (T != 0.0) return hoop_stress_at_distance(K, T);
  // eq. (1)
  const double half = std::atan2(-2.0 * K[1], K[0] + std::sqrt(K[0] * K[0] + 8.0 * K[1] * K[1]));
  const double c = std::cos(half);
  return {2.0 * half, c * (K[0] * c * c - 1.5 * K[1] * std::sin(2.0 * half))};
}

Kink energy_release(const Vec2& K) {  // eq. (3)
  constexpr double difference = 1e-4;
  const double angle = turning_point(0.0, 0.5 * pi, [&](double a) {
    return factors_at_kink(K, a + difference).norm() > factors_at_kink(K, a - difference).norm();
  });
  return {angle, factors_at_kink(K, angle).norm()};
}

Kink zero_K_II(const Vec2& K) {  // eq. (4)
  const double angle = turning_point(0.0, 0.5 * pi, [&](double a) { return factors_at_kink(K, a)[1] < 0.0; });
  return {angle, factors_at_kink(K, angle)[0]};
}

Kink strain_energy_density(const Vec2& K, double kappa) {  // eq. (5)
  const double I = K[0] * K[0], mixed = 2.0 * K[0] * K[1], II = K[1] * K[1];
  const auto slope = [&](double a) {
    const double c = std::cos(a), s = std::sin(a);
    return I * s * (2.0 * c - kappa + 1.0) + mixed * (2.0 * std::cos(2.0 * a) - (kappa - 1.0) * c) +
           II * s * (kappa - 1.0 - 6.0 * c);
  };
  constexpr double degree = pi / 180.0;
  double end = degree;
  while (end < pi && slope(end) < 0.0) end += degree;
  const double a = turning_point(0.0, end, [&](double at) { return slope(at) < 0.0; });
  const double c = std::cos(a), s = std::sin(a);
  const double S = I * (1.0 + c) * (kappa - c) + mixed * s * (2.0 * c - kappa + 1.0) +
                   II * ((kappa + 1.0) * (1.0 - c) + (1.0 + c) * (3.0 * c - 1.0));
  return {a, std::sqrt(S / (2.0 * (kappa - 1.0)))};
}

}  // namespace

Vec2 factors_at_kink(const Vec2& factors, double angle) {
  const double m = angle / pi, square = m * m;
  return {series(F11, square) * factors[0] + m * series(F12, square) * factors[1],
          m * series(F21, square) * factors[0] + series(F22, square) * factors[1]};
}

Kink kink_of(model::GrowthCriterion criterion, const TipFactors& factors, double kappa) {
  const double size = factors.K.norm();
  const Vec2 K(factors.K[0] / size, -std::abs(factors.K[1]) / size);
  Kink kink = criterion == model::GrowthCriterion::hoop_stress      ? hoop_stress(K, factors.T / size)
              : criterion == model::GrowthCriterion::energy_release ? energy_release(K)
              : criterion == model::GrowthCriterion::zero_K_II      ? zero_K_II(K)
              : criterion == model::GrowthCriterion::straight       ? Kink{0.0, 1.0}  // eq. (6)
                                                                    : strain_energy_density(K, kappa);
  if (K[1] == 0.0 && factors.T == 0.0) kink.angle = 0.0;
  if (factors.K[1] > 0.0) kink.angle = -kink.angle;
  kink.equivalent *= size;
  return kink;
}

double kink_at(model::GrowthCriterion criterion, const TipFactors& factors, double kappa) {
  const TipFactors open = factors.opened();
  return open.K.norm() > 0.0 ? kink_of(criterion, open, kappa).angle : 0.0;
}

double kink_or_none(double kink) {
  constexpr double least = 1e-4;
  return std::abs(kink) < least ? 0.0 : kink;
}

}  // namespace scabo::analysis
