// The Riccati equation made for a K that is known: its residual, and Newton's step towards it.
#include "scabo/element/sbfem/riccati.hpp"

#include <gtest/gtest.h>

#include "support/decompositions.hpp"

namespace scabo::element {
namespace {

struct Known {
  Matrix E0, E1, E2, K, S;
  linalg::CholeskyFactor L;
};

Matrix random(Eigen::Index n) { return Matrix::Random(n, n); }

/// E2 is what makes P(K) = 0; exponents between about 1 and 30, one row as stiff as `contrast` of the others.
Known known(Eigen::Index n, double contrast) {
  Known made;
  const Matrix X = random(n), Y = random(n);
  Vector scale = Vector::Ones(n);
  scale[0] = std::sqrt(contrast);
  const auto scaled = [&](const Matrix& A) { return Matrix(scale.asDiagonal() * A * scale.asDiagonal()); };
  made.E0 = scaled(X * X.transpose() / static_cast<double>(n) + Matrix::Identity(n, n));
  made.K = scaled(Y * Y.transpose() + 4.0 * Matrix::Identity(n, n));
  made.E1 = scaled(random(n));
  made.S = test::solve_lu(made.E0, made.K - made.E1.transpose());
  made.E2 = (made.K - made.E1) * made.S;
  made.E2 = 0.5 * (made.E2 + made.E2.transpose()).eval();
  made.L.A = made.E0;
  EXPECT_TRUE(made.L.factorise());
  return made;
}

Vector scale_of(const Known& at) { return at.E0.diagonal().cwiseSqrt(); }

TEST(RiccatiResidual, IsZeroAtTheSolution) {
  for (double contrast : {1.0, 1e6}) {
    const Known at = known(12, contrast);
    const RiccatiResidual residual = riccati_residual(at.L, at.E1, at.E2, at.K);
    EXPECT_LT(residual.size, 1e-12);
    EXPECT_LT((residual.S - at.S).norm(), 1e-12 * at.S.norm());
  }
}

TEST(RiccatiResidual, IsTheFormula) {
  const Known at = known(7, 1.0);
  const Matrix other = at.K + 0.1 * Matrix::Identity(7, 7);
  const Matrix P = (other - at.E1) * test::solve_lu(at.E0, other - at.E1.transpose()) - at.E2;
  const RiccatiResidual residual = riccati_residual(at.L, at.E1, at.E2, other);
  EXPECT_LT((Matrix(residual.P.selfadjointView<Eigen::Lower>()) + P).norm(), 1e-12 * P.norm());
  const Vector over = at.E2.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_NEAR(residual.size, (over.asDiagonal() * P * over.asDiagonal()).cwiseAbs().maxCoeff(), 1e-12);
}

/// Residual of what is not a number: the largest there is, not the smallest.
TEST(RiccatiResidual, OfWhatIsNotANumberIsNotSmall) {
  const Known at = known(5, 1.0);
  Matrix broken = at.K;
  broken(3, 3) = std::nan("");
  EXPECT_FALSE(riccati_residual(at.L, at.E1, at.E2, broken).size <= 1e300);
}

/// The step squares the error, also of a row a million times as stiff as the others.
TEST(RiccatiNewton, SquaresTheError) {
  for (double contrast : {1.0, 1e6}) {
    const Known at = known(12, contrast);
    ASSERT_GT(test::eigenvalues(at.S).real().minCoeff(), 0.1);
    const Vector scale = scale_of(at), over = scale.cwiseInverse();
    const auto error_of = [&](const Matrix& K) { return (over.asDiagonal() * (K - at.K) * over.asDiagonal()).norm(); };
    for (double delta : {1e-2, 1e-3, 1e-4}) {
      Matrix change = random(12);
      change = scale.asDiagonal() * Matrix(0.5 * delta * (change + change.transpose())) * scale.asDiagonal();
      const Matrix before = at.K + change;
      const Matrix step = newton_step(riccati_residual(at.L, at.E1, at.E2, before), scale);
      EXPECT_EQ(step, step.transpose());
      const double error = error_of(before), after = error_of(before + step);
      EXPECT_LT(after, 2.0 * error * error) << "contrast " << contrast << ", error " << error;
    }
  }
}

}  // namespace
}  // namespace scabo::element
