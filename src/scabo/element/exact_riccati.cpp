#include "scabo/element/exact_riccati.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "scabo/element/ill_posed.hpp"
#include "scabo/element/riccati.hpp"

namespace scabo::element {

namespace {

using Real = long double;
using Exact = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Eq. (4) of stiffness.hpp.
struct Coefficients {
  Exact E0, E1, E2;
};

Coefficients without_translations(const WithTranslations& of) {
  const Exact E0 = of.E0.cast<Real>(), E1 = of.E1.cast<Real>(), E2 = of.E2.cast<Real>(), R = of.R.cast<Real>();
  if (R.cols() == 0) return {E0(of.I, of.I), E1(of.I, of.I), E2(of.I, of.I)};
  const Exact E0R = E0 * R, E1R = E1 * R;
  const Eigen::LLT<Exact> M(R.transpose() * E0R);
  if (M.info() != Eigen::Success) throw IllPosed("E0 is not positive definite");
  const Exact Y = M.matrixL().solve(Exact(E0R.transpose())), W = M.matrixL().solve(Exact(E1R.transpose()));
  return {Exact(E0 - Y.transpose() * Y)(of.I, of.I), Exact(E1 - W.transpose() * Y)(of.I, of.I),
          Exact(E2 - W.transpose() * W)(of.I, of.I)};
}

}  // namespace

void correct_last_digits(const WithTranslations& of, RingStiffness& ring) {
  const Coefficients exact = without_translations(of);
  const Eigen::LLT<Exact> L(exact.E0);
  if (L.info() != Eigen::Success) throw IllPosed("E0 is not positive definite");
  const auto scale_of = [](const Exact& A) { return Vector(A.diagonal().cast<double>().cwiseSqrt().cwiseInverse()); };
  const Vector scale = scale_of(exact.E0);
  Exact K = ring.K.cast<Real>();
  constexpr int most = 4;
  for (int k = 0;; ++k) {
    const Exact X = L.matrixL().solve(Exact((K - exact.E1).transpose()));
    const RiccatiResidual residual = judged(Exact(exact.E2 - X.transpose() * X).cast<double>(),
                                            Exact(L.matrixU().solve(X)).cast<double>(), exact.E2.cast<double>());
    ring.S = residual.S;
    ring.residual = residual.size;
    if (k == most || !std::isfinite(residual.size)) break;
    const Matrix step = newton_step(residual, scale.cwiseInverse());
    const auto size = [&](const Matrix& A) {
      return (scale.asDiagonal() * A * scale.asDiagonal()).cwiseAbs().maxCoeff();
    };
    K += step.cast<Real>();
    // A step is good to some six digits: is the next one below the rounding of K?
    if (residual.size < 1e-10 && size(step) < 1e-10 * size(ring.K)) {
      ring.S += Exact(L.solve(step.cast<Real>())).cast<double>();
      break;
    }
  }
  ring.K = K.cast<double>();
}

}  // namespace scabo::element
