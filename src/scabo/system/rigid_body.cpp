// The rigid part of a structure: three degrees of freedom, on supports and springs.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/body_system.hpp"
#include "scabo/system/rigid_motions.hpp"

namespace scabo::system {

namespace {

class RigidBody final : public BodySystem {
 public:
  RigidBody(const Vec2& reference, double size, std::vector<Constraint> constraints, Springs springs, bool revolved)
      : springs_(std::move(springs)), revolved_(revolved) {
    constraints_ = std::move(constraints);
    reference_ = reference;
    lever_ = size;
    held_.resize(static_cast<Eigen::Index>(constraints_.size()), 3);
    for (std::size_t c = 0; c < constraints_.size(); ++c) {
      const Constraint& constraint = constraints_[c];
      held_.row(static_cast<Eigen::Index>(c)) =
          constraint.rotation ? Eigen::RowVector3d(0.0, 0.0, 1.0)
                              : Eigen::RowVector3d(constraint.direction().transpose() *
                                                   rigid_point(constraint.point, reference_, lever_));
    }
    if (revolved_) held_.col(0).setZero(), held_.col(2).setZero();
    const Matrix left_by_supports = left_free();
    rigid_motions_ = rigid_coordinates_ = at_rest(left_by_supports, springs_.directions, reference_, lever_);
    constrained_.compute(held_);
    if (!springs_.none()) find_flexibility(left_by_supports);
  }

  Eigen::Index size() const override { return 3; }
  bool is_revolved() const override { return revolved_; }

  Displaced displaced(const Vector& f, const Vector& prescribed, const Balanced&, const BegunSolve*) const override {
    Vector u = Vector::Zero(3);
    if (held_.rows() > 0) u = constrained_.solve(prescribed);
    if (is_flexible())
      for (int round = 0; round < 2; ++round)  // the second refines
        u += flexibility_ * (f - springs_.matrix * u);
    return {std::move(u), {}};
  }

  Vector displacement_at(const Vector& f, const Vector& prescribed, const std::vector<int>&,
                         BegunSolve*) const override {
    return displacement(f, prescribed);
  }

  Matrix flexibility(const std::vector<int>& dofs) const override {
    const auto n = static_cast<Eigen::Index>(dofs.size());
    return is_flexible() ? Matrix(flexibility_(dofs, dofs)) : Matrix(Matrix::Zero(n, n));
  }

  Matrix flexibility_by_factor(const std::vector<int>& dofs) const override { return flexibility(dofs); }
  Vector flexed(const std::vector<int>& dofs, const Vector& forces) const override {
    return flexibility(dofs) * forces;
  }

  /// v: the motions that springs resist, then the free ones.
  FreeStiffness free_stiffness() const override {
    const Matrix Y = resisted_motions(left_free());
    const Eigen::Index resisted = Y.cols(), m = rigid_motions_.cols();
    FreeStiffness free;
    Matrix map(3, resisted + m), K = Matrix::Zero(resisted + m, resisted + m);
    map << Y, rigid_motions_;
    if (resisted > 0) K.topLeftCorner(resisted, resisted) = Y.transpose() * (springs_.matrix * Y);
    free.map = map.sparseView();
    free.K = K.sparseView();
    free.dofs.assign(static_cast<std::size_t>(resisted + m), 0);
    for (Eigen::Index k = 0; k < m; ++k) free.further.push_back(static_cast<int>(resisted + k));
    free.motions = Matrix::Identity(m, m);
    return free;
  }
  double operations() const override { return 0.0; }

  Vector unbalanced(const Vector& u, const Vector& f) const override {
    Vector left = -(f + spring_forces(u));
    if (revolved_) left[0] = left[2] = 0.0;  // in balance around the axis
    return left;
  }

  Vector reactions_of(const Vector& unbalanced) const override {
    if (held_.rows() == 0) return Vector();
    return Matrix(held_.transpose()).completeOrthogonalDecomposition().solve(unbalanced);
  }

  double imbalance_of(const Vector& unbalanced) const override {
    if (held_.rows() == 0) return unbalanced.lpNorm<Eigen::Infinity>();
    return (held_.transpose() * reactions_of(unbalanced) - unbalanced).lpNorm<Eigen::Infinity>();
  }

  double elastic_energy(const Vector& u) const override { return -0.5 * u.dot(spring_forces(u)); }
  double elastic_energy(const Vector& u, const Vector&, const Vector&) const override { return elastic_energy(u); }
  double energy_lost(const Vector&) const override { return 0.0; }
  double stiff_force(const Vector&) const override { return 0.0; }
  Vector spring_forces(const Vector& u) const override { return -springs_.times(u); }
  bool is_flexible() const override { return flexibility_.size() > 0; }
  bool has_springs() const override { return !springs_.none(); }

  /// Largest amount by which the constraints contradict each other at factor 1, and the constraint.
  std::pair<double, std::size_t> contradiction() const {
    Vector values(held_.rows());
    for (std::size_t c = 0; c < constraints_.size(); ++c) values[static_cast<Eigen::Index>(c)] = constraints_[c].value;
    if (values.size() == 0) return {0.0, 0};
    Eigen::Index worst = 0;
    const double largest = (held_ * constrained_.solve(values) - values).cwiseAbs().maxCoeff(&worst);
    return {largest / std::max(values.cwiseAbs().maxCoeff(), 1e-300), static_cast<std::size_t>(worst)};
  }

 private:
  /// Motions that supports leave, and of a body of revolution its shape.
  Matrix left_free() const {
    if (!revolved_) return null_space(held_);
    return held_.rows() > 0 ? Matrix(3, 0) : Matrix(Eigen::Vector3d::UnitY());
  }

  /// Y: motions that supports leave free and springs resist, 3 x k.
  Matrix resisted_motions(const Matrix& left_by_supports) const {
    const Matrix along_rest = left_by_supports.transpose() * rigid_motions_;
    return left_by_supports * (rigid_motions_.cols() > 0
                                   ? null_space(along_rest.transpose())
                                   : Matrix(Matrix::Identity(left_by_supports.cols(), left_by_supports.cols())));
  }

  /// A = Y (Y'S Y)^-1 Y'.
  void find_flexibility(const Matrix& left_by_supports) {
    const Matrix Y = resisted_motions(left_by_supports);
    if (Y.cols() == 0) return;
    const Matrix stiffness = Y.transpose() * (springs_.matrix * Y);
    flexibility_ = Y * stiffness.ldlt().solve(Y.transpose());
    flexibility_ = 0.5 * (flexibility_ + flexibility_.transpose()).eval();
  }

  Matrix held_;  // constraints x 3
  Springs springs_;
  bool revolved_;
  Matrix flexibility_;  // A, 3 x 3; empty: no force moves the body
  Eigen::CompleteOrthogonalDecomposition<Matrix> constrained_;
};

}  // namespace

std::unique_ptr<BodySystem> rigid_body(const Vec2& reference, double size, std::vector<Constraint> constraints,
                                       Springs springs, std::string& contradiction, bool revolved) {
  auto body = std::make_unique<RigidBody>(reference, size, std::move(constraints), std::move(springs), revolved);
  const auto [amount, which] = body->contradiction();
  if (amount > 1e-9) contradiction = fmt::format("constraint {} cannot hold together with the others", which + 1);
  return body;
}

}  // namespace scabo::system
