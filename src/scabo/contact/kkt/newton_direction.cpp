#include "scabo/contact/kkt/newton_direction.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/kkt/newton_direction_workspace.hpp"
#include "scabo/contact/pair_operator.hpp"

namespace scabo::contact {

namespace {

void release_ties(Residual& at) {
  for (Branch& branch : at.branches) {
    if (branch.normal_tie) branch.contact = false;
    if (branch.bound_tie || branch.tip) {
      branch.slope = 0.0;
      branch.tangent = Branch::Tangent::free;
    } else if (branch.edge) {
      branch.tangent = Branch::Tangent::slip;
    }
  }
}

/// Components that no contact force and no rigid motion moves (a support holds the pair along the joint): rows and
/// columns of W and rows of G that are zero. Empty where there are none.
std::vector<bool> immovable_components(const Problem& problem) {
  std::vector<bool> immovable;
  if (!problem.W.is_dense()) return immovable;
  const Matrix& W = problem.W.matrix();
  for (Eigen::Index k = 0; k < W.rows(); ++k) {
    if (W(k, k) != 0.0 || !W.col(k).isZero(0.0) || !W.row(k).isZero(0.0) || !problem.G.dense().row(k).isZero(0.0))
      continue;
    immovable.resize(static_cast<std::size_t>(W.rows()), false);
    immovable[static_cast<std::size_t>(k)] = true;
  }
  return immovable;
}

}  // namespace

bool holding_pays(const Problem& problem, Eigen::Index unknowns) {
  const PairHolder* const holder = problem.W.holder();
  if (holder == nullptr || problem.W.is_sparse()) return false;
  if (!problem.W.is_dense()) return true;
  const SystemConstants& c = system_constants;
  const auto n = static_cast<double>(unknowns);
  return unknowns > c.least_of_single && c.joining * holder->operations() < 2.0 / 3.0 * n * n * n;
}

NewtonDirection::NewtonDirection(const BDifferentiableEquations& equations)
    : equations_(equations),
      work_(std::make_unique<Workspace>(equations.problem())),
      immovable_(immovable_components(equations.problem())) {
  // In large walls pairs are redundant, and a singular matrix costs three times the operations of a regular one.
  const Problem& problem = equations.problem();
  work_->redundant = problem.G.cols() > system_constants.many_motions && problem.pairs() > system_constants.many_pairs;
}
NewtonDirection::~NewtonDirection() = default;

bool NewtonDirection::find(Residual& at, double regularisation, Vector& d) {
  // Of many or rigid bodies the branch that holds least is followed (open, slip): of redundant pairs that just slip,
  // stick would make the matrix nearly singular and the direction huge.
  if (work_->rigid || equations_.problem().G.cols() > system_constants.motions_of_one_body) {
    release_ties(at);
    return solve(at, regularisation, d);
  }
  for (int round = 0; round < system_constants.rounds_of_ties; ++round) {
    if (!solve(at, regularisation, d)) return round > 0 && solve(at, newton_constants.least, d);
    if (equations_.follow(at, d) == 0) break;
  }
  return true;  // a direction of any branch is better than none
}

void NewtonDirection::add_unknown(int pair, const Eigen::Vector3d& row, const Eigen::Vector3d& column, double scale,
                                  double own) {
  const auto j = static_cast<Eigen::Index>(rows_.pair.size());
  rows_.pair.push_back(pair);
  rows_.L.col(j) = scale * row;
  rows_.C.col(j) = column;
  rows_.D[j] = rows_.E * (1.0 - own) + own;
  scale_[j] = scale, own_[j] = own;
}

void NewtonDirection::lay_out(const Residual& at, double regularisation) {
  const Problem& problem = equations_.problem();
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  const Vector& r = equations_.r();
  rows_.resize(static_cast<std::size_t>(d * N));
  rows_.pair.clear();
  rows_.E = regularisation;
  scale_.resize(d * N), own_.resize(d * N);
  known_.setZero(d * N);
  const double rounding = immovable_.empty() ? 0.0 : system_constants.met * at.largest();
  // Where nothing moves, the row reads 0 = -H: met, any dp does, and the shortest is 0.
  const auto met = [&](Eigen::Index k) {
    return !immovable_.empty() && immovable_[static_cast<std::size_t>(k)] && std::abs(at.H[k]) <= rounding;
  };
  for (Eigen::Index i = 0; i < N; ++i) {
    const Branch& branch = at.branches[static_cast<std::size_t>(i)];
    const auto pair = static_cast<int>(i);
    const bool slips = branch.tangent == Branch::Tangent::slip;
    Eigen::Vector3d normal(1.0, 0.0, 0.0);
    if (slips) normal.tail<2>() = branch.slope * branch.along;
    if (!branch.contact)
      known_.segment(d * i, d) -= at.H[d * i] * normal.head(d);
    else if (!(met(d * i) && normal.tail<2>().isZero(0.0)))
      add_unknown(pair, Eigen::Vector3d::UnitX(), normal, r[d * i], 0.0);
    if (branch.tangent == Branch::Tangent::stick) {
      for (Eigen::Index k = 1; k < d; ++k)
        if (!met(d * i + k)) add_unknown(pair, Eigen::Vector3d::Unit(k), Eigen::Vector3d::Unit(k), r[d * i + k], 0.0);
      continue;
    }
    if (!slips || d == 2 || branch.lambda <= system_constants.no_lambda) {
      known_.segment(d * i + 1, d - 1) -= at.H.segment(d * i + 1, d - 1);
      continue;
    }
    known_.segment<2>(3 * i + 1) -= at.H.segment<2>(3 * i + 1).dot(branch.along) * branch.along;
    const Eigen::Vector3d side(0.0, -branch.along[1], branch.along[0]);
    add_unknown(pair, side, side, branch.lambda * r[3 * i + 1], 1.0 - branch.lambda);
  }
}

bool NewtonDirection::solve(Residual& at, double regularisation, Vector& d) {
  const Problem& problem = equations_.problem();
  lay_out(at, regularisation);
  const Eigen::Index size = rows_.size(), m = problem.G.cols(), forces = known_.size();
  problem.W.apply(known_, moved_);
  right_.resize(forces + m);  // the leading size + m count: one size, so that memory is taken once
  rows_.motions(at.H, problem.dimension, right_);
  right_.head(size) = -right_.head(size).cwiseQuotient(scale_.head(size));
  y_.resize(forces + m);
  rows_.motions(moved_, problem.dimension, y_);
  right_.head(size) -= y_.head(size);
  if (m > 0) {
    auto balance = right_.segment(size, m);
    balance = -at.H.tail(m);
    balance.noalias() -= problem.G.transpose() * known_;
  }
  if (!solve_in_turn()) return false;
  d.resize(forces + m);
  d.head(forces) = known_;
  rows_.add_forces(y_, problem.dimension, d);
  d.tail(m) = y_.segment(size, m);
  if (!d.allFinite()) return false;
  equations_.motion_along(d, at.along);
  return true;
}

/// By the cheapest of the systems that do.
bool NewtonDirection::solve_in_turn() {
  const SystemConstants& c = system_constants;
  const Problem& problem = equations_.problem();
  const Eigen::Index n = rows_.size() + problem.G.cols();
  if (n >= c.least_sparse && work_->rigid) return solve_rigid();
  if (n >= c.least_sparse && problem.W.is_sparse()) return solve_sparse();
  if (holding_pays(problem, n) && solve_by_holding()) return true;
  const bool is_dense = problem.W.is_dense();
  if (is_dense && !work_->line_fails && n > c.least_of_line && solve_along_joints()) return true;
  if (is_dense && !work_->single_fails && n > c.least_of_single && n <= c.most_of_single && solve_by_single_precision())
    return true;
  if (work_->single_fails && solve_by_holding()) return true;
  const bool direct = is_dense ? n <= c.most_of_dense : std::max(n, known_.size()) <= c.most_of_formed;
  return direct ? solve_dense() : solve_iteratively();
}

bool NewtonDirection::solve_by_holding() {
  const Problem& problem = equations_.problem();
  const PairHolder* const holder = problem.W.holder();
  const Eigen::Index size = rows_.size(), m = problem.G.cols();
  if (holder == nullptr || size == 0 || work_->holding_fails) return false;
  work_->holding_fails = true;
  std::vector<int> rows;
  for (Eigen::Index j = 0; j < size; ++j) {
    Eigen::Index component = 0;
    if (rows_.L.col(j).cwiseAbs().maxCoeff(&component) != scale_[j]) return false;  // across the slip in space
    rows.push_back(problem.dimension * rows_.pair[static_cast<std::size_t>(j)] + static_cast<int>(component));
  }
  const std::unique_ptr<HeldPairs> held = holder->hold(rows);
  if (!held) return false;
  const double factor = problem.W.factor();
  Vector p, a;
  const auto precondition = [&](const Vector& x, Vector& result) {
    held->solve(x.head(size).cwiseQuotient(scale_.head(size)) / factor, x.tail(m), p, a);
    result.resize(size + m);
    result.head(size) = p;
    result.tail(m) = factor * a;
  };
  work_->holding_fails = !solve_preconditioned(precondition, system_constants.holding_gmres, system_constants.exact);
  return !work_->holding_fails;
}

bool NewtonDirection::solve_preconditioned(const std::function<void(const Vector&, Vector&)>& precondition,
                                           const GmresOptions& options, double most) {
  const Vector right = right_.head(rows_.size() + equations_.problem().G.cols());
  const auto multiply = [&](const Vector& x, Vector& result) { result = rows_.times(equations_.problem(), x); };
  y_.setZero(right.size());
  const double left = gmres(multiply, precondition, right, y_, options);
  return y_.allFinite() && left <= most;
}

bool NewtonDirection::solve_iteratively() {
  return work_->by_pairs.factorise(equations_.problem(), rows_) &&
         solve_preconditioned([&](const Vector& x, Vector& y) { work_->by_pairs.solve(x, y); },
                              system_constants.pairs_gmres, system_constants.as_good_as_lu);
}

}  // namespace scabo::contact
