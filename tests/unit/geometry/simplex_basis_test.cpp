#include "scabo/geometry/simplex_basis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace scabo::geometry {
namespace {

/// int prod lambda_i^a_i over the simplex, divided by its measure: d! prod a_i! / (d + sum a_i)!.
double mean_of_powers(const Eigen::VectorXi& a) {
  const auto d = static_cast<double>(a.size() - 1);
  double value = std::tgamma(d + 1.0) / std::tgamma(d + a.sum() + 1.0);
  for (const int power : a) value *= std::tgamma(power + 1.0);
  return value;
}

class Simplices : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  const SimplexBasis& basis = SimplexBasis::of(GetParam().first, GetParam().second);
};

TEST_P(Simplices, RuleIsExactUpToDegreeThree) {
  const int d = basis.dimension();
  const SimplexRule& rule = basis.rule();
  for (int i = 0; i <= d; ++i)
    for (int j = 0; j <= d; ++j)
      for (int k = 0; k <= d; ++k) {
        Eigen::VectorXi powers = Eigen::VectorXi::Zero(d + 1);
        ++powers[i], ++powers[j], ++powers[k];
        double mean = 0.0;
        for (Eigen::Index p = 0; p < rule.weights.size(); ++p)
          mean += rule.weights[p] * rule.points(i, p) * rule.points(j, p) * rule.points(k, p);
        EXPECT_NEAR(mean, mean_of_powers(powers), 1e-15);
      }
  EXPECT_NEAR(rule.weights.sum(), 1.0, 1e-15);
  EXPECT_GT(rule.weights.minCoeff(), 0.0);
}

/// So the order of the corners of an element does not count, where its integrals are not exact either.
TEST_P(Simplices, RuleIsTheSameForEveryOrderOfCorners) {
  const SimplexRule& rule = basis.rule();
  std::vector<int> order(static_cast<std::size_t>(basis.dimension() + 1));
  std::iota(order.begin(), order.end(), 0);
  while (std::next_permutation(order.begin(), order.end()))
    for (Eigen::Index p = 0; p < rule.weights.size(); ++p) {
      const Vector moved = rule.points(order, p);
      double weight = 0.0;
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
        if ((rule.points.col(q) - moved).lpNorm<Eigen::Infinity>() < 1e-15) weight += rule.weights[q];
      EXPECT_EQ(weight, rule.weights[p]);
    }
}

TEST_P(Simplices, ShapeFunctionsAreOneAtTheirNodes) {
  for (int node = 0; node < basis.nodes(); ++node) {
    Vector lambda = Vector::Zero(basis.dimension() + 1);
    if (node <= basis.dimension())
      lambda[node] = 1.0;
    else
      for (const int corner : basis.edges()[static_cast<std::size_t>(node - basis.dimension() - 1)])
        lambda[corner] = 0.5;
    EXPECT_LT((basis.values(lambda) - Vector::Unit(basis.nodes(), node)).lpNorm<Eigen::Infinity>(), 1e-16);
  }
}

TEST_P(Simplices, DerivativesAreThoseOfTheValues) {
  Vector lambda = Vector::LinSpaced(basis.dimension() + 1, 1.0, 2.0);
  lambda /= lambda.sum();
  const Matrix derivatives = basis.derivatives(lambda);
  EXPECT_LT(derivatives.colwise().sum().lpNorm<Eigen::Infinity>(), 1e-15);  // of 1
  constexpr double step = 1e-3;  // central differences of parabolas are exact
  for (int k = 0; k < basis.dimension(); ++k) {
    Vector along = Vector::Zero(lambda.size());
    along[k + 1] = step, along[0] = -step;
    const Vector difference = (basis.values(lambda + along) - basis.values(lambda - along)) / (2.0 * step);
    EXPECT_LT((derivatives.col(k) - difference).lpNorm<Eigen::Infinity>(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Simplices,
                         testing::Values(std::pair(2, 3), std::pair(2, 6), std::pair(3, 4), std::pair(3, 10)));

}  // namespace
}  // namespace scabo::geometry
