#include "scabo/system/rigid_motions.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::system {

Eigen::Matrix<double, 2, 3> rigid_point(const Vec2& x, const Vec2& reference, double lever) {
  const Vec2 arm = (x - reference) / lever;
  Eigen::Matrix<double, 2, 3> map;
  map << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  return map;
}

std::string describe_motion(const Eigen::Vector3d& motion, const Vec2& reference, double lever) {
  constexpr double shown_as_zero = 1e-6;  // of the largest part: motions of many bodies are found to about 1e-8
  const double rotation = motion[2] / lever;
  const Vec2 shift = motion.head<2>();
  if (std::abs(motion[2]) <= shown_as_zero * shift.norm()) {
    Vec2 along = shift.normalized();
    for (Eigen::Index i = 0; i < 2; ++i)
      if (std::abs(along[i]) < shown_as_zero) along[i] = 0.0;
    return fmt::format("translation along ({:.4g}, {:.4g})", along.x(), along.y());
  }
  // The point that stays: shift + rotation x arm = 0.
  Vec2 pole = reference + Vec2(-shift.y(), shift.x()) / rotation;
  for (Eigen::Index i = 0; i < 2; ++i)
    if (std::abs(pole[i]) < shown_as_zero * lever) pole[i] = 0.0;
  return fmt::format("rotation about ({:.4g}, {:.4g})", pole.x(), pole.y());
}

Matrix null_space(const Matrix& A) {
  const Eigen::Index n = A.cols();
  if (A.rows() == 0) return Matrix::Identity(n, n);
  const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k)
    if (svd.singularValues()[k] > 1e-9 * svd.singularValues()[0]) ++rank;
  return svd.matrixV().rightCols(n - rank);
}

Matrix at_rest(const Matrix& free, const std::vector<HeldDirection>& springs, const Vec2& reference, double lever) {
  if (springs.empty() || free.cols() == 0) return free;
  Matrix gram = Matrix::Zero(3, 3);  // of the rows: all springs count alike, however soft they are
  for (const HeldDirection& held : springs) {
    const Eigen::RowVector3d row = held.direction.transpose() * rigid_point(held.point, reference, lever);
    gram += row.transpose() * row;
  }
  // Columns along which the rows vanish. Squares: 1e-12 stands for arms of 1e-6 of the body.
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(free.transpose() * gram * free);
  Eigen::Index still = 0;
  while (still < free.cols() && eigen.eigenvalues()[still] <= 1e-12 * gram.trace()) ++still;
  return free * eigen.eigenvectors().leftCols(still);
}

Matrix at_rest(const Matrix& free, const Matrix& S) {
  if (free.cols() == 0) return free;
  constexpr double none = 1e-12;  // of the stiffness along all motions, which are lengths
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(free.transpose() * S * free);
  Eigen::Index still = 0;
  while (still < free.cols() && eigen.eigenvalues()[still] <= none * S.trace()) ++still;
  return free * eigen.eigenvectors().leftCols(still);
}

Matrix free_motions(const std::vector<Vec2>& nodes, const std::vector<Constraint>& constraints,
                    const std::vector<HeldDirection>& springs, Vec2& reference, double& lever, bool revolved) {
  Vec2 low = nodes.front(), high = nodes.front();
  for (const Vec2& x : nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  reference = 0.5 * (low + high);
  lever = 0.5 * (high - low).norm();
  const auto count = static_cast<Eigen::Index>(constraints.size());
  Matrix held = Matrix::Zero(count + (revolved ? 2 : 0), 3);
  for (std::size_t c = 0; c < constraints.size(); ++c)
    held.row(static_cast<Eigen::Index>(c)) =
        constraints[c].direction().transpose() *
        rigid_point(nodes[static_cast<std::size_t>(plane_components.node_of(constraints[c].dof))], reference, lever);
  if (revolved) held(count, 0) = held(count + 1, 2) = 1.0;
  return at_rest(null_space(held), springs, reference, lever);
}

RigidMotionsInSpace::RigidMotionsInSpace(const Matrix& nodes)
    : nodes_(nodes),
      reference_(0.5 * (nodes.rowwise().minCoeff() + nodes.rowwise().maxCoeff())),
      lever_(0.5 * (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm()) {}

Eigen::Matrix<double, 1, 6> RigidMotionsInSpace::along(Eigen::Index dof) const {
  constexpr Components space{3};
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(space.component_of(dof)),
                        arm = (nodes_.col(space.node_of(dof)) - reference_) / lever_;
  Eigen::Matrix<double, 1, 6> motion;
  motion << axis.transpose(), arm.cross(axis).transpose();  // axis . (rotation x arm) = rotation . (arm x axis)
  return motion;
}

void add_reactions(const std::vector<Constraint>& constraints, const Vector& reactions, Vector& forces) {
  for (std::size_t c = 0; c < constraints.size(); ++c)
    forces.segment<2>(plane_components.first_of_node(constraints[c].dof)) +=
        reactions[static_cast<Eigen::Index>(c)] * constraints[c].direction();
}

}  // namespace scabo::system
