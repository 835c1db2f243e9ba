#include "scabo/geometry/line_basis.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>

#include "scabo/base/error.hpp"

namespace scabo::geometry {

namespace {

/// P_n(x) and P_n-1(x), Legendre's polynomials, by the three-term recurrence.
struct Legendre {
  double value, previous;
  double slope(int n, double x) const { return n * (x * value - previous) / (x * x - 1.0); }  ///< P_n'(x), |x| < 1
};

Legendre legendre(int n, double x) {
  double previous = 1.0, value = x;  // P_0, P_1
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, previous};
}

}  // namespace

std::vector<double> lobatto_points(int order) {
  ensure(order >= 1, "the order of a line element is at least 1");
  const auto p = static_cast<std::size_t>(order);
  std::vector<double> points(p + 1, 0.0);
  points.front() = -1.0;
  points.back() = 1.0;
  // The upper half by Newton's method, the lower half by reflection: exactly symmetric. For an even order the middle
  // point remains exactly 0.
  for (std::size_t i = 1; 2 * i < p; ++i) {
    double x = std::cos(std::numbers::pi * static_cast<double>(i) / order);  // Chebyshev points are close
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Legendre at = legendre(order, x);
      // (1 - x^2) P_p' = p (P_{p-1} - x P_p), and its derivative is -p (p + 1) P_p.
      const double step = (at.previous - x * at.value) / ((order + 1) * at.value);
      x += step;
      if (std::abs(step) < 1e-16) break;
    }
    points[p - i] = x;
    points[i] = -x;
  }
  return points;
}

GaussRule gauss_rule(int count) {
  GaussRule rule{std::vector<double>(static_cast<std::size_t>(count)),
                 std::vector<double>(static_cast<std::size_t>(count))};
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Legendre at = legendre(count, x);
      const double step = at.value / at.slope(count, x);
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    const double slope = legendre(count, x).slope(count, x);  // of the final x: the weight depends on its square
    rule.points[static_cast<std::size_t>(i)] = x;
    rule.weights[static_cast<std::size_t>(i)] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

LineBasis::LineBasis(int order) : order_(order), points_(lobatto_points(order)), rule_(gauss_rule(order + 2)) {
  for (std::size_t j = 0; j < points_.size(); ++j) {
    double product = 1.0;
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (k != j) product *= points_[j] - points_[k];
    barycentric_.push_back(1.0 / product);
  }
  std::vector<double> legendre_at;
  for (const double point : points_) {
    legendre_at.push_back(legendre(order, point).value);
    weights_.push_back(2.0 / (order * (order + 1) * legendre_at.back() * legendre_at.back()));
  }
  at_nodes_ = Matrix::Zero(nodes(), nodes());
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (std::size_t j = 0; j < points_.size(); ++j)
      if (i != j)
        at_nodes_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            legendre_at[i] / (legendre_at[j] * (points_[i] - points_[j]));
  at_nodes_(0, 0) = -0.25 * order * (order + 1);
  at_nodes_(order, order) = 0.25 * order * (order + 1);
  const auto count = static_cast<Eigen::Index>(rule_.points.size());
  N_.resize(count, nodes());
  N_eta_.resize(count, nodes());
  for (Eigen::Index q = 0; q < count; ++q) {
    N_.row(q) = values(rule_.points[static_cast<std::size_t>(q)]);
    N_eta_.row(q) = derivatives(rule_.points[static_cast<std::size_t>(q)]);
  }
}

// Products, not quotients: no special case at the nodes; p is small.
Vector LineBasis::values(double eta) const {
  Vector N(nodes());
  for (std::size_t j = 0; j < points_.size(); ++j) {
    double product = barycentric_[j];
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (k != j) product *= eta - points_[k];
    N[static_cast<Eigen::Index>(j)] = product;
  }
  return N;
}

Vector LineBasis::derivatives(double eta) const {
  Vector N_eta = Vector::Zero(nodes());
  for (std::size_t j = 0; j < points_.size(); ++j)
    for (std::size_t left_out = 0; left_out < points_.size(); ++left_out) {
      if (left_out == j) continue;
      double product = barycentric_[j];
      for (std::size_t k = 0; k < points_.size(); ++k)
        if (k != j && k != left_out) product *= eta - points_[k];
      N_eta[static_cast<Eigen::Index>(j)] += product;
    }
  return N_eta;
}

Matrix LineBasis::values_at(const std::vector<double>& at) const {
  Matrix N(static_cast<Eigen::Index>(at.size()), nodes());
  for (std::size_t k = 0; k < at.size(); ++k) N.row(static_cast<Eigen::Index>(k)) = values(at[k]);
  return N;
}

const LineBasis& LineBasis::of_order(int order) {
  constexpr int highest = 64;
  static std::array<std::unique_ptr<LineBasis>, highest + 1> made;
  static std::mutex lock;
  ensure(order >= 1 && order <= highest, "the order of a boundary element is out of range");
  const std::scoped_lock guard(lock);
  auto& basis = made[static_cast<std::size_t>(order)];
  if (!basis) basis = std::make_unique<LineBasis>(order);
  return *basis;
}

}  // namespace scabo::geometry
