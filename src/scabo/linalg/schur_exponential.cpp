#include "scabo/linalg/schur_exponential.hpp"

#include <Eigen/LU>
#include <algorithm>
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

const std::array<ContourPoint, contour_points>& the_contour() {
  static const std::array<ContourPoint, contour_points> contour = make_contour();
  return contour;
}

bool pair_begins(const Matrix& T, Eigen::Index i) { return i + 1 < T.rows() && T(i + 1, i) != 0.0; }

/// 1 / z, without the checks for overflow of the language's own division, which cost more than the solve.
std::complex<double> inverse(std::complex<double> z) {
  const double square = z.real() * z.real() + z.imag() * z.imag();
  return {z.real() / square, -z.imag() / square};
}

/// Solves one diagonal block of z - s T, rows first to last of X, all contour points (columns: real parts, then
/// imaginary parts), by back substitution.
void solve_diagonal_block(const Matrix& T, double s, Eigen::Index start, Eigen::Index size, Matrix& X) {
  const std::array<ContourPoint, contour_points>& contour = the_contour();
  for (Eigen::Index point = 0; point < contour_points; ++point) {
    const std::complex<double> z = contour[static_cast<std::size_t>(point)].z;
    double* const x = X.col(point).data();
    double* const y = X.col(contour_points + point).data();
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

/// X <- (z - s T)^-1 X for all contour points at once: what a block of rows contributes to those above it is one
/// product of matrices.
void solve_shifted(const Matrix& T, double s, Matrix& X) {
  constexpr Eigen::Index rows_at_a_time = 32;
  for (Eigen::Index end = T.rows(); end > 0;) {
    Eigen::Index start = std::max<Eigen::Index>(0, end - rows_at_a_time);
    if (start > 0 && pair_begins(T, start - 1)) --start;  // 2 x 2 blocks stay whole
    solve_diagonal_block(T, s, start, end - start, X);
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

bool SchurExponential::contour_holds(double s, double shift) const {
  for (const std::complex<double>& value : eigenvalues_) {
    const std::complex<double> z = -s * (value - shift);  // s (S - k) lies in the left half plane: its mirror image
    const bool faded = z.real() > 40.0, near_origin = std::abs(z) < 1.0;
    if (!faded && !near_origin && std::abs(std::arg(z)) > sector) return false;
  }
  return true;
}

Vector SchurExponential::propagate(const Vector& c, const std::vector<Forcing>& forcings, double s,
                                   double shift) const {
  const Eigen::Index n = c.size();
  if (s == 0.0 || n == 0) return c;
  Matrix T = schur_.T;
  T.diagonal().array() -= shift;
  // Forcings are further rows of the system, [[T, w ...], [0, power ...]], with the value 1 at s = 0.
  if (!contour_holds(s, shift)) {  // rare: the dense exponential
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
  Matrix X(n, 2 * contour_points);
  for (Eigen::Index k = 0; k < contour_points; ++k) {
    X.col(k) = c;
    X.col(contour_points + k).setZero();
    for (const Forcing& forcing : forcings) {
      const std::complex<double> share =
          s * inverse(the_contour()[static_cast<std::size_t>(k)].z - (forcing.power - shift) * s);
      X.col(k) += share.real() * forcing.w;
      X.col(contour_points + k) += share.imag() * forcing.w;
    }
  }
  solve_shifted(T, s, X);
  Vector psi = Vector::Zero(n);
  for (Eigen::Index k = 0; k < contour_points; ++k) {
    const std::complex<double> weight = the_contour()[static_cast<std::size_t>(k)].weight;
    psi += 2.0 * weight.real() * X.col(k) - 2.0 * weight.imag() * X.col(contour_points + k);
  }
  return psi;
}

}  // namespace scabo::linalg
