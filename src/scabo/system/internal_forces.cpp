#include "scabo/system/internal_forces.hpp"

#include <Eigen/Geometry>

#include "scabo/system/differences.hpp"

namespace scabo::system {

namespace {

constexpr std::size_t most_rotations = 3;
constexpr std::size_t lanes = 4;  // sums at a time: the additions of one sum wait for each other

linalg::Twofold sum_of(const linalg::Twofold (&parts)[lanes]) { return (parts[0] + parts[1]) + (parts[2] + parts[3]); }

/// Takes the mean displacement of all nodes out of u, in the components from `first` on.
template <int d>
void take_mean_out(Vector& u, int first) {
  auto by_node = u.reshaped(d, u.size() / d);
  Eigen::Matrix<double, d, 1> mean = by_node.rowwise().mean();
  mean.head(first).setZero();
  by_node.colwise() -= mean;
}

/// Displacements by a unit rotation about the origin: in the plane, or about axis `axis` of space.
linalg::TwofoldVector turned_about_origin(const Matrix& x, int axis) {
  linalg::TwofoldVector turn;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    if (x.rows() == 2) {
      turn.insert(turn.end(), {{-x(1, i), 0.0}, {x(0, i), 0.0}});
      continue;
    }
    const Eigen::Vector3d u = Eigen::Vector3d::Unit(axis).cross(Eigen::Vector3d(x.col(i)));
    for (const double component : u) turn.push_back({component, 0.0});
  }
  return turn;
}

linalg::Twofold dot(const linalg::TwofoldVector& a, const linalg::TwofoldVector& b) {
  linalg::Twofold sum;
  for (std::size_t i = 0; i < a.size(); ++i) sum = sum + a[i] * b[i];
  return sum;
}

}  // namespace

NodalRigidMotions::NodalRigidMotions(const Positions& nodes, bool revolved)
    : components_(nodes.components()), revolved_(revolved) {
  const auto d = static_cast<std::size_t>(components_.dimension);
  const linalg::Twofold count{static_cast<double>(nodes.count()), 0.0};
  for (int axis = 0; axis < components_.rigid_motions() - components_.dimension && !revolved; ++axis) {
    linalg::TwofoldVector turn = turned_about_origin(nodes.columns(), axis);
    for (std::size_t k = 0; k < d; ++k) {  // about the mean of the nodes: orthogonal to translations
      linalg::Twofold sum;
      for (std::size_t i = k; i < turn.size(); i += d) sum = sum + turn[i];
      const linalg::Twofold mean = sum / count;
      for (std::size_t i = k; i < turn.size(); i += d) turn[i] = turn[i] - mean;
    }
    for (const Rotation& other : rotations_) {
      const linalg::Twofold part = dot(turn, other.turn) / other.square;
      for (std::size_t i = 0; i < turn.size(); ++i) turn[i] = turn[i] - part * other.turn[i];
    }
    const linalg::Twofold square = dot(turn, turn);
    rotations_.push_back({std::move(turn), square});
  }
}

void NodalRigidMotions::take_out_of(linalg::TwofoldVector& v) const {
  components_.dimension == 2 ? take_out<2>(v) : take_out<3>(v);
}

template <int d>
void NodalRigidMotions::take_out(linalg::TwofoldVector& v) const {
  const std::size_t nodes = v.size() / d;
  const linalg::Twofold count{static_cast<double>(nodes), 0.0};
  linalg::Twofold sums[d][lanes], mean[d];
  for (std::size_t i = 0; i < nodes; ++i)
    for (std::size_t k = 0; k < d; ++k) sums[k][i % lanes] = sums[k][i % lanes] + v[d * i + k];
  for (std::size_t k = revolved_ ? 1 : 0; k < d; ++k) mean[k] = sum_of(sums[k]) / count;
  linalg::Twofold turned[most_rotations][lanes];
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t k = 0; k < d; ++k) v[d * i + k] = v[d * i + k] - mean[k];
    for (std::size_t r = 0; r < rotations_.size(); ++r) {
      const linalg::TwofoldVector& turn = rotations_[r].turn;
      linalg::Twofold product = v[d * i] * turn[d * i];
      for (std::size_t k = 1; k < d; ++k) product = product + v[d * i + k] * turn[d * i + k];
      turned[r][i % lanes] = turned[r][i % lanes] + product;
    }
  }
  for (std::size_t r = 0; r < rotations_.size(); ++r) {
    const linalg::Twofold angle = sum_of(turned[r]) / rotations_[r].square;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = v[i] - angle * rotations_[r].turn[i];
  }
}

Vector NodalRigidMotions::taken_out_of(Vector u) const {
  return components_.dimension == 2 ? taken_out<2>(std::move(u)) : taken_out<3>(std::move(u));
}

template <int d>
Vector NodalRigidMotions::taken_out(Vector u) const {
  take_mean_out<d>(u, revolved_ ? 1 : 0);
  for (const Rotation& rotation : rotations_) {
    double product = 0.0, square = 0.0;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const double turn = rotation.turn[static_cast<std::size_t>(i)].high;
      product += u[i] * turn;
      square += turn * turn;
    }
    const double angle = product / square;
    for (Eigen::Index i = 0; i < u.size(); ++i) u[i] -= angle * rotation.turn[static_cast<std::size_t>(i)].high;
  }
  return u;
}

Vector NodalRigidMotions::resultants_of(const Vector& forces) const {
  const int d = components_.dimension;
  Vector sums = Vector::Zero(components_.rigid_motions());
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    sums[components_.component_of(i)] += forces[i];
    for (std::size_t k = 0; k < rotations_.size(); ++k)
      sums[d + static_cast<Eigen::Index>(k)] += forces[i] * rotations_[k].turn[static_cast<std::size_t>(i)].high;
  }
  if (revolved_) sums[0] = 0.0;
  return sums;
}

bool is_large(const Stiffness& stiffness) { return stiffness.size() >= 20000; }

bool by_differences(const Stiffness& stiffness, const NodalRigidMotions& motions) {
  return motions.components().dimension == 2 && is_large(stiffness) && !stiffness.resists_rigid_motions &&
         !stiffness.revolved && !stiffness.divided && !stiffness.dense;
}

Vector internal_forces(const Stiffness& stiffness, const NodalRigidMotions& motions, Vector u) {
  if (by_differences(stiffness, motions))
    return forces_left(stiffness, motions, linalg::twofold(u), Vector::Zero(u.size()), Product::by_differences);
  const Vector springs = stiffness.springs.none() ? Vector() : stiffness.springs.times(u);
  if (!stiffness.resists_rigid_motions) {
    const int first = stiffness.revolved ? 1 : 0;
    motions.components().dimension == 2 ? take_mean_out<2>(u, first) : take_mean_out<3>(u, first);
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
