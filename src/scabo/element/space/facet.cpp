#include "scabo/element/space/facet.hpp"

#include <Eigen/Geometry>

#include "scabo/geometry/facet_basis.hpp"

namespace scabo::element {

namespace {

/// Calls add(N times the weight of a place, x,eta cross x,zeta) at all places of the rule.
template <typename Add>
void over_facet(const Matrix& nodes, const Add& add) {
  const geometry::FacetBasis& basis = geometry::FacetBasis::of(static_cast<int>(nodes.cols()));
  for (Eigen::Index i = 0; i < basis.rule().weights.size(); ++i) {
    const Vec2 place = basis.rule().places.col(i);
    const Eigen::Matrix<double, 3, 2> tangents = nodes * basis.derivatives(place);
    const Eigen::Vector3d a = tangents.col(0), b = tangents.col(1);
    add(Vector(basis.rule().weights[i] * basis.values(place)), Eigen::Vector3d(a.cross(b)));
  }
}

}  // namespace

Vector area_weights(const Matrix& nodes) {
  Vector weights = Vector::Zero(nodes.cols());
  over_facet(nodes, [&](const Vector& N, const Eigen::Vector3d& area) { weights += area.norm() * N; });
  return weights;
}

Matrix normal_weights(const Matrix& nodes) {
  Matrix weights = Matrix::Zero(3, nodes.cols());
  over_facet(nodes, [&](const Vector& N, const Eigen::Vector3d& area) { weights += area * N.transpose(); });
  return weights;
}

Matrix traction_integrals(const Matrix& nodes, const TractionAt& traction) {
  Matrix forces = Matrix::Zero(3, nodes.cols());
  over_facet(nodes, [&](const Vector& N, const Eigen::Vector3d& area) {  // N times the weight of the point
    const Eigen::Vector3d point = nodes * N / N.sum();
    forces += area.norm() * traction(point, area.normalized()) * N.transpose();
  });
  return forces;
}

}  // namespace scabo::element
