#include "scabo/linalg/schur_exponential.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

namespace scabo::linalg {

namespace {

/// A point of the contour and its weight h / (2 pi i) e^z dz/dtheta; its conjugate is also part of the rule.
struct ContourPoint {
  std::complex<double> z, weight;
};

/// Midpoints of a hyperbola that encloses all eigenvalues within `sector` of the negative axis, or, with a sector of 0,
/// within the hyperbola m (1 + sin(i theta - within)).
struct Contour {
  double sector;  // radians
  std::vector<ContourPoint> points;
  double m = 0.0, within = 0.0;
  bool encloses(std::complex<double> z) const { return -std::asin(z / m - 1.0).real() >= within; }
};

Contour make_contour(double degrees, int points, double m, double alpha, double h) {
  constexpr std::complex<double> i(0.0, 1.0);
  Contour contour{degrees * std::numbers::pi / 180.0, {}};
  for (int k = 0; k < points; ++k) {
    const std::complex<double> argument = i * ((k + 0.5) * h) - alpha;
    const std::complex<double> z = m * (1.0 + std::sin(argument));
    contour.points.push_back({z, h / (2.0 * std::numbers::pi) * std::exp(z) * m * std::cos(argument)});
  }
  return contour;
}

/// From narrow to wide: a narrower sector needs fewer points and has a smaller error.
const std::array<Contour, 2>& contours() {
  static const std::array<Contour, 2> all = {make_contour(45.0, 28, 14.0, 0.8, 0.0766807),
                                             make_contour(55.0, 32, 9.6, 0.6, 0.0863970588)};
  return all;
}

/// Hyperbolas of the same vertex, closer and closer to an upright line: for eigenvalues near the imaginary axis, as
/// those of slender and of strongly graded super-elements are once the shift is taken off. The step makes what remains
/// of the midpoint rule e^-34 on the side of the eigenvalues, within - alpha away, and on the other one; the ends have
/// decayed to e^-36.
Contour make_wide_contour(double alpha, double within) {
  constexpr double vertex = 5.0, remains = 34.0, decayed = 36.0;  // e^vertex: what rounding is multiplied by
  const double m = vertex / (1.0 - std::sin(alpha));
  const double step = 2.0 * std::numbers::pi * std::min((within - alpha) / remains, alpha / (remains + m));
  const double end = std::acosh((1.0 + decayed / m) / std::sin(alpha));
  Contour contour = make_contour(0.0, static_cast<int>(std::ceil(end / step)), m, alpha, step);
  contour.m = m;
  contour.within = within;
  return contour;
}

/// 120, 229 and 602 points: for imaginary parts up to 11, 19 and 47 where the real part vanishes.
const std::array<Contour, 3>& wide_contours() {
  static const std::array<Contour, 3> all = {make_wide_contour(0.4, 0.55), make_wide_contour(0.2, 0.3),
                                             make_wide_contour(0.06, 0.11)};
  return all;
}

/// 1 / z without the overflow checks of the language's division, which would cost more than the solve.
std::complex<double> inverse(std::complex<double> z) {
  const double square = z.real() * z.real() + z.imag() * z.imag();
  return {z.real() / square, -z.imag() / square};
}

/// Solves one diagonal block of z - s T, rows first to last of X, all contour points (columns: real parts, then
/// imaginary parts), by back substitution.
void solve_diagonal_block(const Matrix& T, double s, Eigen::Index start, Eigen::Index size, const Contour& contour,
                          Matrix& X) {
  const auto count = static_cast<Eigen::Index>(contour.points.size());
  for (Eigen::Index point = 0; point < count; ++point) {
    const std::complex<double> z = contour.points[static_cast<std::size_t>(point)].z;
    double* const x = X.col(point).data();
    double* const y = X.col(count + point).data();
    for (Eigen::Index j = start + size - 1; j >= start; --j) {
      const Eigen::Index first = j > start && pair_begins(T, j - 1) ? j - 1 : j;
      if (first < j) {
        const std::complex<double> a = z - s * T(first, first), d = z - s * T(j, j);
        const double b = -s * T(first, j), c = -s * T(j, first);
        const std::complex<double> f(x[first], y[first]), g(x[j], y[j]), over = inverse(a * d - b * c);
        const std::complex<double> u = (d * f - b * g) * over, v = (a * g - c * f) * over;
        x[first] = u.real(), y[first] = u.imag(), x[j] = v.real(), y[j] = v.imag();
      } else {
        const std::complex<double> u = std::complex<double>(x[j], y[j]) * inverse(z - s * T(j, j));
        x[j] = u.real(), y[j] = u.imag();
      }
      for (Eigen::Index column = first; column <= j; ++column) {
        const double u = s * x[column], v = s * y[column];
        const double* const t = T.col(column).data();
        for (Eigen::Index row = start; row < first; ++row) x[row] += u * t[row], y[row] += v * t[row];
      }
      j = first;
    }
  }
}

/// X <- (z - s T)^-1 X for all contour points at once: the contribution of a block of rows to those above it is one
/// product of matrices.
void solve_shifted(const Matrix& T, double s, const Contour& contour, Matrix& X) {
  constexpr Eigen::Index rows_at_a_time = 32;
  for (Eigen::Index end = T.rows(); end > 0;) {
    Eigen::Index start = std::max<Eigen::Index>(0, end - rows_at_a_time);
    if (start > 0 && pair_begins(T, start - 1)) --start;  // 2 x 2 blocks are not split
    solve_diagonal_block(T, s, start, end - start, contour, X);
    if (start > 0)
      add_product(s, T.block(0, start, start, end - start), X.middleRows(start, end - start), X.topRows(start));
    end = start;
  }
}

}  // namespace

SchurExponential::SchurExponential(const Matrix& S) : schur_(real_schur(S)) {
  const Matrix& T = schur_.T;
  for (Eigen::Index i = 0; i < T.rows(); ++i) {
    const bool pair = pair_begins(T, i);
    // LAPACK's standard form: equal diagonal, off-diagonal entries of opposite sign.
    const std::complex<double> value(T(i, i), pair ? std::sqrt(std::abs(T(i, i + 1) * T(i + 1, i))) : 0.0);
    eigenvalues_.push_back(value);
    if (pair) eigenvalues_.push_back(std::conj(value)), ++i;
  }
}

namespace {

/// The contour for the eigenvalues of s (S - k); null where the dense exponential is cheaper or none is wide enough.
const Contour* contour_for(const std::vector<std::complex<double>>& eigenvalues, double s, double shift) {
  double widest = 0.0;
  std::vector<std::complex<double>> outside;  // of the narrowest sector
  for (const std::complex<double>& value : eigenvalues) {
    const std::complex<double> z = -s * (value - shift);  // in the left half plane, reflected
    const bool faded = z.real() > 40.0, near_origin = std::abs(z) < 1.0;
    if (faded || near_origin) continue;
    const double angle = std::abs(std::arg(z));
    widest = std::max(widest, angle);
    if (angle > contours().front().sector) outside.push_back(-z);
  }
  for (const Contour& contour : contours())
    if (widest <= contour.sector) return &contour;
  // A triangular solve for every point, against some twenty products of matrices.
  const std::size_t most = 4 * eigenvalues.size();
  for (const Contour& contour : wide_contours())
    if (contour.points.size() <= most &&
        std::all_of(outside.begin(), outside.end(), [&](std::complex<double> z) { return contour.encloses(z); }))
      return &contour;
  return nullptr;
}

}  // namespace

Vector SchurExponential::propagate(const Vector& c, const std::vector<Forcing>& forcings, double s,
                                   double shift) const {
  const Eigen::Index n = c.size();
  if (s == 0.0 || n == 0) return c;
  Matrix T = schur_.T;
  T.diagonal().array() -= shift;
  // Forcings are additional rows of the system, [[T, w ...], [0, power ...]], with the value 1 at s = 0.
  const Contour* const contour = contour_for(eigenvalues_, s, shift);
  if (contour == nullptr) {  // rare: the dense exponential
    const auto terms = static_cast<Eigen::Index>(forcings.size());
    Matrix augmented = Matrix::Zero(n + terms, n + terms);
    augmented.topLeftCorner(n, n) = T * s;
    for (Eigen::Index j = 0; j < terms; ++j) {
      augmented.col(n + j).head(n) = s * forcings[static_cast<std::size_t>(j)].w;
      augmented(n + j, n + j) = (forcings[static_cast<std::size_t>(j)].power - shift) * s;
    }
    Vector start = Vector::Ones(n + terms);
    start.head(n) = c;
    return (augmented.exp() * start).head(n);
  }
  const auto count = static_cast<Eigen::Index>(contour->points.size());
  Matrix X(n, 2 * count);
  for (Eigen::Index k = 0; k < count; ++k) {
    X.col(k) = c;
    X.col(count + k).setZero();
    for (const Forcing& forcing : forcings) {
      const std::complex<double> share =
          s * inverse(contour->points[static_cast<std::size_t>(k)].z - (forcing.power - shift) * s);
      X.col(k) += share.real() * forcing.w;
      X.col(count + k) += share.imag() * forcing.w;
    }
  }
  solve_shifted(T, s, *contour, X);
  Vector psi = Vector::Zero(n);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::complex<double> weight = contour->points[static_cast<std::size_t>(k)].weight;
    psi += 2.0 * weight.real() * X.col(k) - 2.0 * weight.imag() * X.col(count + k);
  }
  return psi;
}

}  // namespace scabo::linalg
