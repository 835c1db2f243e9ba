#include "scabo/contact/soft_direction.hpp"

#include <algorithm>

#include "scabo/contact/gmres.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

/// On the rows of motions: this part of |H| over the largest force, and within which limits. With less than 1e-6 rows
/// that contradict each other by rounding lead away from where |H| is 1e-8.
constexpr double of_residual = 0.1, least_raise = 1e-6, most_raise = 1e-2;
/// On the rows of balance: this part of the same. With at least 1e-9 a wall of 24 x 24 blocks stayed at 1e-10.
constexpr double of_raise = 0.1, least_hold = 1e-7;
/// On the rows of balance of motions that stay as they are.
constexpr double firm = 1.0;
/// Products with the factor of an earlier step, most, and pairs that have changed since then. `exact_enough`: what is
/// left of the right-hand side; the softness leaves more.
constexpr int most_products = 30, most_changed = 100;
constexpr GmresOptions by_old_factor{1e-8, most_products, most_products};
constexpr double exact_enough = 1e-6;
/// The softness for |H| up to which a step with an earlier factor does without: most states are right, and of the last
/// digits only the softness is left (towers of fine blocks: |H| fell by 3 % a step from 1e-8 on).
constexpr double settled = 1e-3;

}  // namespace

SoftDirection::SoftDirection(const BDifferentiableEquations& equations) : equations_(equations), sliding_(equations) {
  const Sparse& G = equations.problem().G.sparse();
  size_.resize(G.cols());
  for (Index k = 0; k < G.cols(); ++k) size_[k] = G.col(k).squaredNorm();
}

std::vector<SoftDirection::State> SoftDirection::states_of(const Residual& at) {
  std::vector<State> states(at.branches.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Branch& branch = at.branches[i];
    State& state = states[i];
    state.presses = branch.contact && !branch.normal_tie;
    const bool loose = branch.bound_tie || branch.tip;
    const bool slips = !loose && (branch.edge || branch.tangent == Branch::Tangent::slip);
    state.sticks = !loose && !slips && branch.tangent == Branch::Tangent::stick;
    if (slips) state.slope = branch.slope * branch.along[0];
  }
  return states;
}

bool SoftDirection::asks_for_motion(const std::vector<State>& states, Index row) const {
  const State& state = states[static_cast<std::size_t>(row / 2)];
  return row % 2 == 0 ? state.presses : state.sticks;
}

/// A x, with what is on the diagonal.
void SoftDirection::apply(const std::vector<State>& states, const Vector& x, Vector& image) {
  const Problem& problem = equations_.problem();
  const Vector& r = equations_.r();
  const Index forces = r.size(), m = size_.size();
  equations_.motion_along(x, motion_);
  image.resize(forces + m);
  for (Index k = 0; k < forces; ++k) {
    if (asks_for_motion(states, k)) {
      image[k] = r[k] * motion_[k] + raise_ * x[k];
    } else {
      image[k] = x[k];
      if (k % 2 == 1) image[k] -= states[static_cast<std::size_t>(k / 2)].slope * x[k - 1];
    }
  }
  image.tail(m) = problem.G.transpose() * x.head(forces);
  image.tail(m) -= hold_.cwiseProduct(x.tail(m));
}

/// Of the forces whose row asks for a motion; the others follow from them and from the right-hand side.
bool SoftDirection::factorise() {
  const Problem& problem = equations_.problem();
  const Vector& r = equations_.r();
  const Sparse &W = problem.W.sparse(), &G = problem.G.sparse();
  const Index forces = r.size(), m = size_.size();
  std::vector<int> place(static_cast<std::size_t>(forces), -1);
  unknowns_.clear();
  for (Index k = 0; k < forces; ++k) {
    if (!asks_for_motion(held_, k)) continue;
    const State& state = held_[static_cast<std::size_t>(k / 2)];
    place[static_cast<std::size_t>(k)] = static_cast<int>(unknowns_.size());
    unknowns_.push_back({static_cast<int>(k), k % 2 == 0 && !state.sticks ? state.slope : 0.0});
  }
  const auto size = static_cast<Index>(unknowns_.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(W.nonZeros() + 2 * G.nonZeros() + size + m));
  const auto add = [&](Index row, Index column, double value) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  };
  for (Index j = 0; j < size; ++j) {
    const Unknown& unknown = unknowns_[static_cast<std::size_t>(j)];
    for (int part = 0; part < (unknown.slope != 0.0 ? 2 : 1); ++part) {
      const double weight = part == 0 ? 1.0 : unknown.slope;
      for (Sparse::InnerIterator it(W, unknown.row + part); it; ++it)
        if (const int to = place[static_cast<std::size_t>(it.row())]; to >= 0)
          add(to, j, weight * r[it.row()] * it.value());
    }
    add(j, j, raise_);
  }
  for (Index k = 0; k < m; ++k) {
    for (Sparse::InnerIterator it(G, k); it; ++it) {
      if (const int to = place[static_cast<std::size_t>(it.row())]; to >= 0) {
        add(to, size + k, r[it.row()] * it.value());
        add(size + k, to, it.value());
      }
      if (it.row() % 2 == 1) {  // a force that follows the normal force of its pair
        const State& state = held_[static_cast<std::size_t>(it.row() / 2)];
        const int normal = place[static_cast<std::size_t>(it.row() - 1)];
        if (!state.sticks && state.slope != 0.0 && normal >= 0) add(size + k, normal, state.slope * it.value());
      }
    }
    add(size + k, size + k, -hold_[k]);
  }
  A_.resize(size + m, size + m);
  A_.setFromTriplets(entries.begin(), entries.end());
  ++factorisations_;
  return factor_.factorise(A_, [&] {
    if (!joint_order_) joint_order_.emplace(problem);
    std::vector<int> pair_of;
    pair_of.reserve(unknowns_.size());
    for (const Unknown& unknown : unknowns_) pair_of.push_back(unknown.row / 2);
    return joint_order_->blocks(pair_of);
  });
}

/// With the matrix of the states of the factor.
void SoftDirection::solve(const Vector& right, Vector& x) {
  const Problem& problem = equations_.problem();
  const Vector& r = equations_.r();
  const Index forces = r.size(), m = size_.size(), size = static_cast<Index>(unknowns_.size());
  x.setZero(forces + m);
  for (Index k = 0; k < forces; ++k) {
    if (asks_for_motion(held_, k)) continue;
    x[k] = right[k];
    // The normal force of a pair that presses is added below.
    if (k % 2 == 1) x[k] += held_[static_cast<std::size_t>(k / 2)].slope * x[k - 1];
  }
  problem.W.apply(x.head(forces), motion_);
  reduced_.resize(size + m);
  for (Index j = 0; j < size; ++j) {
    const int row = unknowns_[static_cast<std::size_t>(j)].row;
    reduced_[j] = right[row] - r[row] * motion_[row];
  }
  reduced_.tail(m) = right.tail(m);
  reduced_.tail(m).noalias() -= problem.G.transpose() * x.head(forces);
  factor_.solve(reduced_, y_);
  left_ = reduced_ - A_ * y_;
  factor_.solve(left_, more_);
  y_ += more_;
  for (Index j = 0; j < size; ++j) {
    const Unknown& unknown = unknowns_[static_cast<std::size_t>(j)];
    x[unknown.row] += y_[j];
    if (unknown.slope != 0.0) x[unknown.row + 1] += unknown.slope * y_[j];
  }
  x.tail(m) = y_.tail(m);
}

/// By the factor of an earlier step.
bool SoftDirection::reuse_factor(const std::vector<State>& states, const Vector& right, Vector& d) {
  d.setZero(right.size());
  const double remains = gmres([&](const Vector& x, Vector& image) { apply(states, x, image); },
                               [&](const Vector& b, Vector& x) { solve(b, x); }, right, d, by_old_factor);
  reused_ = remains <= exact_enough && d.allFinite();
  return reused_;
}

bool SoftDirection::find(const Residual& at, const Vector& p, Vector& d) {
  std::vector<State> states = states_of(at);
  Vector right = at.H;
  const double largest = std::max(p.lpNorm<Eigen::Infinity>(), 1e-300);
  const double left = of_residual * at.largest() / largest;
  Vector firmly = Vector::Zero(size_.size());
  staying_ = sliding_.hold(p, at, states, right, staying_);
  for (const int motion : staying_) firmly[motion] = firm * size_[motion];
  right = -right;
  reused_ = false;
  int changed = 0;
  for (std::size_t i = 0; i < held_.size(); ++i) changed += !(states[i] == held_[i]);
  const bool may_reuse = !held_.empty() && changed <= most_changed;
  if (may_reuse && left <= settled) {
    raise_ = 0.0;
    hold_ = firmly;
    if (reuse_factor(states, right, d)) return true;
  }
  raise_ = std::clamp(left, least_raise, most_raise);
  hold_ = (std::clamp(of_raise * left, least_hold, of_raise * most_raise) * size_).cwiseMax(firmly);
  if (may_reuse && reuse_factor(states, right, d)) return true;
  held_ = std::move(states);
  if (!factorise()) {
    held_.clear();
    return false;
  }
  solve(right, d);
  return d.allFinite();
}

}  // namespace scabo::contact
