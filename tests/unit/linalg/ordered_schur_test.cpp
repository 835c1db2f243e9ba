// Ordered Schur form and spectral projections. Oracle: the resolvent integrated around the group, which knows nothing
// of Schur forms: P = 1 / (2 pi i) int (z - S)^-1 dz.
#include "scabo/linalg/ordered_schur.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "support/decompositions.hpp"

namespace scabo::linalg {
namespace {

Matrix projection_by_contour(const Matrix& S, std::complex<double> centre, double radius) {
  constexpr int points = 400;
  Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(S.rows(), S.cols());
  for (int k = 0; k < points; ++k) {
    const std::complex<double> direction = std::polar(radius, 2.0 * std::numbers::pi * (k + 0.5) / points);
    const Eigen::MatrixXcd shifted = (centre + direction) * Eigen::MatrixXcd::Identity(S.rows(), S.cols()) - S;
    sum += direction / static_cast<double>(points) * test::complex_inverse(shifted);
  }
  return sum.real();
}

Matrix random_basis(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> entry;
  return Matrix::NullaryExpr(n, n, [&] { return entry(random); }) + 2.0 * Matrix::Identity(n, n);
}

void expect_subspace(const Matrix& S, const InvariantSubspace& part, double tolerance) {
  const double size = S.norm() * part.projection_norm;
  EXPECT_LT((S * part.V - part.V * part.T).norm(), tolerance * size * part.V.norm());
  EXPECT_LT((part.Q * S - part.T * part.Q).norm(), tolerance * size * part.Q.norm());
  EXPECT_LT((part.Q * part.V - Matrix::Identity(part.T.rows(), part.T.rows())).norm(),
            tolerance * part.projection_norm);
}

int below_two(std::complex<double> value) { return value.real() < 2.0 ? 0 : 1; }

TEST(OrderedSchur, GroupsComeInOrderAndKeepTheMatrix) {
  const Vector diagonal = (Vector(8) << 5.2, 1.2, 7.2, 0.5, 3.2, 1.5, 9.2, 0.7).finished();
  const Matrix X = random_basis(8, 3), S = X * diagonal.asDiagonal() * test::inverse(X);
  const OrderedSchur schur(S, [](std::complex<double> z) { return static_cast<int>(z.real()); });
  EXPECT_LT((schur.U() * schur.T() * schur.U().transpose() - S).norm(), 1e-13 * S.norm());
  for (std::size_t i = 1; i < 8; ++i)
    EXPECT_LE(std::floor(schur.eigenvalues()[i - 1].real()), std::floor(schur.eigenvalues()[i].real()));
  for (int group : {0, 1, 3, 9}) expect_subspace(S, schur.group(group), 1e-12);
  EXPECT_EQ(schur.group(0).V.cols(), 2);
  EXPECT_EQ(schur.group(2).V.cols(), 0);
}

TEST(SpectralProjection, OfADefectiveEigenvalueIsThatOfTheResolvent) {
  Matrix J = Matrix::Zero(7, 7);
  J.diagonal() << 3.0, 0.5, 0.5, 0.5, 4.0, 2.5, 6.0;
  J(1, 2) = J(2, 3) = 1.0;
  const Matrix X = random_basis(7, 5), S = X * J * test::inverse(X);
  const InvariantSubspace part = OrderedSchur(S, below_two).group(0);
  ASSERT_EQ(part.V.cols(), 3);
  expect_subspace(S, part, 1e-12);
  EXPECT_LT((part.V * part.Q - projection_by_contour(S, 0.5, 1.0)).norm(), 1e-11 * part.projection_norm);
  EXPECT_NEAR(part.T.trace(), 1.5, 1e-11);  // though each eigenvalue moves by the cube root of rounding
}

// Eigenvectors of the pair are 1e-9 apart: an inverted matrix of eigenvectors would lose nine digits.
TEST(SpectralProjection, OfANearlyDefectivePairKeepsAllDigits) {
  Matrix J = Matrix::Zero(5, 5);
  J.diagonal() << 4.0, 0.6, 0.6 + 1e-9, 1.0, 3.0;
  J(1, 2) = 1.0;
  const Matrix X = random_basis(5, 7), S = X * J * test::inverse(X);
  const OrderedSchur schur(S, [](std::complex<double> z) { return z.real() < 0.8 ? 0 : z.real() < 1.2 ? 1 : 2; });
  const Matrix exact_first = X.middleCols(1, 2) * test::inverse(X).middleRows(1, 2);
  const Matrix exact_second = X.col(3) * test::inverse(X).row(3);
  const InvariantSubspace first = schur.group(0), second = schur.group(1);
  EXPECT_LT((first.V * first.Q - exact_first).norm(), 1e-12 * exact_first.norm());
  EXPECT_LT((second.V * second.Q - exact_second).norm(), 1e-12 * exact_second.norm());
  Matrix sum = Matrix::Zero(5, 5);
  for (int g : {0, 1, 2}) sum += schur.group(g).V * schur.group(g).Q;
  EXPECT_LT((sum - Matrix::Identity(5, 5)).norm(), 1e-12);
}

TEST(SpectralProjection, KeepsComplexPairsWhole) {
  Matrix J = Matrix::Zero(6, 6);
  J.diagonal() << 3.0, 0.5, 0.5, 5.0, 2.0, 2.0;
  J(1, 2) = 0.08, J(2, 1) = -0.08, J(4, 5) = 1.0, J(5, 4) = -1.0;
  const Matrix X = random_basis(6, 9), S = X * J * test::inverse(X);
  const InvariantSubspace part =
      OrderedSchur(S, [](std::complex<double> z) { return z.real() < 1.0 ? 0 : 1; }).group(0);
  ASSERT_EQ(part.V.cols(), 2);
  expect_subspace(S, part, 1e-12);
  EXPECT_NEAR(std::abs(part.eigenvalues[0].imag()), 0.08, 1e-12);
  EXPECT_LT((part.V * part.Q - projection_by_contour(S, 0.5, 0.7)).norm(), 1e-11);
}

TEST(Clusters, CloseOnesAreLinkedAndPairsAreOne) {
  using C = std::complex<double>;
  const std::vector<C> values = {C(1.0), C(0.5, 0.1), C(1.0 + 9e-4), C(0.5, -0.1), C(1.0 + 1.8e-3), C(0.3)};
  EXPECT_EQ(clusters(values, 1e-3), (std::vector<int>{2, 1, 2, 1, 2, 0}));
  EXPECT_TRUE(clusters({}, 1.0).empty());
}

TEST(Lyapunov, SolvesItsEquation) {
  Matrix T(3, 3);
  T << 0.5, -0.2, 3.0, 0.4, 0.5, -1.0, 0.0, 0.0, 20.0;
  const Matrix P = random_basis(3, 2), X = solve_lyapunov(T, P);
  EXPECT_LT((T.transpose() * X + X * T - P).norm(), 1e-13 * P.norm() * T.norm());
}

TEST(Lyapunov, OfALargeOneByHalves) {
  const int n = 201;
  Matrix S = 0.05 * random_basis(n, 4) + Matrix(Vector::LinSpaced(n, 1.0, 30.0).asDiagonal());
  const Matrix T = real_schur(S).T, P = random_basis(n, 6), X = solve_lyapunov(T, P);
  EXPECT_LT((T.transpose() * X + X * T - P).norm(), 1e-12 * P.norm());
}

TEST(SmallExponential, OfADefectiveBlock) {
  Matrix T(2, 2);
  T << 0.5, 1.0, 0.0, 0.5;
  const double s = std::log(0.01);
  const Matrix E = small_exponential(T, s);  // e^(s/2) [[1, s], [0, 1]]
  EXPECT_NEAR(E(0, 0), 0.1, 1e-15);
  EXPECT_NEAR(E(0, 1), 0.1 * s, 1e-15);
}

}  // namespace
}  // namespace scabo::linalg
