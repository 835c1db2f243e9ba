#include "scabo/contact/newton/b_differentiable.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scabo/contact/constants.hpp"

namespace scabo::contact {

namespace {

bool tied(double a, double b, double scale, double smallest) {
  return std::isfinite(scale) && std::abs(a - b) <= newton_constants.tie * scale + smallest;
}

/// The tangential part of pair `i` in a vector of pairs; in the plane its second component is zero.
Vec2 tangent_part(const Vector& v, Eigen::Index i, Eigen::Index d) {
  return d == 2 ? Vec2(v[2 * i + 1], 0.0) : Vec2(v[3 * i + 1], v[3 * i + 2]);
}

void set_tangent_part(Vector& v, Eigen::Index i, Eigen::Index d, const Vec2& value) {
  v[d * i + 1] = value[0];
  if (d == 3) v[d * i + 2] = value[1];
}

/// Quantities that determine the branches of one pair.
struct Pair {
  double p_n, opening;  ///< r u_n
  Vec2 p_t, trial;      ///< trial: p_t(r)
  double smallest;      ///< smaller forces are rounding
};

double evaluate_normal(const Pair& pair, double tension, Branch& branch) {
  if (std::isinf(tension)) {  // bonded
    branch.contact = true;
    branch.normal_tie = false;
    return pair.opening;
  }
  const double strength = pair.p_n + tension;
  branch.contact = pair.opening <= strength;
  branch.normal_tie =
      tied(pair.opening, strength, std::abs(pair.opening) + std::abs(pair.p_n) + tension, pair.smallest);
  if (branch.normal_tie) branch.contact = true;
  return std::min(pair.opening, strength);  // Zhu 2017, eq. (7)
}

/// Where p_t(r) = 0 within rounding and friction prevents slip in one direction only: p_t(r) is on the edge of the
/// other side, whose bound is 0. Nothing where it is not.
std::optional<Vec2> evaluate_one_sided(const Pair& pair, const Problem& problem, Eigen::Index i, Branch& branch) {
  const double cohesion = problem.cohesion_of(i), forward = problem.mu_against(i, -1.0),
               backward = problem.mu_against(i, 1.0);
  if (forward == backward || std::min(forward, backward) > 0.0 || cohesion > 0.0) return std::nullopt;
  if (pair.p_n <= pair.smallest || std::abs(pair.trial[0]) > pair.smallest) return std::nullopt;
  branch.bound_tie = branch.tip = false;
  branch.edge = true;
  branch.tangent = Branch::Tangent::stick;
  branch.slope = 0.0;
  branch.lambda = 1.0;
  branch.along = Vec2(backward == 0.0 ? 1.0 : -1.0, 0.0);
  const bool within = pair.trial[0] * branch.along[0] <= 0.0;
  return within ? Vec2(pair.p_t - pair.trial) : pair.p_t;
}

Vec2 evaluate_tangent(const Pair& pair, const Problem& problem, Eigen::Index i, Branch& branch) {
  if (problem.mu_backward.size() > 0)
    if (const auto at_edge = evaluate_one_sided(pair, problem, i, branch)) return *at_edge;
  const double size = pair.trial.norm(), cohesion = problem.cohesion_of(i);
  // At the tip of the cone the direction decides (followed_mu).
  const bool may_be_tip = size <= pair.smallest && std::abs(pair.p_n) <= pair.smallest;
  const double mu = may_be_tip ? problem.largest_mu(i) : problem.mu_against(i, pair.trial[0]);
  const double bound = cohesion + mu * std::max(pair.p_n, 0.0);
  branch.bound_tie = mu > 0.0 && std::abs(pair.p_n) <= pair.smallest;
  branch.slope = pair.p_n > pair.smallest || (branch.bound_tie && branch.contact) ? mu : 0.0;
  branch.edge = branch.tip = false;
  branch.lambda = 1.0;
  branch.along = size > 0.0 ? Vec2(pair.trial / size) : Vec2(Vec2::Zero());
  const bool no_bound = bound <= mu * pair.smallest;
  if (no_bound && !branch.bound_tie) {  // p_n < 0 or mu = 0
    branch.tangent = Branch::Tangent::free;
    return pair.p_t;
  }
  if (no_bound) {
    branch.tip = size <= pair.smallest;
    branch.tangent = branch.tip ? Branch::Tangent::stick : Branch::Tangent::slip;
    branch.lambda = branch.tip ? 1.0 : 0.0;
  } else {
    branch.tangent = size <= bound ? Branch::Tangent::stick : Branch::Tangent::slip;
    branch.edge = tied(size, bound, bound, pair.smallest);
    if (branch.tangent == Branch::Tangent::slip) branch.lambda = bound / size;
  }
  return pair.p_t - (size > bound ? bound / size : 1.0) * pair.trial;  // eq. (8)
}

/// Coefficient for the change dt of p_t(r).
double mu_for(const Problem& problem, Eigen::Index i, const Branch& branch, const Vec2& dt) {
  return problem.mu_against(i, branch.tip ? dt[0] : branch.along[0]);
}

double bound_slope(const Branch& branch, double mu, double dp_n) {
  return branch.bound_tie ? mu * std::max(dp_n, 0.0) : branch.slope * dp_n;
}

/// Derivative of lambda p_t(r) for the change dt of p_t(r) and db of the bound.
Vec2 projected_derivative(const Branch& branch, const Vec2& dt, double db) {
  if (branch.tip) {
    const double size = dt.norm();
    return size <= db ? dt : db <= 0.0 ? Vec2(Vec2::Zero()) : Vec2(db / size * dt);
  }
  if (branch.edge) return dt - std::max(branch.along.dot(dt) - db, 0.0) * branch.along;
  switch (branch.tangent) {
    case Branch::Tangent::free:
      return Vec2::Zero();
    case Branch::Tangent::stick:
      return dt;
    case Branch::Tangent::slip:
      break;
  }
  return db * branch.along + branch.lambda * (dt - branch.along.dot(dt) * branch.along);
}

/// The branch that dt and db select at a tie of the tangential equation.
void follow_tangent(Branch& branch, const Vec2& dt, double db) {
  if (branch.edge) {
    branch.tangent = branch.along.dot(dt) > db ? Branch::Tangent::slip : Branch::Tangent::stick;
    branch.lambda = 1.0;
  }
  if (!branch.tip) return;
  const double size = dt.norm();
  if (size <= db) {
    branch.tangent = Branch::Tangent::stick;
  } else if (db <= 0.0) {
    branch.tangent = Branch::Tangent::free;
  } else {
    branch.tangent = Branch::Tangent::slip;
    branch.along = dt / size;
    branch.lambda = db / size;  // positively homogeneous, so that its linearisation is exact
  }
}

}  // namespace

BDifferentiableEquations::BDifferentiableEquations(const Problem& problem, double r_factor) : problem_(problem) {
  const Vector diagonal = problem.W.diagonal();
  const Eigen::Index d = problem.dimension;
  r_.resize(diagonal.size());
  const double mean = diagonal.size() > 0 ? diagonal.mean() : 1.0;
  const auto inverse = [&](double W) {
    return r_factor / (W > newton_constants.no_flexibility * mean ? W : mean > 0.0 ? mean : 1.0);
  };
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    r_[d * i] = inverse(diagonal[d * i]);
    const auto tangents = diagonal.segment(d * i + 1, d - 1);
    r_.segment(d * i + 1, d - 1).setConstant(inverse(tangents.mean()));
  }
  if (r_.size() > 0) largest_q_ = r_.cwiseProduct(problem.q).lpNorm<Eigen::Infinity>();
}

void BDifferentiableEquations::evaluate(const Vector& p, const Vector& a, Residual& at) const {
  problem_.W.apply(p, at.motion);
  at.motion += problem_.q;
  if (a.size() > 0) problem_.G.add_motion(a, at.motion);
  evaluate_at_motion(p, at);
}

void BDifferentiableEquations::evaluate_at_motion(const Vector& p, Residual& at) const {
  const Eigen::Index N = problem_.pairs(), d = problem_.dimension;
  at.H.resize(d * N + problem_.G.cols());
  at.branches.resize(static_cast<std::size_t>(N));
  if (at.H.size() > d * N) {
    auto balance = at.H.tail(problem_.G.cols());
    balance = problem_.f;
    balance.noalias() += problem_.G.transpose() * p;
  }
  double largest = largest_q_;
  for (Eigen::Index k = 0; k < d * N; ++k)
    largest = std::max({largest, std::abs(p[k]), std::abs(r_[k] * at.motion[k])});
  const double smallest = newton_constants.smallest * largest;
  for (Eigen::Index i = 0; i < N; ++i) {
    Branch& branch = at.branches[static_cast<std::size_t>(i)];
    const Vec2 p_t = tangent_part(p, i, d);
    const Pair pair{p[d * i], r_[d * i] * at.motion[d * i], p_t, p_t - r_[d * i + 1] * tangent_part(at.motion, i, d),
                    smallest};
    at.H[d * i] = evaluate_normal(pair, problem_.tension_of(i), branch);
    set_tangent_part(at.H, i, d, evaluate_tangent(pair, problem_, i, branch));
  }
}

int BDifferentiableEquations::stick_below(double level, const Vector& p, Residual& at) const {
  const Eigen::Index d = problem_.dimension;
  int number = 0;
  for (Eigen::Index i = 0; i < problem_.pairs(); ++i) {
    const auto forces = p.segment(d * i, d);
    const Vector opening = r_.segment(d * i, d).cwiseProduct(at.motion.segment(d * i, d));
    const double strength = std::abs(p[d * i] + problem_.tension_of(i)),
                 bound = problem_.cohesion_of(i) + problem_.largest_mu(i) * p[d * i];
    const double largest = std::max({strength, bound, forces.tail(d - 1).norm(), opening.lpNorm<Eigen::Infinity>()});
    if (!(largest < level)) continue;
    ++number;
    Branch branch;
    branch.contact = true;
    at.H[d * i] = opening[0];
    const bool sticks = problem_.largest_mu(i) > 0.0 || problem_.cohesion_of(i) > 0.0;
    branch.tangent = sticks ? Branch::Tangent::stick : Branch::Tangent::free;
    if (sticks)
      at.H.segment(d * i + 1, d - 1) = opening.tail(d - 1);
    else
      at.H.segment(d * i + 1, d - 1) = forces.tail(d - 1);
    at.branches[static_cast<std::size_t>(i)] = branch;
  }
  return number;
}

Residual BDifferentiableEquations::residual(const Vector& p, const Vector& a) const {
  Residual at;
  evaluate(p, a, at);
  return at;
}

void BDifferentiableEquations::motion_along(const Vector& d, Vector& change) const {
  const Eigen::Index size = problem_.q.size();
  problem_.W.apply(d.head(size), change);
  if (d.size() > size) problem_.G.add_motion(d.tail(d.size() - size), change);
}

Vector BDifferentiableEquations::derivative(const Residual& at, const Vector& direction) const {
  const Eigen::Index N = problem_.pairs(), d = problem_.dimension, m = direction.size() - d * N;
  Vector du;
  motion_along(direction, du);
  Vector slope(direction.size());
  for (Eigen::Index i = 0; i < N; ++i) {
    const Branch& branch = at.branches[static_cast<std::size_t>(i)];
    const double dg = r_[d * i] * du[d * i], dp_n = direction[d * i];
    slope[d * i] = branch.normal_tie ? std::min(dg, dp_n) : branch.contact ? dg : dp_n;
    const Vec2 dp_t = tangent_part(direction, i, d);
    const Vec2 dt = dp_t - r_[d * i + 1] * tangent_part(du, i, d);
    const double db = bound_slope(branch, mu_for(problem_, i, branch, dt), dp_n);
    set_tangent_part(slope, i, d, dp_t - projected_derivative(branch, dt, db));
  }
  if (m > 0) slope.tail(m) = problem_.G.transpose() * direction.head(d * N);
  return slope;
}

double BDifferentiableEquations::followed_mu(Eigen::Index i, const Branch& branch) const {
  if (branch.tip && branch.tangent != Branch::Tangent::slip) return problem_.mu[i];  // not used: any value, but one
  return problem_.mu_against(i, branch.along[0]);
}

int BDifferentiableEquations::follow(Residual& at, const Vector& direction) const {
  const Eigen::Index N = problem_.pairs(), d = problem_.dimension;
  const Vector& du = at.along;
  int changed = 0;
  for (Eigen::Index i = 0; i < N; ++i) {
    Branch& branch = at.branches[static_cast<std::size_t>(i)];
    if (!branch.tied()) continue;
    const Branch before = branch;
    const double dg = r_[d * i] * du[d * i], dp_n = direction[d * i];
    // Within rounding both branches are valid, and the present one is kept.
    const double room = newton_constants.room * (std::abs(dg) + std::abs(dp_n));
    if (branch.normal_tie && std::abs(dg - dp_n) > room) branch.contact = dg < dp_n;
    const Vec2 dt = tangent_part(direction, i, d) - r_[d * i + 1] * tangent_part(du, i, d);
    const double db = bound_slope(branch, mu_for(problem_, i, branch, dt), dp_n);
    if (!(branch.edge && std::abs(branch.along.dot(dt) - db) <= newton_constants.room * (dt.norm() + std::abs(db))))
      follow_tangent(branch, dt, db);
    if (branch.bound_tie && dp_n != 0.0) branch.slope = dp_n > 0.0 ? followed_mu(i, branch) : 0.0;
    changed += !branch.same_branch(before);
  }
  return changed;
}

}  // namespace scabo::contact
