#include "scabo/element/space/facet.hpp"

#include <Eigen/Geometry>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/geometry/simplex_basis.hpp"

namespace scabo::element {

namespace {

/// Calls add(N times the weight of a point, x,xi_1 cross x,xi_2 / 2) at all points of the rule.
template <typename Add>
void over_facet(const Matrix& nodes, const Add& add) {
  const geometry::SimplexBasis& basis = geometry::SimplexBasis::of(2, static_cast<int>(nodes.cols()));
  for (Eigen::Index i = 0; i < basis.rule().weights.size(); ++i) {
    const Vector lambda = basis.rule().points.col(i);
    const Eigen::Matrix<double, 3, 2> tangents = nodes * basis.derivatives(lambda);
    const Eigen::Vector3d a = tangents.col(0), b = tangents.col(1);
    add(Vector(basis.rule().weights[i] * basis.values(lambda)), Eigen::Vector3d(0.5 * a.cross(b)));
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
  const geometry::SimplexBasis& basis = geometry::SimplexBasis::of(2, static_cast<int>(nodes.cols()));
  const geometry::GaussRule rule = geometry::gauss_rule(4);  // N, N and the Jacobian of the conical map: degree 5
  const Eigen::Index n = nodes.cols();
  Matrix K = Matrix::Zero(3 * n, 3 * n);
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    for (std::size_t j = 0; j < rule.points.size(); ++j) {
      const double r = 0.5 * (1.0 + rule.points[i]), s = 0.5 * (1.0 + rule.points[j]) * (1.0 - r);
      const Vector lambda = Eigen::Vector3d(1.0 - r - s, r, s), N = basis.values(lambda);
      const Eigen::Matrix<double, 3, 2> tangents = nodes * basis.derivatives(lambda);
      const Eigen::Vector3d a = tangents.col(0), b = tangents.col(1), area = a.cross(b), normal = area.normalized();
      const double weight = 0.25 * rule.weights[i] * rule.weights[j] * (1.0 - r) * area.norm();
      const Eigen::Matrix3d k =
          weight * (k_t * Eigen::Matrix3d::Identity() + (k_n - k_t) * normal * normal.transpose());
      for (Eigen::Index row = 0; row < n; ++row)
        for (Eigen::Index column = 0; column < n; ++column)
          K.block<3, 3>(3 * row, 3 * column) += N[row] * N[column] * k;
    }
  return K;
}

}  // namespace scabo::element
