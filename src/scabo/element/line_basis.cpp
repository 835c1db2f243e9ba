#include "scabo/element/line_basis.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>

#include "scabo/base/error.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::element {

namespace {

/// Legendre polynomial of degree n and its derivative at |x| < 1.
std::pair<double, double> legendre(int n, double x) {
  double previous = 1.0, value = x;  // P_0, P_1
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (x * value - previous) / (x * x - 1.0)};
}

}  // namespace

GaussRule gauss_rule(int count) {
  GaussRule rule{std::vector<double>(static_cast<std::size_t>(count)),
                 std::vector<double>(static_cast<std::size_t>(count))};
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    for (int iteration = 0; iteration < 100; ++iteration) {
      const auto [value, slope] = legendre(count, x);
      const double step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    const double slope = legendre(count, x).second;  // of the final x: the weight depends on its square
    rule.points[static_cast<std::size_t>(i)] = x;
    rule.weights[static_cast<std::size_t>(i)] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

LineBasis::LineBasis(int order) : order_(order), points_(mesh::lobatto_points(order)), rule_(gauss_rule(order + 2)) {
  for (std::size_t j = 0; j < points_.size(); ++j) {
    double product = 1.0;
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (k != j) product *= points_[j] - points_[k];
    barycentric_.push_back(1.0 / product);
  }
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

}  // namespace scabo::element
