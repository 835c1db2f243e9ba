#include "scabo/contact/path_system.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/b_differentiable.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

constexpr double least_force = 1e-300;
/// Rows beyond those after which the matrix is factorised anew: for changes one after the other, and together.
constexpr int spare_rows = 100, spare_rows_together = 500;

// What a direction or a point may lack, over its forces and motions, and what of that is not corrected.
constexpr double exact = 1e-8, negligible = 1e-12;

}  // namespace

PathSystem::PathSystem(const Problem& problem, const PathStart& start, const PathOptions& options)
    : problem_(problem),
      N_(problem.pairs()),
      m_(problem.G.cols()),
      n_(2 * N_ + m_),
      softness_(options.softness),
      capacity_(options.changes + (options.together > 0 ? spare_rows_together : spare_rows)),
      refines_(options.hold > 0.0) {
  W_ = problem.W.is_sparse() ? SparseRows(problem.W.sparse()) : SparseRows(problem.W.dense().sparseView());
  soft_ = softness_ * BDifferentiableEquations(problem, 1.0).r().cwiseInverse();
  Sparse softness(2 * N_, 2 * N_);
  softness.setIdentity();
  softness.diagonal() = soft_;
  W_ += SparseRows(softness);
  W_columns_ = W_;
  G_columns_ = m_ > 0 ? problem.G.sparse() : Sparse(2 * N_, 0);
  G_ = G_columns_;
  if (m_ > 0 && problem.W.is_sparse())
    blocks_ = [this](const std::vector<int>& kept) {
      std::vector<int> pair_of;
      for (const int unknown : kept)
        if (unknown < 2 * N_) pair_of.push_back(unknown / 2);
      if (!joint_order_) joint_order_.emplace(problem_);
      return joint_order_->blocks(pair_of);
    };
  hold_.setZero(m_);
  for (Index k = 0; k < m_; ++k) hold_[k] = options.hold * G_columns_.col(k).squaredNorm();
  q_ = problem.q;
  f_ = problem.f + hold_.cwiseProduct(start.a);
  centre_.setZero(2 * N_);
  centre_a_ = start.a;
  z_.resize(n_);
  z_ << start.p, start.a;
  motion_ = q_ + W_ * start.p + G_ * start.a;
  take_states(start);
  begin_again(start.margin, start.pressure);
}

void PathSystem::take_states(const PathStart& start) {
  states_.resize(static_cast<std::size_t>(N_));
  for (Index i = 0; i < N_; ++i) {
    PathState& state = states_[static_cast<std::size_t>(i)];
    const ContactState of_start = start.states[static_cast<std::size_t>(i)];
    state.contact = of_start != ContactState::open;
    if (!state.contact)
      state.side = may_stick(i) && motion_[2 * i + 1] < 0.0 ? -1 : 1;
    else if (!may_stick(i))
      state.side = 1;
    else
      state.side = of_start == ContactState::stick ? 0 : start.p[2 * i + 1] > 0.0 ? -1 : 1;
  }
}

void PathSystem::begin_again(double margin, double pressure) {
  const double force = std::max(z_.head(2 * N_).cwiseAbs().mean(), least_force),
               length = std::max(motion_.cwiseAbs().mean(), force * softness_);
  std::uniform_real_distribution<double> uniform(0.5, 1.0);
  for (Index i = 0; i < N_; ++i) {
    const PathState& now = state(i);
    const double part = margin * uniform(random_);
    double &normal = z_[2 * i], &tangent = z_[2 * i + 1], &u_n = motion_[2 * i], &u_t = motion_[2 * i + 1];
    if (!now.contact) {
      normal = tangent = 0.0;
      u_n = std::max(u_n, 0.0) + length * part;
      continue;
    }
    normal = std::max(normal, 0.0) + force * (pressure + part);
    u_n = 0.0;
    if (!may_stick(i)) {
      tangent = 0.0;
    } else if (now.side == 0) {
      tangent = std::clamp(tangent, -(1.0 - part) * mu_of(i, 1) * normal, (1.0 - part) * mu_of(i, -1) * normal);
      u_t = 0.0;
    } else {
      tangent = -now.side * mu_of(i, now.side) * normal;
      u_t = now.side * (std::max(now.side * u_t, 0.0) + length * part);
    }
  }
  find_what_is_missing();
  if (!base_.empty()) find_slope();
}

void PathSystem::find_what_is_missing() {
  t_ = 1.0;
  dq_ = motion_ - (q_ + W_ * z_.head(2 * N_) + G_ * z_.tail(m_));
  df_ = hold_.cwiseProduct(z_.tail(m_)) - f_ - G_.transpose() * z_.head(2 * N_);
}

void PathSystem::begin_at(const Point& point, double hold) {
  go_to(point);
  hold_ *= hold;
  f_ = problem_.f + hold_.cwiseProduct(centre_a_);
  find_what_is_missing();
}

double PathSystem::take_softness_back(double loosened) {
  t_ = 1.0;
  dq_ = soft_.cwiseProduct(z_.head(2 * N_) - centre_);
  centre_ = z_.head(2 * N_);
  q_ -= dq_;
  df_ = hold_.cwiseProduct(centre_a_ - z_.tail(m_));
  centre_a_ = z_.tail(m_);
  double held = 0.0;  // forces of what holds the bodies
  for (Index k = 0; k < m_; ++k)
    if (hold_[k] > 0.0) held = std::max(held, std::abs(df_[k]) / G_columns_.col(k).norm());
  hold_ *= loosened;
  f_ = problem_.f + hold_.cwiseProduct(centre_a_);
  return std::max(dq_.lpNorm<Eigen::Infinity>(), held) / std::max(centre_.lpNorm<Eigen::Infinity>(), least_force);
}

void PathSystem::advance(double step) {
  z_ += step * dz_;
  motion_ += step * d_motion_;
  t_ += step * dt_;
}

void PathSystem::turn(double factor) {
  dz_ *= factor;
  d_motion_ *= factor;
  dt_ *= factor;
}

bool PathSystem::asks_for_motion(const std::vector<PathState>& states, Index row) const {
  const PathState& state = states[static_cast<std::size_t>(row / 2)];
  return row % 2 == 0 ? state.contact : state.side == 0;
}

linalg::ReplacedRows::Row PathSystem::row_of(const std::vector<PathState>& states, Index row) const {
  linalg::ReplacedRows::Row entries;
  if (asks_for_motion(states, row)) {
    for (SparseRows::InnerIterator it(W_, row); it; ++it) entries.emplace_back(static_cast<int>(it.col()), it.value());
    for (SparseRows::InnerIterator it(G_, row); it; ++it)
      entries.emplace_back(static_cast<int>(2 * N_ + it.col()), it.value());
    return entries;
  }
  entries.emplace_back(static_cast<int>(row), 1.0);
  const int side = states[static_cast<std::size_t>(row / 2)].side;
  if (row % 2 == 1) entries.emplace_back(static_cast<int>(row - 1), side * mu_of(row / 2, side));
  return entries;
}

linalg::ReplacedRows::Row PathSystem::difference_of(Index row) const {
  const auto pair = static_cast<std::size_t>(row / 2);
  const bool same =
      row % 2 == 0 ? states_[pair].contact == base_[pair].contact : states_[pair].side == base_[pair].side;
  if (same) return {};
  linalg::ReplacedRows::Row difference = row_of(states_, row);
  for (const auto& [column, value] : row_of(base_, row)) difference.emplace_back(column, -value);
  return difference;
}

/// Right-hand side of the derivative by t: A z' = b.
double PathSystem::right_of(const std::vector<PathState>& states, Index row) const {
  return asks_for_motion(states, row) ? -dq_[row] : 0.0;
}

bool PathSystem::factorise() {
  base_ = states_;
  inexact_ = false;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(W_.nonZeros() + 2 * G_.nonZeros() + 2 * N_));
  for (Index row = 0; row < 2 * N_; ++row) {
    for (const auto& [column, value] : row_of(base_, row)) entries.emplace_back(static_cast<int>(row), column, value);
    for (SparseRows::InnerIterator it(G_, row); it; ++it)
      entries.emplace_back(static_cast<int>(2 * N_ + it.col()), static_cast<int>(row), it.value());
  }
  for (Index k = 0; k < m_; ++k)
    if (hold_[k] > 0.0) entries.emplace_back(static_cast<int>(2 * N_ + k), static_cast<int>(2 * N_ + k), -hold_[k]);
  Sparse A(n_, n_);
  A.setFromTriplets(entries.begin(), entries.end());
  return matrix_.factorise(std::move(A), 2 * N_, capacity_, blocks_) && place();
}

void PathSystem::find_slope() {
  Vector right(n_);
  for (Index row = 0; row < 2 * N_; ++row) right[row] = right_of(base_, row);
  right.tail(m_) = -df_;
  slope_ = matrix_.solve_before(right);
}

bool PathSystem::place() {
  find_slope();
  Vector right(n_), z;
  for (Index row = 0; row < 2 * N_; ++row)
    right[row] = asks_for_motion(states_, row) ? -(q_[row] + t_ * dq_[row]) : 0.0;
  right.tail(m_) = -(f_ + t_ * df_);
  if (!matrix_.solve(right, z) || !slope_.allFinite()) return false;
  z_ = z;
  find_motion();
  return true;
}

void PathSystem::change(const std::vector<Change>& changes) {
  std::vector<linalg::ReplacedRows::Replaced> rows;
  for (const Change& change : changes) {
    PathState& now = states_[static_cast<std::size_t>(change.pair)];
    const bool normal = now.contact != change.state.contact, tangential = now.side != change.state.side;
    now = change.state;
    const auto row = static_cast<int>(2 * change.pair);
    if (normal) rows.push_back({row, difference_of(row)});
    if (tangential) rows.push_back({row + 1, difference_of(row + 1)});
  }
  matrix_.replace(std::move(rows));
}

void PathSystem::go_to(const Point& point) {
  std::vector<Change> back;
  for (Index i = 0; i < N_; ++i) {
    const PathState& before = point.states[static_cast<std::size_t>(i)];
    if (!(state(i) == before)) back.push_back({i, before});
  }
  change(back);
  z_ = point.z;
  motion_ = point.motion;
  t_ = point.t;
}

bool PathSystem::find_direction() {
  constexpr int refinements = 3;
  const std::vector<int>& rows = matrix_.rows();
  Vector change(static_cast<Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    change[static_cast<Index>(i)] = right_of(states_, rows[i]) - right_of(base_, rows[i]);
  matrix_.solve_from(slope_, change, dz_);
  if (!dz_.allFinite()) return false;
  dt_ = 1.0;
  find_d_motion();
  if (!refines_) return true;
  // Bodies that hardly anything held when the matrix was factorised make what follows from it inexact.
  for (int k = 0;; ++k) {
    const Vector left = left_of(dz_, d_motion_, hold_.cwiseProduct(dz_.tail(m_)) - df_);
    const double reached = dz_.lpNorm<Eigen::Infinity>() + d_motion_.lpNorm<Eigen::Infinity>();
    if (left.lpNorm<Eigen::Infinity>() <= exact * reached) return true;
    if (k == refinements) break;
    Vector more;
    matrix_.solve_once(left, more);
    if (!more.allFinite()) return false;
    dz_ += more;
    find_d_motion();
  }
  inexact_ = true;
  return true;
}

bool PathSystem::correct() {
  Vector left = left_of_point(), more;
  const double least = negligible * (z_.lpNorm<Eigen::Infinity>() + motion_.lpNorm<Eigen::Infinity>());
  left = (left.array().abs() > least).select(left, 0.0);  // mostly in rows that were replaced: a solve instead of two
  matrix_.solve_roughly(left, more);
  if (!more.allFinite()) return false;
  z_ += more;
  find_motion();
  return true;
}

bool PathSystem::is_exact() const {
  return left_of_point().lpNorm<Eigen::Infinity>() <=
         exact * (z_.lpNorm<Eigen::Infinity>() + motion_.lpNorm<Eigen::Infinity>());
}

Vector PathSystem::left_of_point() const {
  return left_of(z_, motion_, hold_.cwiseProduct(z_.tail(m_)) - (f_ + t_ * df_));
}

/// What the rows lack, at this z with its motions or along it; `balance`: what G'p should be.
Vector PathSystem::left_of(const Vector& z, const Vector& motion, const Vector& balance) const {
  Vector left(n_);
  for (Index row = 0; row < 2 * N_; ++row) {
    if (asks_for_motion(states_, row)) {
      left[row] = -motion[row];
    } else {
      left[row] = -z[row];
      const int side = state(row / 2).side;
      if (row % 2 == 1) left[row] -= side * mu_of(row / 2, side) * z[row - 1];
    }
  }
  left.tail(m_) = balance - G_columns_.transpose() * z.head(2 * N_);
  return left;
}

void PathSystem::find_motion() { motion_ = q_ + t_ * dq_ + W_columns_ * z_.head(2 * N_) + G_columns_ * z_.tail(m_); }

void PathSystem::find_d_motion() { d_motion_ = dq_ + W_columns_ * dz_.head(2 * N_) + G_columns_ * dz_.tail(m_); }

}  // namespace scabo::contact
