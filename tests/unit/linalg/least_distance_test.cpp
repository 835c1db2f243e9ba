#include "scabo/linalg/least_distance.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "support/decompositions.hpp"

namespace scabo::linalg {
namespace {

/// Of all points on the planes of some of the conditions, that which keeps all of them and is nearest to `aim`.
Vector nearest_of_all(const Matrix& B, const Vector& h, const Vector& aim) {
  Vector best;
  for (unsigned some = 0; some < (1u << B.rows()); ++some) {
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < B.rows(); ++i)
      if (some & (1u << i)) active.push_back(i);
    Vector v = aim;
    if (!active.empty()) {
      const Matrix held = B(active, Eigen::all);
      v += held.completeOrthogonalDecomposition().solve(h(active) - held * aim);
    }
    const bool kept = (B * v - h).minCoeff() >= -1e-10;
    if (kept && (best.size() == 0 || (v - aim).norm() < (best - aim).norm())) best = v;
  }
  return best;
}

// Also beside conditions that are kept by far, as of joints with a strength that no load reaches.
TEST(LeastDistance, IsThatOfThePlanesOfTheActiveConditions) {
  std::mt19937 random(14);
  std::normal_distribution<double> entry;
  for (int k = 0; k < 300; ++k) {
    const Eigen::Index rows = 2 + k % 6, columns = 1 + k % 4;
    Matrix B = Matrix::NullaryExpr(rows, columns, [&] { return entry(random); });
    B.rowwise().normalize();
    Vector h = -Vector::NullaryExpr(rows, [&] { return std::abs(entry(random)); });  // the origin keeps them
    if (k % 3 == 0) h[0] = 0.0;
    if (k % 2 == 0) h[rows - 1] = -1e15;
    const Vector aim = Vector::NullaryExpr(columns, [&] { return 5.0 * entry(random); });
    const Vector v = nearest_within(B, h, aim), expected = nearest_of_all(B, h, aim);
    ASSERT_EQ(v.size(), columns);
    EXPECT_LT((v - expected).norm(), 1e-9 * (1.0 + aim.norm())) << k;
    EXPECT_GE((B * v - h).minCoeff(), -1e-9) << k;
  }
}

}  // namespace
}  // namespace scabo::linalg
