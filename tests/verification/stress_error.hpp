// Error of a super-element's stress in the energy norm, by quadrature of the difference from a field that is known:
// nothing cancels, so that errors down to 1e-12 can be told, where energies tell them to 1e-7.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "scabo/element/plane/interior_field.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::test {

/// sqrt(int (s_h - s)' D^-1 (s_h - s) / int s' D^-1 s) over a bounded body, s the exact stress about the scaling
/// centre.
inline double stress_error(const element::Ring& ring, const element::RadialField& field, const element::Mat3& D,
                           const std::function<element::Vec3(const Vec2&)>& exact) {
  const element::Mat3 S = D.inverse();
  const geometry::GaussRule radial = geometry::gauss_rule(4);
  double difference = 0.0, whole = 0.0, width = 1.0;
  for (int interval = 0; interval < 14; ++interval, width *= 0.4) {  // modes of high exponent live near the boundary
    const double from = 1.0 - width, to = interval == 13 ? 1.0 : 1.0 - 0.4 * width;
    for (std::size_t r = 0; r < radial.points.size(); ++r) {
      const double xi = 0.5 * (from + to) + 0.5 * (to - from) * radial.points[r];
      const auto values = field.at(xi);
      for (std::size_t e = 0; e < ring.elements.size(); ++e) {
        const int order = static_cast<int>(ring.elements[e].nodes.size()) - 1;
        const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
        const geometry::GaussRule rule = geometry::gauss_rule(order + 4);
        for (std::size_t q = 0; q < rule.points.size(); ++q) {
          const double eta = rule.points[q];
          const auto at = element::boundary_point(ring, ring.elements[e], basis.values(eta), basis.derivatives(eta));
          const double dA = 0.5 * (to - from) * radial.weights[r] * rule.weights[q] * xi * cross(at.x, at.x_eta);
          const element::Vec3 s = exact(xi * at.x),
                              d = element::point_values(ring, values, D, static_cast<int>(e), eta).stress - s;
          difference += dA * d.dot(S * d);
          whole += dA * s.dot(S * s);
        }
      }
    }
  }
  return std::sqrt(difference / whole);
}

}  // namespace scabo::test
