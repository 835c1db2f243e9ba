#include "scabo/element/sbfem/riccati.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::element {

RiccatiResidual judged(Matrix P, Matrix S, const Matrix& E2) {
  RiccatiResidual residual{std::move(P), std::move(S), 0.0};
  const Vector scale = E2.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Index n = E2.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto column = residual.P.col(j).tail(n - j);
    residual.size = std::max(residual.size, scale[j] * column.cwiseProduct(scale.tail(n - j)).cwiseAbs().maxCoeff());
    if (!column.allFinite()) {  // a maximum would ignore NaN
      residual.size = std::numeric_limits<double>::infinity();
      break;
    }
  }
  return residual;
}

RiccatiResidual riccati_residual(const linalg::CholeskyFactor& L, const Matrix& E1, const Matrix& E2, const Matrix& K) {
  Matrix X = K - E1, P = E2;
  L.divide(X);
  linalg::subtract_square(X, P);  // -P = E2 - X X', X = (K - E1) L^-T
  L.divide(X, true);
  return judged(std::move(P), X.transpose(), E2);
}

Matrix newton_step(const RiccatiResidual& residual, const Vector& scale) {
  const Vector over = scale.cwiseInverse();
  const Matrix S = scale.asDiagonal() * residual.S * over.asDiagonal();
  const Eigen::Index n = S.rows();
  const double g = std::max(1.0, std::sqrt(S.norm() / std::sqrt(static_cast<double>(n))));
  const Matrix identity = Matrix::Identity(n, n);
  const Eigen::PartialPivLU<Matrix> shifted(S + g * identity);
  const Matrix inverse = shifted.inverse();
  Matrix C = 2.0 * g * inverse - identity;  // (g - S) (g + S)^-1
  const Matrix P = over.asDiagonal() * Matrix(residual.P.selfadjointView<Eigen::Lower>()) * over.asDiagonal();
  Matrix Q = 2.0 * g * linalg::multiply_transposed(inverse, linalg::multiply(P, inverse));
  constexpr int most = 60;
  for (int k = 0; k < most; ++k) {
    const Matrix more = linalg::multiply_transposed(C, linalg::multiply(Q, C));
    Q += more;
    if (!(more.cwiseAbs().maxCoeff() > 1e-6 * Q.cwiseAbs().maxCoeff()))
      break;  // a few digits are enough for a correction
    C = linalg::multiply(C, C);
  }
  const Matrix step = scale.asDiagonal() * Q * scale.asDiagonal();
  return 0.5 * (step + step.transpose());
}

}  // namespace scabo::element
