#include <gtest/gtest.h>

#include <cmath>

#include "scabo/base/error.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::geometry {
namespace {

class LobattoOrder : public testing::TestWithParam<int> {};

TEST_P(LobattoOrder, PointsAreExactlySymmetricAndEndAtOne) {
  const int p = GetParam();
  const std::vector<double> points = lobatto_points(p);
  ASSERT_EQ(points.size(), p + 1u);
  EXPECT_EQ(points.front(), -1.0);
  EXPECT_EQ(points.back(), 1.0);
  for (int i = 0; i <= p; ++i) EXPECT_EQ(points[i], -points[p - i]);
  for (int i = 0; i < p; ++i) EXPECT_LT(points[i], points[i + 1]);
}

TEST_P(LobattoOrder, QuadratureIsExactUpToDegree2pMinus1) {
  const int p = GetParam();
  const LineBasis& basis = LineBasis::of_order(p);
  for (int degree = 0; degree <= 2 * p - 1; ++degree) {
    double sum = 0.0;
    for (int i = 0; i <= p; ++i) sum += basis.weights()[i] * std::pow(basis.points()[i], degree);
    EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0, 4e-15) << "degree " << degree;
  }
}

TEST_P(LobattoOrder, QuadratureIsNotExactForDegree2p) {
  const int p = GetParam();
  const LineBasis& basis = LineBasis::of_order(p);
  double sum = 0.0;
  for (int i = 0; i <= p; ++i) sum += basis.weights()[i] * std::pow(basis.points()[i], 2 * p);
  EXPECT_GT(std::abs(sum - 2.0 / (2 * p + 1)), 1e-11);
}

TEST_P(LobattoOrder, DerivativeAndShapeReproducePolynomials) {
  const int p = GetParam();
  const LineBasis& basis = LineBasis::of_order(p);
  Vector values(p + 1);
  for (int i = 0; i <= p; ++i) values[i] = std::pow(basis.points()[i], p);
  const Vector slopes = basis.derivatives_at_nodes() * values;
  for (int i = 0; i <= p; ++i) EXPECT_NEAR(slopes[i], p * std::pow(basis.points()[i], p - 1), 2e-13 * p * p);

  const std::vector<double> at{-1.0, -0.73, 0.1, 0.5, 1.0};
  const Vector between = basis.values_at(at) * values;
  for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(between[k], std::pow(at[k], p), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(OneToSixteen, LobattoOrder, testing::Range(1, 17));

TEST(LobattoPoints, AgreeWithClosedForms) {
  EXPECT_EQ(lobatto_points(2)[1], 0.0);
  EXPECT_NEAR(lobatto_points(3)[2], 1.0 / std::sqrt(5.0), 1e-16);
  EXPECT_NEAR(lobatto_points(4)[3], std::sqrt(3.0 / 7.0), 2e-16);
  EXPECT_NEAR(lobatto_points(5)[3], std::sqrt((7.0 - 2.0 * std::sqrt(7.0)) / 21.0), 2e-16);
  EXPECT_NEAR(lobatto_points(6)[5], std::sqrt((15.0 + 2.0 * std::sqrt(15.0)) / 33.0), 2e-16);
}

TEST(LobattoPoints, NeedAnOrderOfAtLeastOne) { EXPECT_THROW(lobatto_points(0), BrokenInvariant); }

}  // namespace
}  // namespace scabo::geometry
