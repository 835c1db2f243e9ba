#include "compare/trial_and_error.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <optional>
#include <set>

#include "compare/proximal_point.hpp"

namespace scabo::compare {

namespace {

struct Trial {
  ContactState state = ContactState::open;
  Local direction;  // of p_t where it slips, d - 1
};
using Trials = std::vector<Trial>;

Trials first_guess(const Problem& problem, const Matrix& r, const Vector& p, const Vector& motion) {
  const Eigen::Index t = problem.dimension - 1;
  const std::vector<int> states = states_at(problem, r, p, motion);
  Trials trials;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    Trial trial{ContactState::open, Local::Zero(t)};
    const int state = states[static_cast<std::size_t>(i)];
    const Local p_t = p.segment((t + 1) * i + 1, t) - r(1, i) * motion.segment((t + 1) * i + 1, t);
    if (state > 0) trial.state = problem.mu[i] > 0.0 ? ContactState::stick : ContactState::slip;
    if (state == 2 && p_t.norm() > 0.0 && p[(t + 1) * i] > 0.0) {
      trial.state = ContactState::slip;
      trial.direction = p_t.normalized();
    }
    trials.push_back(trial);
  }
  return trials;
}

/// Solves the linear equations for the states: [p; a], the shortest solution if they do not determine it, nothing if
/// they contradict each other.
std::optional<Vector> solve(const Problem& problem, const Trials& trials) {
  const Eigen::Index d = problem.dimension, N = problem.pairs(), m = problem.G.cols(), t = d - 1;
  const Matrix& W = problem.W.dense();
  // p = P y: y are the forces whose row is a motion; tangential forces of slipping pairs follow their normal force.
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < N; ++i) {
    const Trial& trial = trials[static_cast<std::size_t>(i)];
    if (trial.state == ContactState::open) continue;
    rows.push_back(d * i);
    for (Eigen::Index k = 1; k < d && trial.state == ContactState::stick; ++k) rows.push_back(d * i + k);
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  Matrix columns(d * N, n);  // W P
  Matrix couplings(n, m);    // P' G
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index row = rows[static_cast<std::size_t>(k)], i = row / d;
    const Trial& trial = trials[static_cast<std::size_t>(i)];
    columns.col(k) = W.col(row);
    couplings.row(k) = problem.G.dense().row(row);
    if (trial.state != ContactState::slip) continue;
    columns.col(k) += problem.mu[i] * W.middleCols(row + 1, t) * trial.direction;
    couplings.row(k) += problem.mu[i] * trial.direction.transpose() * problem.G.dense().middleRows(row + 1, t);
  }
  Matrix A = Matrix::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = columns(rows, Eigen::all);
  Vector b(n + m);
  b.head(n) = -problem.q(rows);
  if (m > 0) {
    A.topRightCorner(n, m) = problem.G.dense()(rows, Eigen::all);
    A.bottomLeftCorner(m, n) = couplings.transpose();
    b.tail(m) = -problem.f;
  }
  Vector y(0);
  if (n + m > 0) {
    const auto reached = [&] { return y.allFinite() && (A * y - b).norm() <= 1e-9 * b.norm(); };
    const Eigen::PartialPivLU<Matrix> lu(A);
    if (lu.rcond() > 1e-13) {
      y = lu.solve(b);
      y += lu.solve(b - A * y);
    }
    if (y.size() == 0 || !reached()) {
      Eigen::CompleteOrthogonalDecomposition<Matrix> cod;
      cod.setThreshold(1e-11);
      cod.compute(A);
      y = cod.solve(b);
      if (!reached()) return std::nullopt;
    }
  }
  Vector solved = Vector::Zero(d * N + m);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index row = rows[static_cast<std::size_t>(k)], i = row / d;
    const Trial& trial = trials[static_cast<std::size_t>(i)];
    solved[row] = y[k];
    if (trial.state == ContactState::slip) solved.segment(row + 1, t) += problem.mu[i] * y[k] * trial.direction;
  }
  solved.tail(m) = y.tail(m);
  return solved;
}

/// Changes the states that the solution contradicts.
Trials corrected(const Problem& problem, const Matrix& r, const Trials& trials, const Vector& p, const Vector& motion) {
  const Eigen::Index d = problem.dimension, t = d - 1;
  const double rounding = 1e-14 * (largest(p) + largest(problem.q));
  Trials next = trials;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    Trial& trial = next[static_cast<std::size_t>(i)];
    const Local p_t = p.segment(d * i + 1, t), slip = motion.segment(d * i + 1, t);
    const double bound = problem.friction_bound(i, p[d * i], p[d * i + 1]);
    if (trial.state == ContactState::open) {
      if (r(0, i) * motion[d * i] >= -rounding) continue;
      trial.state = problem.mu[i] > 0.0 ? ContactState::stick : ContactState::slip;
      trial.direction.setZero();
    } else if (p[d * i] < -rounding) {
      trial.state = ContactState::open;
      trial.direction.setZero();
    } else if (trial.state == ContactState::stick) {
      if (p_t.norm() <= bound + rounding) continue;
      trial.state = ContactState::slip;
      trial.direction = p_t.normalized();
    } else if (trial.direction.squaredNorm() > 0.0) {
      if (trial.direction.dot(slip) * r(1, i) > rounding) {
        trial.state = ContactState::stick;
        trial.direction.setZero();
      } else if (t > 1 && slip.norm() * r(1, i) > rounding) {
        trial.direction = -slip.normalized();
      }
    }
  }
  return next;
}

/// States and directions as a key, with directions rounded.
std::vector<long> key_of(const Trials& trials) {
  std::vector<long> key;
  for (const Trial& trial : trials) {
    key.push_back(static_cast<long>(trial.state));
    for (double part : trial.direction) key.push_back(std::lround(1e14 * part));
  }
  return key;
}

std::vector<int> states_of(const Trials& trials) {
  std::vector<int> states;
  for (const Trial& trial : trials) states.push_back(static_cast<int>(trial.state));
  return states;
}

}  // namespace

End trial_and_error(const Problem& problem, Vector p_start, Vector a_start, const Control& control) {
  const Matrix r = pair_stiffness(problem);
  const Eigen::Index size = p_start.size(), m = problem.G.cols();
  End end;
  Best best(end);
  start_softly(problem, p_start, a_start, control);
  best.offer(p_start, a_start, largest(residual_of(problem, r, p_start, a_start)));
  Trials trials = first_guess(problem, r, p_start, motion_of(problem, p_start, a_start));
  std::set<std::vector<long>> tried;
  std::vector<int> before;
  while (true) {
    if (!tried.insert(key_of(trials)).second) {
      end.reason = "the iterations cycle: these states were tried before";
      return end;
    }
    if (end.iterations >= 4 * control.iterations || control.deadline.passed()) {
      end.reason = "the limit of iterations was reached";
      return end;
    }
    ++end.iterations;
    const std::optional<Vector> solved = solve(problem, trials);
    if (!solved) {
      end.reason = "in the states tried, no forces exist that balance the loads and close the gaps";
      return end;
    }
    const Vector p = solved->head(size), a = solved->tail(m);
    const Vector H = residual_of(problem, r, p, a);
    best.offer(p, a, largest(H));
    end.trace.push_back({end.iterations, largest(H), 0.5 * H.squaredNorm(), 1.0, changes(before, states_of(trials)),
                         "trial_and_error"});
    before = states_of(trials);
    end.converged = largest(H) <= control.small;
    if (end.converged) return end;
    trials = corrected(problem, r, trials, p, motion_of(problem, p, a));
  }
}

}  // namespace scabo::compare
