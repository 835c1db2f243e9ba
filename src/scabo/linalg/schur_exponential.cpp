#include "scabo/linalg/schur_exponential.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unsupported/Eigen/MatrixFunctions>

#include "scabo/linalg/decompositions.hpp"

namespace scabo::linalg {

namespace {

/// A point of the contour, h / (2 pi i) dz/dtheta and, times e^z, its weight; its conjugate is also part of the rule.
struct ContourPoint {
  std::complex<double> z, step, weight;
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
    contour.points.push_back({z, h / (2.0 * std::numbers::pi) * m * std::cos(argument),
                              h / (2.0 * std::numbers::pi) * std::exp(z) * m * std::cos(argument)});
  }
  return contour;
}

/// From narrow to wide: a narrower sector needs fewer points. Both are exact for eigenvalues up to ten or twenty
/// degrees further out: the error of the rule at an eigenvalue is multiplied by the resolvent around it, 1e5 and more
/// in large super-elements. Within the sector of the rule itself 9e-8 of c was wrong where 1,600 degrees of freedom
/// have eigenvalues up to 50 degrees; now 2e-13. The last points are where e^z has decayed to e^-40, for the same
/// reason.
const std::array<Contour, 2>& contours() {
  static const std::array<Contour, 2> all = {make_contour(35.0, 34, 9.6, 0.6, 0.0863970588),      // exact within 55
                                             make_contour(55.0, 44, 10.845, 0.46272, 0.070191)};  // within 65
  return all;
}

/// The same for all times from a part of the longest to the longest.
struct SharedContour {
  Contour contour;
  double range;
};
const std::array<SharedContour, 2>& shared_contours() {
  static const std::array<SharedContour, 2> all = {
      SharedContour{make_contour(35.0, 126, 7.9862, 0.3523, 0.060093), 64.0},
      SharedContour{make_contour(55.0, 143, 7.0, 0.29716, 0.045003), 16.0}};
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

/// The points of a contour and what has one value at each of them; a matrix of such values has a column for each
/// unknown, real parts above imaginary parts, so that all points are solved for at once.
struct Points {
  Eigen::ArrayXd real, imaginary;  // z

  explicit Points(const Contour& contour) {
    const auto count = static_cast<Eigen::Index>(contour.points.size());
    real.resize(count), imaginary.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const std::complex<double> z = contour.points[static_cast<std::size_t>(k)].z;
      real[k] = z.real(), imaginary[k] = z.imag();
    }
  }
  Eigen::Index count() const { return real.size(); }
  std::complex<double> operator[](Eigen::Index k) const { return {real[k], imaginary[k]}; }
};

/// Column j of X over z - s T(j, j).
void divide_column(const Matrix& transposed, double s, Eigen::Index j, const Points& points, Matrix& X) {
  const Eigen::Index count = points.count();
  double *const x = X.col(j).data(), *const y = x + count;
  const double shift = s * transposed(j, j);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double a = points.real[k] - shift, b = points.imaginary[k], square = a * a + b * b;
    const double u = (x[k] * a + y[k] * b) / square, v = (y[k] * a - x[k] * b) / square;
    x[k] = u, y[k] = v;
  }
}

/// The same for a 2 x 2 block, columns j and j + 1; in real numbers, for products of complex ones look out for
/// infinities.
void divide_columns(const Matrix& transposed, double s, Eigen::Index j, const Points& points, Matrix& X) {
  const Eigen::Index count = points.count();
  double *const x = X.col(j).data(), *const y = x + count;
  double *const v = X.col(j + 1).data(), *const w = v + count;
  const double first = s * transposed(j, j), second = s * transposed(j + 1, j + 1);
  const double b = -s * transposed(j + 1, j), c = -s * transposed(j, j + 1);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double z = points.imaginary[k], a = points.real[k] - first, d = points.real[k] - second;
    const double real = a * d - z * z - b * c, imaginary = z * (a + d);  // determinant
    const double square = real * real + imaginary * imaginary, over = real / square, under = -imaginary / square;
    const double p = d * x[k] - z * y[k] - b * v[k], q = d * y[k] + z * x[k] - b * w[k];
    const double f = a * v[k] - z * w[k] - c * x[k], g = a * w[k] + z * v[k] - c * y[k];
    x[k] = p * over - q * under, y[k] = p * under + q * over;
    v[k] = f * over - g * under, w[k] = f * under + g * over;
  }
}

/// X' <- (z - s T)^-1 X' for all contour points at once, by back substitution; `transposed` is T'. The contribution of
/// a block of unknowns to those before it is one product of matrices.
void solve_shifted(const Matrix& transposed, double s, const Points& points, Matrix& X) {
  constexpr Eigen::Index at_a_time = 8;
  const auto pair_ends = [&](Eigen::Index j) { return j > 0 && transposed(j - 1, j) != 0.0; };  // T(j, j - 1)
  for (Eigen::Index end = transposed.rows(); end > 0;) {
    Eigen::Index start = std::max<Eigen::Index>(0, end - at_a_time);
    if (pair_ends(start)) --start;  // 2 x 2 blocks are not split
    for (Eigen::Index j = end - 1; j >= start; --j) {
      const Eigen::Index last = j;
      if (pair_ends(j))
        divide_columns(transposed, s, --j, points, X);
      else
        divide_column(transposed, s, j, points, X);
      for (Eigen::Index solved = j; solved <= last; ++solved)
        for (Eigen::Index row = start; row < j; ++row) X.col(row) += s * transposed(solved, row) * X.col(solved);
    }
    if (start > 0)
      add_product(s, X.middleCols(start, end - start), transposed.block(start, 0, end - start, start),
                  X.leftCols(start));
    end = start;
  }
}

}  // namespace

SchurExponential::SchurExponential(RealSchur schur) : schur_(std::move(schur)) {
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

/// Eigenvalues of s (S - k) outside the narrowest sector, except those near the origin and those that have faded at a
/// share of s.
std::vector<std::complex<double>> wide_ones(const std::vector<std::complex<double>>& eigenvalues, double s,
                                            double shift, double share = 1.0) {
  const double slope = std::tan(contours().front().sector);
  std::vector<std::complex<double>> wide;
  for (const std::complex<double>& value : eigenvalues) {
    const std::complex<double> z = -s * (value - shift);  // in the left half plane, reflected
    const bool faded = z.real() * share > 40.0, near_origin = std::norm(z) < 1.0;
    if (!faded && !near_origin && std::abs(z.imag()) > slope * z.real()) wide.push_back(-z);
  }
  return wide;
}

bool within(const Contour& contour, const std::vector<std::complex<double>>& wide) {
  return std::all_of(wide.begin(), wide.end(),
                     [&](std::complex<double> z) { return std::abs(std::arg(-z)) <= contour.sector; });
}

/// The contour for the eigenvalues of s (S - k); null where the dense exponential is cheaper or none is wide enough.
const Contour* contour_for(const std::vector<std::complex<double>>& eigenvalues, double s, double shift) {
  const std::vector<std::complex<double>> outside = wide_ones(eigenvalues, s, shift);
  for (const Contour& contour : contours())
    if (within(contour, outside)) return &contour;
  // A triangular solve for every point, against some twenty products of matrices.
  const std::size_t most = 4 * eigenvalues.size();
  for (const Contour& contour : wide_contours())
    if (contour.points.size() <= most &&
        std::all_of(outside.begin(), outside.end(), [&](std::complex<double> z) { return contour.encloses(z); }))
      return &contour;
  return nullptr;
}

/// The dense exponential: forcings are additional rows of the system, [[T, w ...], [0, power ...]], with the value 1 at
/// s = 0.
Vector dense_propagation(const Matrix& T, const Vector& c, const std::vector<Forcing>& forcings, double s,
                         double shift) {
  const Eigen::Index n = c.size();
  const auto terms = static_cast<Eigen::Index>(forcings.size());
  Matrix augmented = Matrix::Zero(n + terms, n + terms);
  augmented.topLeftCorner(n, n) = T * s;
  augmented.diagonal().head(n).array() -= shift * s;
  for (Eigen::Index j = 0; j < terms; ++j) {
    augmented.col(n + j).head(n) = s * forcings[static_cast<std::size_t>(j)].w;
    augmented(n + j, n + j) = (forcings[static_cast<std::size_t>(j)].power - shift) * s;
  }
  Vector start = Vector::Ones(n + terms);
  start.head(n) = c;
  return (augmented.exp() * start).head(n);
}

/// (z - s (T - k))^-1 of c and forcings at all points of a contour.
Matrix resolved(const Matrix& T, const Vector& c, const std::vector<Forcing>& forcings, double s, double shift,
                const Contour& contour) {
  const Points points(contour);
  const Eigen::Index count = points.count();
  Matrix X(2 * count, c.size());
  X.topRows(count).rowwise() = c.transpose();
  X.bottomRows(count).setZero();
  for (const Forcing& forcing : forcings)
    for (Eigen::Index k = 0; k < count; ++k) {
      const std::complex<double> share = s * inverse(points[k] - (forcing.power - shift) * s);
      X.row(k) += share.real() * forcing.w.transpose();
      X.row(count + k) += share.imag() * forcing.w.transpose();
    }
  Matrix transposed = T.transpose();
  transposed.diagonal().array() -= shift;
  solve_shifted(transposed, s, points, X);
  return X;
}

/// 2 Re w, then -2 Im w: the product with a column of values at the points is the sum over all points.
template <typename WeightOf>
Vector weights_of(const Contour& contour, const WeightOf& weight_of) {
  const auto count = static_cast<Eigen::Index>(contour.points.size());
  Vector weights(2 * count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::complex<double> weight = weight_of(contour.points[static_cast<std::size_t>(k)]);
    weights[k] = 2.0 * weight.real(), weights[count + k] = -2.0 * weight.imag();
  }
  return weights;
}

/// A row for each time. At points where e^z has faded, there is nothing to compute.
Matrix weights_at(const Contour& contour, const std::vector<double>& s) {
  constexpr double faded = -45.0;
  const auto of_point = [](const ContourPoint& point, double share) {
    return share * point.z.real() < faded ? 0.0 : point.step * std::exp(share * point.z);
  };
  Matrix weights(static_cast<Eigen::Index>(s.size()), 2 * static_cast<Eigen::Index>(contour.points.size()));
  for (Eigen::Index j = 0; j < weights.rows(); ++j) {
    const double share = s[static_cast<std::size_t>(j)] / s.back();
    weights.row(j) = weights_of(contour, [&](const ContourPoint& point) { return of_point(point, share); });
  }
  return weights;
}

}  // namespace

Vector SchurExponential::propagate(const Vector& c, const std::vector<Forcing>& forcings, double s,
                                   double shift) const {
  if (s == 0.0 || c.size() == 0) return c;
  const Contour* const contour = contour_for(eigenvalues_, s, shift);
  if (contour == nullptr) return dense_propagation(schur_.T, c, forcings, s, shift);  // rare
  const Vector weights = weights_of(*contour, [](const ContourPoint& point) { return point.weight; });
  return resolved(schur_.T, c, forcings, s, shift, *contour).transpose() * weights;
}

Times::Times(const std::vector<double>& s) : count_(s.size()) {
  std::vector<std::size_t> order(s.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return std::abs(s[i]) < std::abs(s[j]); });
  for (const std::size_t i : order) {
    if (longest_ == 0.0) shortest_ = s[i];
    longest_ = s[i];
    for (std::size_t k = 0; k < 2; ++k) {
      const double range = shared_contours()[k].range;
      std::vector<Group>& groups = groups_[k];
      if (groups.empty() || std::abs(s[i]) > range * std::abs(groups.back().s.front())) groups.emplace_back();
      groups.back().places.push_back(i);
      groups.back().s.push_back(s[i]);
    }
  }
}

Matrix SchurExponential::propagate(const Vector& c, const std::vector<Forcing>& forcings, const Times& times,
                                   double shift) const {
  Matrix values(c.size(), static_cast<Eigen::Index>(times.count_));
  if (values.size() == 0) return values;
  const auto column = [&](std::size_t i) { return values.col(static_cast<Eigen::Index>(i)); };
  const auto wide = wide_ones(eigenvalues_, times.longest_, shift, times.shortest_ / times.longest_);
  const bool narrow = within(shared_contours()[0].contour, wide);
  const Contour& contour = shared_contours()[narrow ? 0 : 1].contour;
  const bool encloses = narrow || within(contour, wide);
  for (const Times::Group& group : times.groups_[narrow ? 0 : 1]) {
    if (!encloses || group.s.front() == 0.0 ||
        group.s.size() * contours()[narrow ? 0 : 1].points.size() <= contour.points.size()) {
      for (std::size_t k = 0; k < group.s.size(); ++k)
        column(group.places[k]) = propagate(c, forcings, group.s[k], shift);
      continue;
    }
    if (group.weights.size() == 0) group.weights = weights_at(contour, group.s);
    Matrix rows = Matrix::Zero(group.weights.rows(), c.size());
    add_product(1.0, group.weights, resolved(schur_.T, c, forcings, group.s.back(), shift, contour), rows);
    for (std::size_t k = 0; k < group.s.size(); ++k)
      column(group.places[k]) = rows.row(static_cast<Eigen::Index>(k)).transpose();
  }
  return values;
}

}  // namespace scabo::linalg
