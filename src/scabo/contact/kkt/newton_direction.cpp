#include "scabo/contact/kkt/newton_direction.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "scabo/contact/kkt/newton_direction_workspace.hpp"
#include "scabo/contact/pair_operator.hpp"

namespace scabo::contact {

namespace {

// Unknowns of a dense factorisation: of the matrix W itself, for which GMRES needs hundreds of products, and of one
// that would have to be formed first.
constexpr Eigen::Index most_of_dense = 8000, most_of_formed = 2500;
// Unknowns from which the factorisation is one in single precision, and up to which there is one.
constexpr Eigen::Index least_of_single = 2500, most_of_single = 24000;
// Unknowns from which the preconditioner by halves of joints comes before any LU.
constexpr Eigen::Index least_of_line = 1200;
constexpr GmresOptions holding_gmres{1e-12, 60, 120};
constexpr Eigen::Index least_sparse = 120;  // unknowns below which dense is faster
constexpr Eigen::Index motions_of_one_body = 3;

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
  // Dense operations are faster than those of a sparse factor, to which its order and the iterations add.
  constexpr double dearer = 10.0;
  const auto n = static_cast<double>(unknowns);
  return unknowns > least_of_single && dearer * holder->operations() < 2.0 / 3.0 * n * n * n;
}

NewtonDirection::NewtonDirection(const BDifferentiableEquations& equations)
    : equations_(equations),
      work_(std::make_unique<Workspace>()),
      immovable_(immovable_components(equations.problem())) {
  // In large walls pairs are redundant, and a singular matrix costs three times the operations of a regular one.
  constexpr int many_motions = 60, many_pairs = 1000;
  const Problem& problem = equations.problem();
  work_->redundant = problem.G.cols() > many_motions && problem.pairs() > many_pairs;
}
NewtonDirection::~NewtonDirection() = default;

bool NewtonDirection::find(Residual& at, double regularisation, Vector& d) {
  // Of many bodies the branch that holds least is followed (open, slip): of redundant pairs that just slip, stick would
  // make the matrix nearly singular and the direction huge.
  if (equations_.problem().G.cols() > motions_of_one_body) {
    release_ties(at);
    return solve(at, regularisation, d);
  }
  constexpr int rounds = 8;
  for (int round = 0; round < rounds; ++round) {
    if (!solve(at, regularisation, d)) return round > 0 && solve(at, 1e-8, d);
    if (equations_.follow(at, d) == 0) break;
  }
  return true;  // a direction of any branch is better than none
}

void NewtonDirection::lay_out(const Residual& at) {
  const Problem& problem = equations_.problem();
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  const Vector& r = equations_.r();
  unknowns_.clear();
  unknowns_.reserve(static_cast<std::size_t>(d * N));
  first_of_pair_.resize(static_cast<std::size_t>(N + 1));
  known_.setZero(d * N);
  const double rounding = immovable_.empty() ? 0.0 : 1e-14 * at.largest();
  // Where nothing moves, the row reads 0 = -H: met, any dp does, and the shortest is 0.
  const auto met = [&](Eigen::Index k) {
    return !immovable_.empty() && immovable_[static_cast<std::size_t>(k)] && std::abs(at.H[k]) <= rounding;
  };
  for (Eigen::Index i = 0; i < N; ++i) {
    first_of_pair_[static_cast<std::size_t>(i)] = static_cast<int>(unknowns_.size());
    const Branch& branch = at.branches[static_cast<std::size_t>(i)];
    const auto pair = static_cast<int>(i);
    const bool slips = branch.tangent == Branch::Tangent::slip;
    Eigen::Vector3d normal(1.0, 0.0, 0.0);
    if (slips) normal.tail<2>() = branch.slope * branch.along;
    if (branch.contact) {
      if (!(met(d * i) && normal.tail<2>().isZero(0.0)))
        unknowns_.push_back({pair, Eigen::Vector3d::UnitX(), normal, r[d * i], 0.0});
    } else {
      for (Eigen::Index k = 0; k < d; ++k) known_[d * i + k] = -at.H[d * i] * normal[k];
    }
    if (branch.tangent == Branch::Tangent::stick) {
      for (Eigen::Index k = 1; k < d; ++k)
        if (!met(d * i + k))
          unknowns_.push_back({pair, Eigen::Vector3d::Unit(k), Eigen::Vector3d::Unit(k), r[d * i + k], 0.0});
      continue;
    }
    const bool across = slips && d == 3 && branch.lambda > 1e-14;
    if (!across) {
      known_.segment(d * i + 1, d - 1) -= at.H.segment(d * i + 1, d - 1);
      continue;
    }
    const double along = at.H.segment<2>(3 * i + 1).dot(branch.along);
    known_.segment<2>(3 * i + 1) -= along * branch.along;
    const Eigen::Vector3d side(0.0, -branch.along[1], branch.along[0]);
    unknowns_.push_back({pair, side, side, branch.lambda * r[3 * i + 1], 1.0 - branch.lambda});
  }
  first_of_pair_.back() = static_cast<int>(unknowns_.size());
}

void NewtonDirection::expand(const Vector& y, Vector& dp) const {
  const Eigen::Index d = equations_.problem().dimension;
  for (std::size_t j = 0; j < unknowns_.size(); ++j)
    for (Eigen::Index k = 0; k < d; ++k)
      dp[d * unknowns_[j].pair + k] += unknowns_[j].column[k] * y[static_cast<Eigen::Index>(j)];
}

void NewtonDirection::gather(const Vector& motion, Vector& rows) const {
  const Eigen::Index d = equations_.problem().dimension;
  for (std::size_t j = 0; j < unknowns_.size(); ++j) {
    const Unknown& unknown = unknowns_[j];
    double sum = 0.0;
    for (Eigen::Index k = 0; k < d; ++k) sum += unknown.row[k] * motion[d * unknown.pair + k];
    rows[static_cast<Eigen::Index>(j)] = sum;
  }
}

bool NewtonDirection::solve(const Residual& at, double regularisation, Vector& d) {
  const Problem& problem = equations_.problem();
  lay_out(at);
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index m = problem.G.cols(), forces = known_.size();
  problem.W.apply(known_, moved_);
  right_.resize(forces + m);  // the leading size + m count: one size, so that memory is taken once

  gather(moved_, right_);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& unknown = unknowns_[static_cast<std::size_t>(j)];
    double H = 0.0;
    for (Eigen::Index k = 0; k < problem.dimension; ++k)
      H += unknown.row[k] * at.H[problem.dimension * unknown.pair + k];
    right_[j] = -H - unknown.scale * right_[j];
  }
  if (m > 0) {
    auto balance = right_.segment(size, m);
    balance = -at.H.tail(m);
    balance.noalias() -= problem.G.transpose() * known_;
  }

  bool solved = false;
  if (problem.W.is_sparse() && size + m >= least_sparse)
    solved = (problem.dimension == 2 ? solve_by_joints<2>(regularisation) : solve_by_joints<3>(regularisation)) ||
             solve_sparse(regularisation);
  else if (holding_pays(problem, size + m) && solve_by_holding(regularisation))
    solved = true;
  else if (problem.W.is_dense() && !work_->line_fails && size + m > least_of_line && solve_along_joints(regularisation))
    solved = true;
  else if (problem.W.is_dense() && !work_->single_fails && size + m > least_of_single && size + m <= most_of_single &&
           solve_by_single_precision(regularisation))
    solved = true;
  else if (work_->single_fails && solve_by_holding(regularisation))
    solved = true;
  else if (problem.W.is_dense() ? size + m <= most_of_dense : std::max(size + m, forces) <= most_of_formed)
    solved = solve_dense(regularisation);
  else
    solved = solve_iteratively(regularisation);
  if (!solved) return false;
  d.resize(forces + m);
  expand(y_, known_);
  d.head(forces) = known_;
  d.tail(m) = y_.segment(size, m);
  return d.allFinite();
}

bool NewtonDirection::solve_by_holding(double regularisation) {
  const Problem& problem = equations_.problem();
  const PairHolder* const holder = problem.W.holder();
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index m = problem.G.cols(), d = problem.dimension, n = size + m;
  if (holder == nullptr || size == 0 || work_->holding_fails) return false;
  work_->holding_fails = true;
  std::vector<int> rows;
  Vector scale(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& unknown = unknowns_[static_cast<std::size_t>(j)];
    Eigen::Index component = 0;
    if (unknown.row.cwiseAbs().maxCoeff(&component) != 1.0) return false;  // across the slip in space
    rows.push_back(static_cast<int>(d * unknown.pair + component));
    scale[j] = unknown.scale;
  }
  const std::unique_ptr<HeldPairs> held = holder->hold(rows);
  if (!held) return false;
  const double factor = problem.W.factor();
  Vector p, a;
  const auto precondition = [&](const Vector& x, Vector& result) {
    held->solve(x.head(size).cwiseQuotient(scale) / factor, x.tail(m), p, a);
    result.resize(n);
    result.head(size) = p;
    result.tail(m) = factor * a;
  };
  const auto multiply = [&](const Vector& x, Vector& result) { apply(x, regularisation, result); };
  const Vector right = right_.head(n);
  y_.setZero(n);
  const double left = gmres(multiply, precondition, right, y_, holding_gmres);
  work_->holding_fails = !(y_.allFinite() && left <= Workspace::exact);
  return !work_->holding_fails;
}

void NewtonDirection::apply(const Vector& x, double regularisation, Vector& result) {
  Workspace& work = *work_;
  const Problem& problem = equations_.problem();
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  work.full.setZero(problem.W.size());
  expand(x, work.full);
  problem.W.apply(work.full, work.image);
  problem.G.add_motion(x.tail(problem.G.cols()), work.image);
  result.resize(x.size());
  gather(work.image, result);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& unknown = unknowns_[static_cast<std::size_t>(j)];
    result[j] = unknown.scale * result[j] + (regularisation * (1.0 - unknown.own) + unknown.own) * x[j];
  }
  result.tail(problem.G.cols()) = problem.G.transpose() * work.full;
  result.tail(problem.G.cols()) -= regularisation * x.tail(problem.G.cols());
}

NewtonDirection::PairBlocks NewtonDirection::pair_blocks(double regularisation) {
  const Problem& problem = equations_.problem();
  const int d = problem.dimension;
  if (work_->blocks.size() == 0) work_->blocks = problem.W.diagonal_blocks(d);
  PairBlocks blocks;
  blocks.inverse.resize(first_of_pair_.size() - 1);
  for (std::size_t i = 0; i < blocks.inverse.size(); ++i) {
    const int first = first_of_pair_[i], count = first_of_pair_[i + 1] - first;
    Eigen::Matrix3d block = Eigen::Matrix3d::Identity(), W = Eigen::Matrix3d::Zero();
    W.topLeftCorner(d, d) = work_->blocks.middleCols(d * static_cast<Eigen::Index>(i), d);
    for (int row = 0; row < count; ++row)
      for (int column = 0; column < count; ++column) {
        const Unknown& to = unknowns_[static_cast<std::size_t>(first + row)];
        const Unknown& from = unknowns_[static_cast<std::size_t>(first + column)];
        block(row, column) = to.scale * to.row.dot(W * from.column) +
                             (row == column ? regularisation * (1.0 - from.own) + from.own : 0.0);
      }
    blocks.inverse[i] = block.inverse();
    if (!blocks.inverse[i].allFinite()) blocks.inverse[i].setIdentity();
  }
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index m = problem.G.cols();
  if (m == 0) return blocks;
  const Matrix& G = problem.G.dense();
  blocks.motion.setZero(size, m);
  blocks.force.setZero(m, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Unknown& unknown = unknowns_[static_cast<std::size_t>(j)];
    for (Eigen::Index k = 0; k < d; ++k) {
      blocks.motion.row(j) += unknown.scale * unknown.row[k] * G.row(d * unknown.pair + k);
      blocks.force.col(j) += unknown.column[k] * G.row(d * unknown.pair + k).transpose();
    }
  }
  Matrix solved(size, m);
  for (Eigen::Index g = 0; g < m; ++g) {
    Vector column;
    solve_pairs(blocks, blocks.motion.col(g), column);
    solved.col(g) = column;
  }
  blocks.balance.compute(blocks.force * solved + regularisation * Matrix::Identity(m, m));
  return blocks;
}

void NewtonDirection::solve_pairs(const PairBlocks& blocks, const Eigen::Ref<const Vector>& x, Vector& y) const {
  y.resize(x.size());
  for (std::size_t i = 0; i < blocks.inverse.size(); ++i) {
    const int first = first_of_pair_[i], count = first_of_pair_[i + 1] - first;
    y.segment(first, count).noalias() = blocks.inverse[i].topLeftCorner(count, count) * x.segment(first, count);
  }
}

bool NewtonDirection::solve_iteratively(double regularisation) {
  const auto size = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index m = equations_.problem().G.cols();
  const PairBlocks blocks = pair_blocks(regularisation);
  if (m > 0 && !(blocks.balance.rcond() > 1e-13)) return false;  // too few pairs hold the bodies
  Vector y, da;
  const auto precondition = [&](const Vector& x, Vector& result) {
    solve_pairs(blocks, x.head(size), y);
    result.resize(size + m);
    if (m > 0) {
      da = blocks.balance.solve(Vector(blocks.force * y - x.tail(m)));
      solve_pairs(blocks, x.head(size) - blocks.motion * da, y);
      result.tail(m) = da;
    }
    result.head(size) = y;
  };
  const auto multiply = [&](const Vector& x, Vector& result) { apply(x, regularisation, result); };
  const Vector right = right_.head(size + m);
  y_.setZero(right.size());
  return gmres(multiply, precondition, right, y_, {1e-11, 80, 400}) <= 1e-8;
}

}  // namespace scabo::contact
