#include "scabo/element/two_orders.hpp"

#include <algorithm>

#include "scabo/element/line_basis.hpp"

namespace scabo::element {

namespace {

int order_of(const mesh::LineElement& element) { return static_cast<int>(element.nodes.size()) - 1; }

/// The coefficient of eta^q of the polynomial through values at the points (a divided difference), as weights of the values.
Vector leading_weights(const std::vector<double>& points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Vector weights = Vector::Ones(count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      if (i != j) weights[i] /= points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)];
  return weights;
}

double legendre(int order, double x) {
  double before = 1.0, value = x;
  if (order == 0) return before;
  for (int k = 2; k <= order; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return value;
}

/// b.r of one element.
double share_of(const mesh::LineElement& element, const Vector& e, const Vector& force) {
  const int order = order_of(element);
  const std::vector<double> points = mesh::lobatto_points(order);
  const Vector weights = leading_weights(points);
  Vector phi(order + 1);
  for (int i = 0; i <= order; ++i) {
    const double x = points[static_cast<std::size_t>(i)];
    phi[i] = legendre(order, x) - legendre(order - 2, x);
  }
  phi /= weights.dot(phi);
  Vec2 b = Vec2::Zero(), r = Vec2::Zero();
  for (int i = 0; i <= order; ++i) {
    const int node = element.nodes[static_cast<std::size_t>(i)];
    b += weights[i] * e.segment<2>(2 * node);
    r += phi[i] * force.segment<2>(2 * node);
  }
  return std::max(0.0, b.dot(r));
}

}  // namespace

Vector prolonged(const std::vector<mesh::LineElement>& from, const Vector& u, const std::vector<mesh::LineElement>& to,
                 Eigen::Index size) {
  ensure(from.size() == to.size(), "both boundaries have the same elements");
  Vector result = Vector::Zero(size);
  for (std::size_t e = 0; e < from.size(); ++e) {
    const LineBasis& basis = LineBasis::of_order(order_of(from[e]));
    const std::vector<double> points = mesh::lobatto_points(order_of(to[e]));
    const bool same = order_of(from[e]) == order_of(to[e]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec2 value = Vec2::Zero();
      if (same) {
        value = u.segment<2>(2 * from[e].nodes[i]);
      } else {
        const Vector N = basis.values(points[i]);
        for (std::size_t j = 0; j < from[e].nodes.size(); ++j)
          value += N[static_cast<Eigen::Index>(j)] * u.segment<2>(2 * from[e].nodes[j]);
      }
      result.segment<2>(2 * to[e].nodes[i]) = value;
    }
  }
  return result;
}

OrderDifference order_difference(const TwoOrders& two) {
  const Vector Pu = prolonged(two.elements, two.u, two.wider_elements, two.U.size());
  const Vector e = two.U - Pu, force = two.K * e;
  OrderDifference difference;
  difference.squared = std::max(0.0, e.dot(force));
  if (two.relaxed) difference.squared += std::max(0.0, two.u.dot(two.k * two.u) - Pu.dot(two.K * Pu));   // eq. (1)
  double sum = 0.0;
  for (std::size_t i = 0; i < two.elements.size(); ++i) {
    const bool stays = order_of(two.elements[i]) == order_of(two.wider_elements[i]);
    difference.elements.push_back(stays ? 0.0 : share_of(two.wider_elements[i], e, force));
    sum += difference.elements.back();
  }
  for (double& share : difference.elements)
    share = sum > 0.0 ? share * difference.squared / sum : difference.squared / static_cast<double>(two.elements.size());
  return difference;
}

}  // namespace scabo::element
