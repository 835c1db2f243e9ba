#include "scabo/element/plane/interior_field.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::element {

namespace {

const mesh::LineElement& element_at(const Ring& ring, int element) {
  return ring.elements[static_cast<std::size_t>(element)];
}

const geometry::LineBasis& basis_at(const Ring& ring, int element) {
  return geometry::LineBasis::of_order(static_cast<int>(element_at(ring, element).nodes.size()) - 1);
}

Vec2 interpolate(const Ring& ring, int element, const Vector& N) {
  Vec2 x = Vec2::Zero();
  const auto& nodes = element_at(ring, element).nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x += N[static_cast<Eigen::Index>(i)] * ring.nodes[static_cast<std::size_t>(nodes[i])];
  return x;
}

}  // namespace

Vec2 boundary_position(const Ring& ring, int element, double eta) {
  return interpolate(ring, element, basis_at(ring, element).values(eta));
}

std::optional<ScaledPoint> locate(const Ring& ring, const Vec2& x, bool unbounded) {
  if (x.norm() == 0.0) return unbounded ? std::nullopt : std::optional(ScaledPoint{0.0, 0, 0.0});
  constexpr double slack = 1e-9;  // points on the boundary between two elements belong to one of them
  for (int e = 0; e < static_cast<int>(ring.elements.size()); ++e) {
    const auto& nodes = element_at(ring, e).nodes;
    const Vec2& first = ring.nodes[static_cast<std::size_t>(nodes.front())];
    const Vec2& last = ring.nodes[static_cast<std::size_t>(nodes.back())];
    if (cross(first, x) < -slack * first.norm() * x.norm() || cross(x, last) < -slack * last.norm() * x.norm() ||
        (x.dot(first) <= 0.0 && x.dot(last) <= 0.0))  // an element spans less than 180 degrees
      continue;
    // The ray meets the element where cross(x_b(eta), x) = 0; this decreases with eta, since |J| > 0.
    const geometry::LineBasis& basis = basis_at(ring, e);
    double low = -1.0, high = 1.0;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (low + high);
      (cross(interpolate(ring, e, basis.values(middle)), x) > 0.0 ? low : high) = middle;
    }
    const double eta = 0.5 * (low + high);
    const double xi = x.norm() / interpolate(ring, e, basis.values(eta)).norm();
    if (unbounded ? xi < 1.0 - slack : xi > 1.0 + slack) return std::nullopt;
    return ScaledPoint{unbounded ? std::max(xi, 1.0) : std::min(xi, 1.0), e, eta};
  }
  return std::nullopt;
}

PointValues point_values(const Ring& ring, const RadialField::Values& values, const Elasticity& D, int element,
                         double eta, const Vec3& initial_strain) {
  const geometry::LineBasis& basis = basis_at(ring, element);
  const mesh::LineElement& line = element_at(ring, element);
  const Vector N = basis.values(eta);
  const StrainMatrices matrices = strain_matrices(ring, line, N, basis.derivatives(eta));
  PointValues point;
  for (std::size_t i = 0; i < line.nodes.size(); ++i) {
    const auto local = place_of(i), global = place_of(line.nodes[i]);
    point.displacement += N[static_cast<Eigen::Index>(i)] * values.u.segment<2>(global);
    point.strain += matrices.B1.middleCols<2>(local) * values.u_xi.segment<2>(global) +
                    matrices.B2.middleCols<2>(local) * values.u_part.segment<2>(global);
  }
  point.stress = D.of(static_cast<std::size_t>(element)) * (point.strain - initial_strain);
  return point;
}

}  // namespace scabo::element
