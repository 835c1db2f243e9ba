#include "scabo/system/rigid_solid.hpp"

#include <algorithm>

#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/rigid_motions.hpp"

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
  RigidSolid(const Matrix& nodes, const Eigen::Vector3d& at, std::vector<Constraint> constraints,
             const std::vector<SolidSpring>& springs)
      : springs_(springs) {
    lever_ = 0.5 * (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
    constraints_ = std::move(constraints);
    motions_ = motions_of(nodes, at, lever_);
    std::vector<int> free;
    for (int k = 0; k < 6; ++k)
      if (std::none_of(constraints_.begin(), constraints_.end(),
                       [&](const Constraint& held) { return held_motion(held) == k; }))
        free.push_back(k);
    left_free_ = Matrix(Matrix::Identity(6, 6))(Eigen::all, free);
    rigid_coordinates_ = left_free_;
    if (!springs_.empty()) find_flexibility();
    rigid_motions_ = motions_ * rigid_coordinates_;
  }

  Eigen::Index size() const override { return motions_.rows(); }
  bool is_revolved() const override { return false; }
  Displaced displaced(const Vector& f, const Vector& prescribed, const Balanced&, const BegunSolve*) const override {
    Vector q = Vector::Zero(6);
    for (std::size_t c = 0; c < constraints_.size(); ++c)
      q[held_motion(constraints_[c])] = prescribed[static_cast<Eigen::Index>(c)] * unit_of(constraints_[c]);
    if (is_flexible())
      for (int round = 0; round < 2; ++round)  // the second refines
        q += flexibility_ * (motions_.transpose() * f - stiffness_ * q);
    return {motions_ * q, {}};
  }
  Vector displacement_at(const Vector& f, const Vector& prescribed, const std::vector<int>&,
                         BegunSolve*) const override {
    return displacement(f, prescribed);
  }
  Matrix flexibility(const std::vector<int>& dofs) const override {
    const auto n = static_cast<Eigen::Index>(dofs.size());
    if (!is_flexible()) return Matrix::Zero(n, n);
    const Matrix R = motions_(dofs, Eigen::all);
    return R * flexibility_ * R.transpose();
  }
  Matrix flexibility_by_factor(const std::vector<int>& dofs) const override { return flexibility(dofs); }
  Vector flexed(const std::vector<int>& dofs, const Vector& forces) const override {
    if (!is_flexible()) return Vector::Zero(static_cast<Eigen::Index>(dofs.size()));
    const Matrix R = motions_(dofs, Eigen::all);
    return R * (flexibility_ * (R.transpose() * forces));
  }
  /// v: the motions that springs resist, then the free ones.
  FreeStiffness free_stiffness() const override {
    const Eigen::Index resisted = resisted_.cols(), m = rigid_motions_.cols();
    Matrix map(size(), resisted + m), K = Matrix::Zero(resisted + m, resisted + m);
    map << motions_ * resisted_, rigid_motions_;
    if (resisted > 0) K.topLeftCorner(resisted, resisted) = resisted_.transpose() * stiffness_ * resisted_;
    FreeStiffness free;
    free.map = map.sparseView();
    free.K = K.sparseView();
    free.dofs.assign(static_cast<std::size_t>(resisted + m), 0);
    for (Eigen::Index k = 0; k < m; ++k) free.further.push_back(static_cast<int>(resisted + k));
    free.motions = Matrix::Identity(m, m);
    return free;
  }
  double operations() const override { return 0.0; }

  /// The constraints take part of it, and resultants are what must balance.
  Vector unbalanced(const Vector& u, const Vector& f) const override { return -f - spring_forces(u); }
  Vector reactions_of(const Vector& unbalanced) const override {
    const Vector resultants = motions_.transpose() * unbalanced;
    Vector reactions(static_cast<Eigen::Index>(constraints_.size()));
    for (std::size_t c = 0; c < constraints_.size(); ++c)
      reactions[static_cast<Eigen::Index>(c)] = unit_of(constraints_[c]) * resultants[held_motion(constraints_[c])];
    return reactions;
  }
  double imbalance_of(const Vector& unbalanced) const override {
    if (left_free_.cols() == 0) return 0.0;
    return (left_free_.transpose() * (motions_.transpose() * unbalanced)).lpNorm<Eigen::Infinity>();
  }
  double elastic_energy(const Vector& u) const override { return -0.5 * u.dot(spring_forces(u)); }
  double elastic_energy(const Vector& u, const Vector&, const Vector&) const override { return elastic_energy(u); }
  double energy_lost(const Vector&) const override { return 0.0; }
  double stiff_force(const Vector&) const override { return 0.0; }
  Vector spring_forces(const Vector& u) const override {
    Vector forces = Vector::Zero(u.size());
    for (const SolidSpring& spring : springs_) forces -= spring.times(u);
    return forces;
  }
  bool is_flexible() const override { return flexibility_.size() > 0; }
  bool has_springs() const override { return !springs_.empty(); }

 private:
  /// Of q per unit of what is prescribed.
  double unit_of(const Constraint& held) const { return held.rotation ? lever_ : 1.0; }

  void find_flexibility() {
    stiffness_ = Matrix::Zero(6, 6);
    for (const SolidSpring& spring : springs_) stiffness_ += motions_.transpose() * spring.times(motions_);
    rigid_coordinates_ = at_rest(left_free_, stiffness_);
    resisted_ = left_free_ * null_space((left_free_.transpose() * rigid_coordinates_).transpose());
    if (resisted_.cols() == 0) return;
    const Matrix along = resisted_.transpose() * stiffness_ * resisted_;
    flexibility_ = resisted_ * along.ldlt().solve(resisted_.transpose());
    flexibility_ = 0.5 * (flexibility_ + flexibility_.transpose()).eval();
  }

  Matrix motions_;    // R
  Matrix left_free_;  // by the supports, 6 x k
  std::vector<SolidSpring> springs_;
  Matrix stiffness_, flexibility_;  // R'S R, and its inverse along the motions that springs resist; else none
  Matrix resisted_;                 // Y
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
                                        std::vector<Constraint> constraints, const std::vector<SolidSpring>& springs) {
  return std::make_unique<RigidSolid>(nodes, at, std::move(constraints), springs);
}

}  // namespace scabo::system
