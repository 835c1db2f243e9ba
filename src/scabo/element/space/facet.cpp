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

Matrix spring_integrals(const Matrix& nodes, double k_n, double k_t) {
  const geometry::FacetBasis& basis = geometry::FacetBasis::of(static_cast<int>(nodes.cols()));
  const geometry::FacetRule& rule = basis.finer_rule();  // of N times N and the change of area
  const Eigen::Index n = nodes.cols();
  Matrix K = Matrix::Zero(3 * n, 3 * n);
  for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
    const Vec2 place = rule.places.col(i);
    const Vector N = basis.values(place);
    const Eigen::Matrix<double, 3, 2> tangents = nodes * basis.derivatives(place);
    const Eigen::Vector3d a = tangents.col(0), b = tangents.col(1), area = a.cross(b), normal = area.normalized();
    const Eigen::Matrix3d k =
        rule.weights[i] * area.norm() * (k_t * Eigen::Matrix3d::Identity() + (k_n - k_t) * normal * normal.transpose());
    for (Eigen::Index row = 0; row < n; ++row)
      for (Eigen::Index column = 0; column < n; ++column) K.block<3, 3>(3 * row, 3 * column) += N[row] * N[column] * k;
  }
  return K;
}

}  // namespace scabo::element
