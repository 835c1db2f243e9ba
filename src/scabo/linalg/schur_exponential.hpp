// exp(S s) applied to vectors, for matrices whose eigenvalues lie in the right half plane and s <= 0, or in the left
// half plane and s >= 0.
//
// S = U T U' (real Schur form), and with A = s T, in the left half plane,
//
//     exp(A) c = 1/(2 pi i) int e^z (z - A)^-1 c dz
//
// along a hyperbola z = m (1 + sin(i theta - alpha)) around a sector of the negative axis, by the midpoint rule,
// which converges geometrically (Weideman and Trefethen, Math. Comp. 76 (2007) 1341; the constants here were found
// by search: error below 3e-15 with 28 pairs of points for eigenvalues within 45 degrees of the real axis, 2e-14 with
// 32 within 55 degrees; which one is used depends on the eigenvalues). Every point costs one triangular solve, all
// points share the products. Eigenvectors are not used: S of a slender super-element is far from normal (their
// condition passes 1e16), and repeated or defective eigenvalues do no harm.
#pragma once

#include <complex>
#include <vector>

#include "scabo/linalg/dense.hpp"

namespace scabo::linalg {

/// A term e^(power s) w of a right-hand side.
struct Forcing {
  double power = 0.0;
  Vector w;  // n
};

class SchurExponential {
 public:
  SchurExponential() = default;
  /// S: n x n, eigenvalues with positive real part, or all with negative real part.
  explicit SchurExponential(const Matrix& S);

  const Matrix& U() const { return schur_.U; }  // n x n, orthogonal
  const Matrix& T() const { return schur_.T; }  // n x n, upper quasi-triangular
  const std::vector<std::complex<double>>& eigenvalues() const { return eigenvalues_; }

  /// e^(-k s) psi(s) with psi' = T psi + sum of forcings, psi(0) = c; exp(T s) c where there are none and k = 0. For s
  /// <= 0, k = `shift` is not above the smallest real part or power (s >= 0: not below the largest), so that what fades
  /// slowest is accurate relative to itself, however far s is. A power may be an eigenvalue.
  Vector propagate(const Vector& c, const std::vector<Forcing>& forcings, double s, double shift = 0.0) const;

 private:
  /// Largest angle between the real axis and an eigenvalue that matters, radians.
  double widest_angle(double s, double shift) const;

  RealSchur schur_;
  std::vector<std::complex<double>> eigenvalues_;
};

}  // namespace scabo::linalg
