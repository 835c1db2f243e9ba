#include "scabo/element/space/tetrahedron.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "scabo/base/components.hpp"

namespace scabo::element {

namespace {

constexpr Components space{3};

using StrainMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 30>;

const geometry::SimplexBasis& tetrahedron_basis(const Matrix& nodes) {
  return geometry::SimplexBasis::of(3, static_cast<int>(nodes.cols()));
}

/// B of the gradients, n x 3.
StrainMatrix strain_matrix_in_space(const Matrix& gradients) {
  StrainMatrix B = StrainMatrix::Zero(6, space.count(gradients.rows()));
  for (Eigen::Index i = 0; i < gradients.rows(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      B(k, space.of(i, k)) = gradients(i, k);
      B(3 + k, space.of(i, k)) = gradients(i, next);
      B(3 + k, space.of(i, next)) = gradients(i, k);
    }
  return B;
}

/// The gradients at a point, n x 3, and the Jacobian there.
struct Gradients {
  Matrix values;
  double jacobian;
};
Gradients gradients_at(const Matrix& nodes, const Vector& lambda) {
  const Matrix by_xi = tetrahedron_basis(nodes).derivatives(lambda);
  const Eigen::Matrix3d J = nodes * by_xi;  // x,xi
  return {by_xi * J.inverse(), J.determinant()};
}

}  // namespace

Mat6 elasticity_in_space(double young, double poisson) {
  const double shear = young / (2.0 * (1.0 + poisson)), lame = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
  Mat6 D = Mat6::Zero();
  D.topLeftCorner<3, 3>().setConstant(lame);
  D.diagonal() << Eigen::Vector3d::Constant(lame + 2.0 * shear), Eigen::Vector3d::Constant(shear);
  return D;
}

Matrix tetrahedron_stiffness(const Matrix& nodes, const Mat6& D) {
  const geometry::SimplexRule& rule = tetrahedron_basis(nodes).rule();
  Matrix K = Matrix::Zero(space.count(nodes.cols()), space.count(nodes.cols()));
  for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
    const Gradients at = gradients_at(nodes, rule.points.col(i));
    const StrainMatrix B = strain_matrix_in_space(at.values);
    K.noalias() += (rule.weights[i] * at.jacobian / 6.0) * (B.transpose() * (D * B));  // 6: volume of lambda is 1/6
  }
  return 0.5 * (K + K.transpose());
}

Vector volume_weights(const Matrix& nodes) {
  const geometry::SimplexBasis& basis = tetrahedron_basis(nodes);
  Vector weights = Vector::Zero(nodes.cols());
  for (Eigen::Index i = 0; i < basis.rule().weights.size(); ++i) {
    const Vector lambda = basis.rule().points.col(i);
    const Eigen::Matrix3d J = nodes * basis.derivatives(lambda);
    weights += basis.rule().weights[i] * J.determinant() / 6.0 * basis.values(lambda);
  }
  return weights;
}

Vector forces_of_stress(const Matrix& nodes, const Vec6& stress, const Vector& T) {
  const geometry::SimplexBasis& basis = tetrahedron_basis(nodes);
  const geometry::SimplexRule& rule = basis.rule();
  Vector forces = Vector::Zero(space.count(nodes.cols()));
  for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
    const Vector lambda = rule.points.col(i);
    const Gradients at = gradients_at(nodes, lambda);
    forces += (rule.weights[i] * at.jacobian / 6.0 * T.dot(basis.values(lambda))) *
              (strain_matrix_in_space(at.values).transpose() * stress);
  }
  return forces;
}

double integral_of_square(const Matrix& nodes, const Vector& T) {
  const geometry::SimplexBasis& basis = tetrahedron_basis(nodes);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < basis.rule().weights.size(); ++i) {
    const Vector lambda = basis.rule().points.col(i);
    const Eigen::Matrix3d J = nodes * basis.derivatives(lambda);
    const double value = T.dot(basis.values(lambda));
    sum += basis.rule().weights[i] * J.determinant() / 6.0 * value * value;
  }
  return sum;
}

double least_jacobian(const Matrix& nodes) {
  const geometry::SimplexBasis& basis = tetrahedron_basis(nodes);
  Matrix points(4, 4 + static_cast<Eigen::Index>(basis.edges().size()) + basis.rule().weights.size());
  points.leftCols<4>().setIdentity();
  for (std::size_t e = 0; e < basis.edges().size(); ++e) {
    points.col(4 + static_cast<Eigen::Index>(e)).setZero();
    for (const int corner : basis.edges()[e]) points(corner, 4 + static_cast<Eigen::Index>(e)) = 0.5;
  }
  points.rightCols(basis.rule().weights.size()) = basis.rule().points;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    least = std::min(least, Eigen::Matrix3d(nodes * basis.derivatives(points.col(i))).determinant());
  const double size = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).maxCoeff();
  return least / (size * size * size);
}

Vec6 strain_at(const Matrix& nodes, const Vector& u, const Vector& lambda) {
  return strain_matrix_in_space(gradients_at(nodes, lambda).values) * u;
}

}  // namespace scabo::element
