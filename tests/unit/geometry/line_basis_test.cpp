#include "scabo/geometry/line_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scabo::geometry {
namespace {

TEST(GaussRule, IsExactToTwiceItsPoints) {
  for (int count = 1; count <= 20; ++count) {
    const GaussRule rule = gauss_rule(count);
    double worst = 0.0;
    for (int degree = 0; degree < 2 * count; ++degree) {
      double sum = 0.0;
      for (std::size_t q = 0; q < rule.points.size(); ++q) sum += rule.weights[q] * std::pow(rule.points[q], degree);
      worst = std::max(worst, std::abs(sum - (degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0)));
    }
    EXPECT_LT(worst, 2e-15) << count << " points";
    for (std::size_t q = 1; q < rule.points.size(); ++q) EXPECT_LT(rule.points[q - 1], rule.points[q]);
  }
}

class LineBasisOrder : public testing::TestWithParam<int> {};

TEST_P(LineBasisOrder, InterpolatesAndDifferentiatesPolynomialsExactly) {
  const int order = GetParam();
  const LineBasis& basis = LineBasis::of_order(order);
  ASSERT_EQ(basis.nodes(), order + 1);
  const std::vector<double> nodes = lobatto_points(order);
  for (int i = 0; i <= order; ++i)
    for (int j = 0; j <= order; ++j)
      EXPECT_NEAR(basis.values(nodes[static_cast<std::size_t>(i)])[j], i == j ? 1.0 : 0.0, 1e-13);
  for (double eta : {-1.0, -0.83, 0.0, 0.31, 1.0})
    for (int degree = 0; degree <= order; ++degree) {
      double value = 0.0, slope = 0.0;
      for (int j = 0; j <= order; ++j) {
        const double at_node = std::pow(nodes[static_cast<std::size_t>(j)], degree);
        value += basis.values(eta)[j] * at_node;
        slope += basis.derivatives(eta)[j] * at_node;
      }
      EXPECT_NEAR(value, std::pow(eta, degree), 1e-12);
      EXPECT_NEAR(slope, degree == 0 ? 0.0 : degree * std::pow(eta, degree - 1), 1e-10);
    }
  EXPECT_EQ(basis.values_at_rule().rows(), static_cast<Eigen::Index>(basis.rule().points.size()));
  EXPECT_EQ(Vector(basis.values_at_rule().row(1)), basis.values(basis.rule().points[1]));
  EXPECT_EQ(Vector(basis.derivatives_at_rule().row(1)), basis.derivatives(basis.rule().points[1]));
}

INSTANTIATE_TEST_SUITE_P(Orders, LineBasisOrder, testing::Range(1, 17));

}  // namespace
}  // namespace scabo::geometry
