#include "scabo/system/rigid_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace scabo::system {

namespace {

/// R, 3n x 6.
Matrix motions_of(const Matrix& nodes, const Eigen::Vector3d& at, double lever) {
  Matrix motions = Matrix::Zero(3 * nodes.cols(), 6);
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    const Eigen::Vector3d arm = (nodes.col(i) - at) / lever;
    motions.block<3, 3>(3 * i, 0).setIdentity();
    for (int k = 0; k < 3; ++k) motions.block<3, 1>(3 * i, 3 + k) = Eigen::Vector3d::Unit(k).cross(arm);
  }
  return motions;
}

class RigidSolid final : public BodySystem {
 public:
  RigidSolid(const Matrix& nodes, const Eigen::Vector3d& at, std::vector<Constraint> constraints) {
    lever_ = 0.5 * (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
    constraints_ = std::move(constraints);
    motions_ = motions_of(nodes, at, lever_);
    std::vector<int> free;
    for (int k = 0; k < 6; ++k)
      if (std::none_of(constraints_.begin(), constraints_.end(),
                       [&](const Constraint& held) { return held_motion(held) == k; }))
        free.push_back(k);
    rigid_motions_ = motions_(Eigen::all, free);
    rigid_coordinates_ = Matrix(Matrix::Identity(6, 6))(Eigen::all, free);
  }

  Eigen::Index size() const override { return motions_.rows(); }
  bool is_revolved() const override { return false; }
  Displaced displaced(const Vector&, const Vector& prescribed, const Balanced&, const BegunSolve*) const override {
    Vector u = Vector::Zero(size());
    for (std::size_t c = 0; c < constraints_.size(); ++c)
      u += prescribed[static_cast<Eigen::Index>(c)] * unit_of(constraints_[c]) *
           motions_.col(held_motion(constraints_[c]));
    return {std::move(u), {}};
  }
  Vector displacement_at(const Vector& f, const Vector& prescribed, const std::vector<int>&,
                         BegunSolve*) const override {
    return displacement(f, prescribed);
  }
  Matrix flexibility(const std::vector<int>& dofs) const override {
    const auto n = static_cast<Eigen::Index>(dofs.size());
    return Matrix::Zero(n, n);
  }
  Matrix flexibility_by_factor(const std::vector<int>& dofs) const override { return flexibility(dofs); }
  Vector flexed(const std::vector<int>& dofs, const Vector&) const override {
    return Vector::Zero(static_cast<Eigen::Index>(dofs.size()));
  }
  FreeStiffness free_stiffness() const override {
    const Eigen::Index m = rigid_motions_.cols();
    FreeStiffness free;
    free.map = rigid_motions_.sparseView();
    free.K = linalg::SparseMatrix(m, m);
    free.dofs.assign(static_cast<std::size_t>(m), 0);
    for (Eigen::Index k = 0; k < m; ++k) free.further.push_back(static_cast<int>(k));
    free.motions = Matrix::Identity(m, m);
    return free;
  }
  double operations() const override { return 0.0; }

  /// The constraints take part of it, and resultants are what must balance.
  Vector unbalanced(const Vector&, const Vector& f) const override { return -f; }
  Vector reactions_of(const Vector& unbalanced) const override {
    const Vector resultants = motions_.transpose() * unbalanced;
    Vector reactions(static_cast<Eigen::Index>(constraints_.size()));
    for (std::size_t c = 0; c < constraints_.size(); ++c)
      reactions[static_cast<Eigen::Index>(c)] = unit_of(constraints_[c]) * resultants[held_motion(constraints_[c])];
    return reactions;
  }
  double imbalance_of(const Vector& unbalanced) const override {
    return rigid_motions_.cols() > 0 ? (rigid_motions_.transpose() * unbalanced).lpNorm<Eigen::Infinity>() : 0.0;
  }
  double elastic_energy(const Vector&) const override { return 0.0; }
  double elastic_energy(const Vector&, const Vector&, const Vector&) const override { return 0.0; }
  double energy_lost(const Vector&) const override { return 0.0; }
  double stiff_force(const Vector&) const override { return 0.0; }
  Vector spring_forces(const Vector& u) const override { return Vector::Zero(u.size()); }
  bool is_flexible() const override { return false; }
  bool has_springs() const override { return false; }

 private:
  /// Of q per unit of what is prescribed.
  double unit_of(const Constraint& held) const { return held.rotation ? lever_ : 1.0; }

  Matrix motions_;  // R
};

}  // namespace

Constraint held_motion(int motion, double value) {
  Constraint constraint;
  constraint.component = motion % 3;
  constraint.rotation = motion >= 3;
  constraint.value = value;
  return constraint;
}

int held_motion(const Constraint& constraint) { return constraint.component + (constraint.rotation ? 3 : 0); }

std::unique_ptr<BodySystem> rigid_solid(const Matrix& nodes, const Eigen::Vector3d& at,
                                        std::vector<Constraint> constraints) {
  return std::make_unique<RigidSolid>(nodes, at, std::move(constraints));
}

}  // namespace scabo::system
