#include "scabo/linalg/schur_exponential.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

namespace scabo::linalg {

namespace {

/// A point of the contour and its weight h / (2 pi i) e^z dz/dtheta; its conjugate belongs to the rule too.
struct ContourPoint {
  std::complex<double> z, weight;
};

constexpr int contour_points = 32;
constexpr double sector = 55.0 * std::numbers::pi / 180.0;

std::array<ContourPoint, contour_points> make_contour() {
  constexpr double m = 9.6, alpha = 0.6, h = 0.0863970588;
  constexpr std::complex<double> i(0.0, 1.0);
  std::array<ContourPoint, contour_points> contour;
  for (int k = 0; k < contour_points; ++k) {
    const std::complex<double> argument = i * ((k + 0.5) * h) - alpha;
    const std::complex<double> z = m * (1.0 + std::sin(argument));
    contour[static_cast<std::size_t>(k)] = {z, h / (2.0 * std::numbers::pi) * std::exp(z) * m * std::cos(argument)};
  }
  return contour;
}

bool pair_begins(const Matrix& T, Eigen::Index i) { return i + 1 < T.rows() && T(i + 1, i) != 0.0; }

/// x + iy <- (z - s T)^-1 (x + iy), by columns from the last: real and imaginary parts apart, for the vector units.
void solve_shifted(const Matrix& T, double s, std::complex<double> z, Vector& x, Vector& y) {
  for (Eigen::Index j = T.rows() - 1; j >= 0; --j) {
    const bool pair = j > 0 && pair_begins(T, j - 1);
    const Eigen::Index first = pair ? j - 1 : j;
    if (pair) {
      const std::complex<double> a = z - s * T(first, first), b = -s * T(first, j), c = -s * T(j, first),
                                 d = z - s * T(j, j);
      const std::complex<double> f(x[first], y[first]), g(x[j], y[j]), determinant = a * d - b * c;
      const std::complex<double> u = (d * f - b * g) / determinant, v = (a * g - c * f) / determinant;
      x[first] = u.real(), y[first] = u.imag(), x[j] = v.real(), y[j] = v.imag();
    } else {
      const std::complex<double> u = std::complex<double>(x[j], y[j]) / (z - s * T(j, j));
      x[j] = u.real(), y[j] = u.imag();
    }
    for (Eigen::Index column = first; column <= j; ++column) {
      x.head(first) += (s * x[column]) * T.col(column).head(first);
      y.head(first) += (s * y[column]) * T.col(column).head(first);
    }
    j = first;
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
    if (std::abs(std::arg(value)) > sector) in_sector_ = false;
  }
}

Vector SchurExponential::propagate(const Vector& c, const Vector& w, double s) const {
  const Matrix& T = schur_.T;
  const Eigen::Index n = T.rows();
  if (s == 0.0 || n == 0) return c;
  if (!in_sector_) {  // rare: the dense exponential of [[T, -w], [0, 2]] s
    Matrix augmented = Matrix::Zero(n + 1, n + 1);
    augmented.topLeftCorner(n, n) = T * s;
    augmented.topRightCorner(n, 1) = -w * s;
    augmented(n, n) = 2.0 * s;
    Vector start(n + 1);
    start << c, 1.0;
    return (augmented.exp() * start).head(n);
  }
  static const std::array<ContourPoint, contour_points> contour = make_contour();
  Vector psi = Vector::Zero(n), x(n), y(n);
  for (const ContourPoint& point : contour) {
    const std::complex<double> forcing = -s / (point.z - 2.0 * s);  // of w: the last row of the augmented system
    x = c + forcing.real() * w;
    y = forcing.imag() * w;
    solve_shifted(T, s, point.z, x, y);
    psi += 2.0 * point.weight.real() * x - 2.0 * point.weight.imag() * y;
  }
  return psi;
}

}  // namespace scabo::linalg
