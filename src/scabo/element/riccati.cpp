#include "scabo/element/riccati.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "scabo/linalg/dense.hpp"

namespace scabo::element {

RiccatiResidual riccati_residual(const linalg::CholeskyFactor& L, const Matrix& E1, const Matrix& E2, const Matrix& K) {
  Matrix X = K - E1;
  L.divide(X);
  RiccatiResidual residual{E2, Matrix(), 0.0};  // P = X X' - E2, X = (K - E1) L^-T, the other sign first
  linalg::subtract_square(X, residual.P);
  L.divide(X, true);
  residual.S = X.transpose();
  const Vector scale = E2.diagonal().cwiseSqrt().cwiseInverse();
  for (Eigen::Index j = 0; j < K.cols(); ++j) {
    const double size = scale[j] * residual.P.col(j).tail(K.rows() - j).cwiseProduct(scale.tail(K.rows() - j)).cwiseAbs().maxCoeff();
    if (!(size <= residual.size)) residual.size = size;  // what is not a number is the largest
  }
  return residual;
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
    if (!(more.cwiseAbs().maxCoeff() > 1e-6 * Q.cwiseAbs().maxCoeff())) break;  // of a correction: a few digits are enough
    C = linalg::multiply(C, C);
  }
  const Matrix step = scale.asDiagonal() * Q * scale.asDiagonal();
  return 0.5 * (step + step.transpose());
}

}  // namespace scabo::element
