#include "scabo/element/riccati.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "scabo/linalg/dense.hpp"

namespace scabo::element {

RiccatiResidual riccati_residual(const Matrix& L, const Matrix& E1, const Matrix& E2, const Matrix& K) {
  RiccatiResidual residual{-E2, K - E1.transpose(), 0.0};
  linalg::solve_lower_in_place(L, residual.S);
  linalg::add_gram_lower(residual.P, residual.S, 1.0);  // P = X'X - E2, X = L^-1 (K - E1')
  linalg::solve_lower_in_place(L, residual.S, true);
  const Vector scale = E2.diagonal().cwiseSqrt().cwiseInverse();
  for (Eigen::Index j = 0; j < K.cols(); ++j) {
    const double size = scale[j] * residual.P.col(j).tail(K.rows() - j).cwiseProduct(scale.tail(K.rows() - j)).cwiseAbs().maxCoeff();
    if (!(size <= residual.size)) residual.size = size;  // what is not a number is the largest
  }
  residual.P.triangularView<Eigen::StrictlyUpper>() = residual.P.transpose();
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
  const Matrix P = over.asDiagonal() * residual.P * over.asDiagonal();
  Matrix Q = -2.0 * g * linalg::multiply_transposed(inverse, linalg::multiply(P, inverse));
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
