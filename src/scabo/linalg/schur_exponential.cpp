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

/// Midpoints of a hyperbola that encloses all eigenvalues within `sector` of the negative axis.
struct Contour {
  double sector;  // radians
  std::vector<ContourPoint> points;
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

double SchurExponential::widest_angle(double s, double shift) const {
  double widest = 0.0;
  for (const std::complex<double>& value : eigenvalues_) {
    const std::complex<double> z = -s * (value - shift);  // eigenvalue of s (S - k), in the left half plane, reflected
    const bool faded = z.real() > 40.0, near_origin = std::abs(z) < 1.0;
    if (!faded && !near_origin) widest = std::max(widest, std::abs(std::arg(z)));
  }
  return widest;
}

Vector SchurExponential::propagate(const Vector& c, const std::vector<Forcing>& forcings, double s,
                                   double shift) const {
  const Eigen::Index n = c.size();
  if (s == 0.0 || n == 0) return c;
  Matrix T = schur_.T;
  T.diagonal().array() -= shift;
  // Forcings are additional rows of the system, [[T, w ...], [0, power ...]], with the value 1 at s = 0.
  const double angle = widest_angle(s, shift);
  const auto contour =
      std::find_if(contours().begin(), contours().end(), [&](const Contour& one) { return angle <= one.sector; });
  if (contour == contours().end()) {  // rare: the dense exponential
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
