#include "scabo/linalg/schur_exponential.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "support/long_double.hpp"

namespace scabo::linalg {
namespace {

using test::LongMatrix;

/// psi(s) for psi' = T psi - e^(2s) w by the dense exponential of [[T, -w], [0, 2]], in long double.
Vector oracle(const Matrix& T, const Vector& c, const Vector& w, double s) {
  const Eigen::Index n = T.rows();
  LongMatrix augmented = LongMatrix::Zero(n + 1, n + 1);
  augmented.topLeftCorner(n, n) = T.cast<long double>();
  augmented.topRightCorner(n, 1) = -w.cast<long double>();
  augmented(n, n) = 2.0L;
  const LongMatrix exponential = test::long_double::exponential(augmented * static_cast<long double>(s));
  return (exponential.topLeftCorner(n, n) * c.cast<long double>() + exponential.topRightCorner(n, 1)).cast<double>();
}

void expect_agrees(const Matrix& S, double tolerance) {
  const SchurExponential schur(S);
  const Eigen::Index n = S.rows();
  EXPECT_LT((schur.U() * schur.T() * schur.U().transpose() - S).norm(), 1e-13 * S.norm());
  EXPECT_LT((schur.U() * schur.U().transpose() - Matrix::Identity(n, n)).norm(), 1e-13);
  ASSERT_EQ(static_cast<Eigen::Index>(schur.eigenvalues().size()), n);
  std::complex<double> trace = 0.0;
  for (const auto& eigenvalue : schur.eigenvalues()) trace += eigenvalue;
  EXPECT_NEAR(trace.real(), S.trace(), 1e-12 * S.norm());
  EXPECT_EQ(trace.imag(), 0.0);

  const Vector c = Vector::LinSpaced(n, -1.0, 2.0), w = Vector::LinSpaced(n, 1.0, -0.5);
  const std::vector<double> times{0.0,   -2.3,  -1e-3, -2e-3, -0.1,
                                  -5e-3, -0.01, -0.3,  -0.7,  -6.9};  // two share a contour
  for (const Vector& load : {Vector(Vector::Zero(n)), w}) {
    const Matrix together = schur.propagate(c, {{2.0, -load}}, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double s = times[i];
      const Vector expected = oracle(schur.T(), c, load, s), psi = schur.propagate(c, {{2.0, -load}}, s);
      EXPECT_LT((psi - expected).norm(), tolerance * (c.norm() + load.norm())) << "s = " << s;
      EXPECT_LT((together.col(static_cast<Eigen::Index>(i)) - expected).norm(), tolerance * (c.norm() + load.norm()))
          << "s = " << s << " with others";
    }
  }
}

TEST(SchurExponential, DefectiveEigenvalue) {
  Matrix S(2, 2);
  S << 1.0, 1.0, 0.0, 1.0;  // exp(S s) = e^s [[1, s], [0, 1]]
  expect_agrees(S, 1e-13);
  const SchurExponential schur(S);
  const double s = -1.5;
  const Vector psi = schur.U() * schur.propagate(schur.U().transpose() * Vector(Eigen::Vector2d(0, 1)), {}, s);
  EXPECT_NEAR(psi[0], std::exp(s) * s, 1e-14);
  EXPECT_NEAR(psi[1], std::exp(s), 1e-14);
}

TEST(SchurExponential, NearlyDefectiveAndRepeated) {
  Matrix S(4, 4);
  S << 1.0, 1.0, 0.0, 0.0, 1e-12, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0;
  expect_agrees(S, 1e-13);
  expect_agrees(Matrix::Identity(5, 5), 1e-13);
}

TEST(SchurExponential, ComplexPairsWithinTheSector) {
  Matrix S(4, 4);  // 2 +- 2i and 1 +- 0.5i, coupled
  S << 2.0, -2.0, 0.3, 0.1, 2.0, 2.0, -0.4, 0.2, 0.0, 0.0, 1.0, -0.25, 0.0, 0.0, 1.0, 1.0;
  expect_agrees(S, 1e-13);
  const SchurExponential schur(S);
  double largest = 0.0;
  for (const auto& value : schur.eigenvalues()) largest = std::max(largest, value.imag());
  EXPECT_NEAR(largest, 2.0, 1e-13);
}

TEST(SchurExponential, OutsideTheSectorByTheDenseExponential) {
  Matrix S(3, 3);  // 1 +- 5i: 79 degrees
  S << 1.0, -5.0, 0.3, 5.0, 1.0, -0.2, 0.0, 0.0, 3.0;
  expect_agrees(S, 1e-13);
}

// Pairs 1.2 +- 3i, 1.5 +- 8i ... up to 90 degrees from the axis once a shift is taken off, as those of slender and
// graded super-elements. Each size is the least for which another contour is cheaper than the dense exponential.
TEST(SchurExponential, ManyPairsNearTheImaginaryAxis) {
  std::mt19937 random(5);
  std::normal_distribution<double> entry;
  for (const auto& [n, imaginary] : {std::pair(32, 1.5), std::pair(60, 2.6), std::pair(152, 6.0)}) {
    Matrix S = Matrix::NullaryExpr(n, n, [&] { return 0.02 * entry(random); });
    S.triangularView<Eigen::StrictlyLower>().setZero();
    for (int i = 0; i < n; i += 2) {
      const double part = static_cast<double>(i) / n;
      S(i, i) = S(i + 1, i + 1) = 1.2 + 30.0 * part * part;
      S(i, i + 1) = imaginary * (1.0 + part), S(i + 1, i) = -imaginary * (1.0 + part);
    }
    const SchurExponential schur(S);
    const Vector c = Vector::LinSpaced(n, -1.0, 2.0), w = Vector::LinSpaced(n, 1.0, -0.5);
    const double shift = 1.0;
    for (const double s : {-0.7, -3.0}) {
      const Vector expected = std::exp(-shift * s) * oracle(schur.T(), c, w, s);
      EXPECT_LT((schur.propagate(c, {{2.0, -w}}, s, shift) - expected).norm(), 1e-12 * c.norm()) << n << ", s = " << s;
    }
  }
}

TEST(SchurExponential, RandomMatricesFarFromNormal) {
  std::mt19937 random(12);
  std::normal_distribution<double> entry;
  for (int n : {1, 2, 3, 8, 30}) {
    Matrix S = Matrix::NullaryExpr(n, n, [&] { return entry(random); });
    S = S * 0.2 + Matrix(Vector::LinSpaced(n, 1.0, 3.0 + n).asDiagonal());
    S.triangularView<Eigen::StrictlyUpper>() *= 5.0;
    expect_agrees(S, 1e-11);
  }
}

// Exponents of a finely divided boundary reach thousands: what has decayed is zero, not noise.
TEST(SchurExponential, FastModesVanish) {
  const Vector exponents = (Vector(5) << 1.0, 2.0, 50.0, 1e3, 1e4).finished();
  const SchurExponential schur(Matrix(exponents.asDiagonal()));
  const Vector c = Vector::Ones(5), psi = schur.propagate(c, {}, -1.0);
  double worst = 0.0;
  for (Eigen::Index i = 0; i < 5; ++i)  // the Schur form may have reordered them
    worst = std::max(worst, std::abs(psi[i] - std::exp(-schur.T()(i, i))));
  EXPECT_LT(worst, 1e-13);
}

// The same at many times that share a contour, from the longest to its 64th part, towards both sides: every entry is
// that of the exact exponential. The slowest exponent, taken off, leaves a constant.
TEST(SchurExponential, ManyTimesShareAContour) {
  Vector exponents(40);
  for (Eigen::Index i = 0; i < 40; ++i) exponents[i] = std::pow(10.0, 0.1 * static_cast<double>(i));
  std::vector<double> times;
  for (int k = 0; k <= 24; ++k) times.push_back(-3.2 * std::pow(64.0, -k / 24.0));
  for (const double side : {1.0, -1.0}) {
    const SchurExponential schur(Matrix((side * exponents).asDiagonal()));
    std::vector<double> s;
    for (const double time : times) s.push_back(side * time);
    const Matrix psi = schur.propagate(Vector::Ones(40), {}, s, side);
    for (Eigen::Index j = 0; j < psi.cols(); ++j)
      for (Eigen::Index i = 0; i < 40; ++i) {
        const double exact = std::exp((schur.T()(i, i) - side) * s[static_cast<std::size_t>(j)]);
        EXPECT_NEAR(psi(i, j), exact, 1e-14) << "exponent " << schur.T()(i, i) << ", s = " << s[j];
      }
  }
}

// Pairs at 50 degrees from the axis, each turned by itself.
TEST(SchurExponential, ManyTimesShareAWiderContour) {
  Matrix S = Matrix::Zero(12, 12);
  Vector c = Vector::Zero(12);
  std::vector<double> s;
  for (int k = 0; k <= 12; ++k) s.push_back(-1.5 * std::pow(16.0, -k / 12.0));
  for (Eigen::Index i = 0; i < 12; i += 2) {
    const double a = std::pow(3.0, static_cast<double>(i) / 2.0), b = a * std::tan(50.0 / 57.29577951308232);
    S.block<2, 2>(i, i) << a, -b, b, a;
    c[i] = 1.0;
  }
  const SchurExponential schur(S);
  const Matrix psi = schur.U() * schur.propagate(schur.U().transpose() * c, {}, s);
  for (Eigen::Index j = 0; j < psi.cols(); ++j)
    for (Eigen::Index i = 0; i < 12; i += 2) {
      const double time = s[static_cast<std::size_t>(j)], decayed = std::exp(S(i, i) * time);
      EXPECT_NEAR(psi(i, j), decayed * std::cos(S(i + 1, i) * time), 3e-14);
      EXPECT_NEAR(psi(i + 1, j), decayed * std::sin(S(i + 1, i) * time), 3e-14);
    }
}

// The exponent of the body force, 2, may be an exponent of S too: psi = e^(2s) (c - s w).
TEST(SchurExponential, ResonanceWithTheBodyForce) {
  Matrix S = Matrix::Constant(1, 1, 2.0);
  const SchurExponential schur(S);
  const Vector c = Vector::Constant(1, 0.3), w = Vector::Constant(1, 0.7);
  for (double s : {-0.01, -1.0, -5.0})
    EXPECT_NEAR(schur.propagate(c, {{2.0, -w}}, s)[0], std::exp(2 * s) * (0.3 - s * 0.7), 1e-14);
}

TEST(SchurExponential, OfNothing) { EXPECT_EQ(SchurExponential(Matrix(0, 0)).propagate(Vector(), {}, -1.0).size(), 0); }

}  // namespace
}  // namespace scabo::linalg
