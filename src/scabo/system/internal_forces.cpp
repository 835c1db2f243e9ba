#include "scabo/system/internal_forces.hpp"

#include "scabo/system/differences.hpp"

namespace scabo::system {

namespace {

constexpr std::size_t lanes = 4;  // sums at a time: the additions of one sum wait for each other

linalg::Twofold sum_of(const linalg::Twofold (&parts)[lanes]) { return (parts[0] + parts[1]) + (parts[2] + parts[3]); }

}  // namespace

NodalRigidMotions::NodalRigidMotions(const std::vector<Vec2>& nodes, bool revolved) : revolved_(revolved) {
  for (const Vec2& x : nodes) {
    turn_.push_back({-x.y(), 0.0});
    turn_.push_back({x.x(), 0.0});
  }
  const linalg::Twofold count{static_cast<double>(nodes.size()), 0.0};
  for (std::size_t k = 0; k < 2; ++k) {  // about the mean of the nodes: orthogonal to translations
    linalg::Twofold sum;
    for (std::size_t i = k; i < turn_.size(); i += 2) sum = sum + turn_[i];
    const linalg::Twofold mean = sum / count;
    for (std::size_t i = k; i < turn_.size(); i += 2) turn_[i] = turn_[i] - mean;
  }
  for (const linalg::Twofold& turn : turn_) turn_square_ = turn_square_ + turn * turn;
}

void NodalRigidMotions::take_out_of(linalg::TwofoldVector& v) const {
  const std::size_t nodes = v.size() / 2;
  const linalg::Twofold count{static_cast<double>(nodes), 0.0};
  linalg::Twofold x[lanes], y[lanes], turned[lanes];
  for (std::size_t i = 0; i < nodes; ++i) {
    x[i % lanes] = x[i % lanes] + v[2 * i];
    y[i % lanes] = y[i % lanes] + v[2 * i + 1];
  }
  const linalg::Twofold mean_x = revolved_ ? linalg::Twofold{} : sum_of(x) / count, mean_y = sum_of(y) / count;
  for (std::size_t i = 0; i < nodes; ++i) {
    v[2 * i] = v[2 * i] - mean_x;
    v[2 * i + 1] = v[2 * i + 1] - mean_y;
    linalg::Twofold& sum = turned[i % lanes];
    sum = sum + (v[2 * i] * turn_[2 * i] + v[2 * i + 1] * turn_[2 * i + 1]);
  }
  if (revolved_) return;
  const linalg::Twofold angle = sum_of(turned) / turn_square_;
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = v[i] - angle * turn_[i];
}

Vector NodalRigidMotions::taken_out_of(Vector u) const {
  auto by_node = u.reshaped(2, u.size() / 2);
  Vec2 mean = by_node.rowwise().mean();
  if (revolved_) mean.x() = 0.0;
  by_node.colwise() -= mean;
  if (revolved_) return u;
  double product = 0.0, square = 0.0;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double turn = turn_[static_cast<std::size_t>(i)].high;
    product += u[i] * turn;
    square += turn * turn;
  }
  const double angle = product / square;
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] -= angle * turn_[static_cast<std::size_t>(i)].high;
  return u;
}

Eigen::Vector3d NodalRigidMotions::resultants_of(const Vector& forces) const {
  double sums[2] = {0.0, 0.0}, moment = 0.0;
  for (std::size_t i = 0; i < turn_.size(); ++i) {
    const double force = forces[static_cast<Eigen::Index>(i)];
    sums[i % 2] += force;
    moment += force * turn_[i].high;
  }
  return revolved_ ? Eigen::Vector3d(0.0, sums[1], 0.0) : Eigen::Vector3d(sums[0], sums[1], moment);
}

bool is_large(const Stiffness& stiffness) { return stiffness.size() >= 20000; }

bool by_differences(const Stiffness& stiffness) {
  return is_large(stiffness) && !stiffness.resists_rigid_motions && !stiffness.revolved && !stiffness.divided &&
         !stiffness.dense;
}

Vector internal_forces(const Stiffness& stiffness, const NodalRigidMotions& motions, Vector u) {
  if (by_differences(stiffness))
    return forces_left(stiffness, motions, linalg::twofold(u), Vector::Zero(u.size()), Product::by_differences);
  const Vector springs = stiffness.springs.none() ? Vector() : stiffness.springs.times(u);
  if (!stiffness.resists_rigid_motions) {
    auto by_node = u.reshaped(2, u.size() / 2);
    Vec2 mean = by_node.rowwise().mean();
    if (stiffness.revolved) mean.x() = 0.0;
    by_node.colwise() -= mean;
  }
  Vector forces = stiffness.times(u);
  if (!stiffness.springs.none()) forces += springs;
  return forces;
}

Vector forces_left(const Stiffness& stiffness, const NodalRigidMotions& motions, linalg::TwofoldVector u,
                   const Vector& f, Product product, double* rounding) {
  linalg::TwofoldVector springs;
  if (!stiffness.springs.none()) springs = linalg::product(stiffness.springs.matrix, u);
  if (!stiffness.resists_rigid_motions) motions.take_out_of(u);
  linalg::TwofoldVector forces;
  if (product == Product::by_differences) {
    const ForcesByDifferences found = forces_by_differences(stiffness.sparse, u);
    forces = linalg::twofold(found.forces);
    if (rounding) *rounding = found.rounding;
  } else {
    forces = stiffness.times(u);
  }
  if (!stiffness.resists_rigid_motions) motions.take_out_of(forces);
  for (std::size_t i = 0; i < springs.size(); ++i) forces[i] = forces[i] + springs[i];
  Vector left(stiffness.size());
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    left[row] = (forces[i] - linalg::Twofold{f[row], 0.0}).high;
  }
  return left;
}

}  // namespace scabo::system
