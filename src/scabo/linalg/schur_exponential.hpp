// exp(S s) applied to vectors, for matrices with eigenvalues in the right half plane and s <= 0, or in the left half
// plane and s >= 0.
//
// With S = U T U' (real Schur form) and A = s T, whose eigenvalues lie in the left half plane,
//
//     exp(A) c = 1/(2 pi i) int e^z (z - A)^-1 c dz
//
// along a hyperbola z = m (1 + sin(i theta - alpha)) around a sector of the negative axis, by the midpoint rule, which
// converges geometrically (Weideman and Trefethen, Math. Comp. 76 (2007) 1341). The constants used here were determined
// by search: 34 pairs of points have an error below 2e-14 for eigenvalues within 55 degrees of the real axis, and serve
// those within 35; 44 pairs, as exact within 65 degrees, serve those within 55. Every point costs one triangular
// solve, and all points share the products. Wider hyperbolas of 120 to 602 pairs of points, on which the
// error is below 3e-14, serve the eigenvalues beyond; where they cost more than the dense exponential, or eigenvalues
// are still outside, it is that. Several s share the solves of one contour, because only e^z in its weights differs: up
// to 64 times the shortest with 126 pairs of points, in the wider sector up to 16 times. Eigenvectors are not used,
// because S of a slender super-element is far from normal (the condition of its eigenvectors exceeds 1e16); repeated or
// defective eigenvalues cause no difficulty.
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

/// Several s, of one sign, in groups that can share a contour. The weights of contours, which are the same for all
/// exponentials, are kept: not for several threads at once.
class Times {
 public:
  Times(const std::vector<double>& s);

 private:
  friend class SchurExponential;
  struct Group {
    std::vector<std::size_t> places;  // in the list
    std::vector<double> s;            // ascending in size
    mutable Matrix weights = {};      // times x twice the points; empty until needed
  };
  std::size_t count_ = 0;
  double shortest_ = 0.0, longest_ = 0.0;  // but for 0
  std::vector<Group> groups_[2];           // for a narrower and a wider sector
};

class SchurExponential {
 public:
  SchurExponential() = default;
  /// S: n x n, with eigenvalues that all have positive or all have negative real part.
  explicit SchurExponential(const Matrix& S) : SchurExponential(real_schur(S)) {}
  /// Of S in its real Schur form; T as LAPACK gives it.
  explicit SchurExponential(RealSchur schur);

  const Matrix& U() const { return schur_.U; }  // n x n, orthogonal
  const Matrix& T() const { return schur_.T; }  // n x n, upper quasi-triangular
  const std::vector<std::complex<double>>& eigenvalues() const { return eigenvalues_; }

  /// e^(-k s) psi(s) with psi' = T psi + sum of forcings, psi(0) = c; exp(T s) c if there are none and k = 0. For s <=
  /// 0, k = `shift` must not be above the smallest real part or power (for s >= 0: not below the largest), so that the
  /// slowest term is accurate relative to itself for any s. A power may be an eigenvalue.
  Vector propagate(const Vector& c, const std::vector<Forcing>& forcings, double s, double shift = 0.0) const;
  /// The same at several times: a column for each.
  Matrix propagate(const Vector& c, const std::vector<Forcing>& forcings, const Times& times, double shift = 0.0) const;

 private:
  RealSchur schur_;
  std::vector<std::complex<double>> eigenvalues_;
};

}  // namespace scabo::linalg
