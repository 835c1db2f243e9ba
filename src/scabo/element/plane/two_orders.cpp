#include "scabo/element/plane/two_orders.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::element {

namespace {

int order_of(const mesh::LineElement& element) { return static_cast<int>(element.nodes.size()) - 1; }

/// Points and weights of the integral over xi from 0 to 1: two Gauss points in each of the intervals between 1 -
/// ratio^k.
struct RadialPoint {
  double xi, weight;
};
std::vector<RadialPoint> radial_points() {
  constexpr int intervals = 16;
  constexpr double ratio = 0.35;  // the last interval is 5e-8 wide
  const geometry::GaussRule rule = geometry::gauss_rule(2);
  std::vector<RadialPoint> points;
  double width = 1.0;
  for (int k = 0; k < intervals; ++k) {
    const double from = 1.0 - width, to = k + 1 == intervals ? 1.0 : 1.0 - ratio * width;
    for (std::size_t q = 0; q < 2; ++q)
      points.push_back({0.5 * (from + to) + 0.5 * (to - from) * rule.points[q], 0.5 * (to - from) * rule.weights[q]});
    width *= ratio;
  }
  return points;
}

}  // namespace

Vector prolonged(const std::vector<mesh::LineElement>& from, const Vector& u, const std::vector<mesh::LineElement>& to,
                 Eigen::Index size) {
  ensure(from.size() == to.size(), "both boundaries have the same elements");
  Vector result = Vector::Zero(size);
  for (std::size_t e = 0; e < from.size(); ++e) {
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(order_of(from[e]));
    const std::vector<double> points = geometry::lobatto_points(order_of(to[e]));
    const bool same = order_of(from[e]) == order_of(to[e]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec2 value = Vec2::Zero();
      if (same) {
        value = u.segment<2>(place_of(from[e].nodes[i]));
      } else {
        const Vector N = basis.values(points[i]);
        for (std::size_t j = 0; j < from[e].nodes.size(); ++j)
          value += N[static_cast<Eigen::Index>(j)] * u.segment<2>(place_of(from[e].nodes[j]));
      }
      result.segment<2>(place_of(to[e].nodes[i])) = value;
    }
  }
  return result;
}

double squared_difference(const TwoOrders& two) {
  const Vector Pu = prolonged(two.elements, two.u, two.wider_elements, two.U.size());
  const Vector e = two.U - Pu;
  double squared = std::max(0.0, e.dot(two.K * e));
  if (two.relaxed) squared += std::max(0.0, two.u.dot(two.k * two.u) - Pu.dot(two.K * Pu));  // eq. (1)
  return squared;
}

std::vector<double> sector_differences(const SuperElementField& narrower, const SuperElementField& wider,
                                       const Elasticity& D) {
  const RadialField u(narrower.solution, narrower.modal, narrower.u, {}), U(wider.solution, wider.modal, wider.u, {});
  const bool unbounded = wider.solution.domain.unbounded;
  std::vector<double> energies(wider.ring.elements.size(), 0.0);
  // Unbounded: xi = 1 / s, xi dxi = ds / s^3.
  const std::vector<RadialPoint> radial = radial_points();
  std::vector<double> xis;
  for (const RadialPoint& point : radial) xis.push_back(unbounded ? 1.0 / point.xi : point.xi);
  const std::vector<RadialField::Values> of_u = u.at(xis);
  std::vector<RadialField::Values> of_U = U.at(xis);
  for (std::size_t i = 0; i < radial.size(); ++i) {
    const double s = radial[i].xi, measure = radial[i].weight * (unbounded ? 1.0 / (s * s * s) : s);
    RadialField::Values& difference = of_U[i];
    const auto subtract = [&](Vector& from, const Vector& values) {
      from -= prolonged(narrower.ring.elements, values, wider.ring.elements, from.size());
    };
    subtract(difference.u, of_u[i].u);
    subtract(difference.u_xi, of_u[i].u_xi);
    subtract(difference.u_part, of_u[i].u_part);
    for (std::size_t e = 0; e < energies.size(); ++e) {
      const mesh::LineElement& element = wider.ring.elements[e];
      const geometry::GaussRule rule = geometry::gauss_rule(order_of(element) + 1);
      // J| varies little compared with the difference: for relative shares, that of the chord is sufficient.
      const double area = std::abs(cross(wider.ring.nodes[static_cast<std::size_t>(element.nodes.front())],
                                         wider.ring.nodes[static_cast<std::size_t>(element.nodes.back())]));
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const PointValues values = point_values(wider.ring, difference, D, static_cast<int>(e), rule.points[q]);
        energies[e] += measure * rule.weights[q] * area * values.stress.dot(values.strain);
      }
    }
  }
  return energies;
}

}  // namespace scabo::element
