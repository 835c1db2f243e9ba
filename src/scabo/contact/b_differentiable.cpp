#include "scabo/contact/b_differentiable.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

namespace scabo::contact {

namespace {

/// Forces differing by less than this, relative to their size, are equal within rounding: a tie.
constexpr double tie = 1e-12;

bool tied(double a, double b, double scale) { return std::abs(a - b) <= tie * scale; }

/// A x = b for square A that may be singular: nothing when b is out of reach, the shortest x when there are many.
std::optional<Vector> solve_linear(const Matrix& A, const Vector& b) {
  if (A.rows() == 0) return Vector();
  const auto reached = [&](const Vector& x) {
    return x.allFinite() && (A * x - b).lpNorm<Eigen::Infinity>() <=
                                1e-9 * (b.lpNorm<Eigen::Infinity>() + 1e-30 * A.cwiseAbs().maxCoeff());
  };
  const Eigen::PartialPivLU<Matrix> lu(A);
  if (lu.rcond() > 1e-13) {
    Vector x = lu.solve(b);
    x += lu.solve(b - A * x);  // one step of refinement: the certificate is judged at 1e-10
    if (reached(x)) return x;
  }
  Eigen::CompleteOrthogonalDecomposition<Matrix> cod;
  cod.setThreshold(1e-11);
  cod.compute(A);
  const Vector x = cod.solve(b);
  if (reached(x)) return x;
  return std::nullopt;
}

}  // namespace

BDifferentiableEquations::BDifferentiableEquations(const Problem& problem, double r_factor) : problem_(problem) {
  const Vector diagonal = problem.W.diagonal();
  r_.resize(diagonal.size());
  const double mean = diagonal.size() > 0 ? diagonal.mean() : 1.0;
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    r_[i] = r_factor / (diagonal[i] > 1e-14 * mean ? diagonal[i] : mean > 0.0 ? mean : 1.0);
}

Residual BDifferentiableEquations::residual(const Vector& p, const Vector& a) const {
  const int N = problem_.pairs();
  Vector motion = problem_.q;
  motion += problem_.W * p;
  if (a.size() > 0) motion.noalias() += problem_.G * a;
  Residual at{Vector(2 * N + a.size()), std::vector<Branch>(static_cast<std::size_t>(N))};
  for (Eigen::Index i = 0; i < N; ++i) {
    const double rg = r_[2 * i] * motion[2 * i], pn = p[2 * i];
    const double pt = p[2 * i + 1], trial = pt - r_[2 * i + 1] * motion[2 * i + 1];
    const double bound = problem_.mu[i] * std::max(pn, 0.0);
    Branch& branch = at.branches[static_cast<std::size_t>(i)];
    branch.contact = rg <= pn;  // at a tie: contact
    branch.normal_tie = tied(rg, pn, std::abs(rg) + std::abs(pn)) || (rg == 0.0 && pn == 0.0);
    at.H[2 * i] = std::min(rg, pn);                                          // Zhu 2017, eq. (7)
    if (bound == 0.0) {
      branch.tangent = Branch::Tangent::free;
      branch.tangent_tie = problem_.mu[i] > 0.0 && branch.contact;
      at.H[2 * i + 1] = pt;
    } else if (std::abs(trial) <= bound) {
      branch.tangent = Branch::Tangent::stick;
      branch.tangent_tie = tied(std::abs(trial), bound, bound);
      branch.sign = 0.0;
      at.H[2 * i + 1] = pt - trial;
    } else {
      branch.tangent = Branch::Tangent::slip;
      branch.tangent_tie = tied(std::abs(trial), bound, bound);
      branch.sign = trial > 0.0 ? 1.0 : -1.0;
      at.H[2 * i + 1] = pt - bound * branch.sign;                            // eq. (8)
    }
  }
  if (a.size() > 0) at.H.tail(a.size()) = problem_.G.transpose() * p + problem_.f;
  return at;
}

std::optional<Vector> BDifferentiableEquations::direction(const Residual& at) const {
  const Eigen::Index N = problem_.pairs(), m = problem_.G.cols();
  // dp = known + P y: y are the forces whose row is a motion (normals in contact, tangents that stick); tangents that
  // slip follow their normal force.
  std::vector<int> motions;
  std::vector<int> unknown_of(static_cast<std::size_t>(2 * N), -1);
  Vector known = Vector::Zero(2 * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    const Branch& branch = at.branches[static_cast<std::size_t>(i)];
    if (branch.contact) {
      unknown_of[static_cast<std::size_t>(2 * i)] = static_cast<int>(motions.size());
      motions.push_back(static_cast<int>(2 * i));
    } else {
      known[2 * i] = -at.H[2 * i];
    }
    if (branch.tangent == Branch::Tangent::stick) {
      unknown_of[static_cast<std::size_t>(2 * i + 1)] = static_cast<int>(motions.size());
      motions.push_back(static_cast<int>(2 * i + 1));
    } else {
      known[2 * i + 1] = -at.H[2 * i + 1];
      if (branch.tangent == Branch::Tangent::slip && !branch.contact)
        known[2 * i + 1] += problem_.mu[i] * branch.sign * known[2 * i];
    }
  }
  const auto size = static_cast<Eigen::Index>(motions.size());
  Matrix A = Matrix::Zero(size + m, size + m);
  Vector b(size + m);
  const Matrix& W = problem_.W.dense();
  const auto follows = [&](Eigen::Index row, Eigen::Index i) {  // coefficient of a normal's unknown in a motion's row
    const Branch& branch = at.branches[static_cast<std::size_t>(i)];
    double value = W(row, 2 * i);
    if (branch.tangent == Branch::Tangent::slip) value += W(row, 2 * i + 1) * problem_.mu[i] * branch.sign;
    return value;
  };
  const Vector moved = problem_.W * known;
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::Index column = motions[static_cast<std::size_t>(k)], i = column / 2;
    for (Eigen::Index row = 0; row < size; ++row) {
      const Eigen::Index at_row = motions[static_cast<std::size_t>(row)];
      A(row, k) = r_[at_row] * (column % 2 == 0 ? follows(at_row, i) : W(at_row, column));
    }
    A.block(size, k, m, 1) = problem_.G.row(column).transpose();
    const Branch& branch = at.branches[static_cast<std::size_t>(i)];
    if (column % 2 == 0 && branch.tangent == Branch::Tangent::slip)
      A.block(size, k, m, 1) += problem_.mu[i] * branch.sign * problem_.G.row(column + 1).transpose();
    // H2 = r g here; H3 = r ds where it sticks.
    A.block(k, size, 1, m) = r_[column] * problem_.G.row(column);
    b[k] = -at.H[column] - r_[column] * moved[column];
  }
  if (m > 0) b.tail(m) = -at.H.tail(m) - problem_.G.transpose() * known;

  const std::optional<Vector> solved = solve_linear(A, b);
  if (!solved) return std::nullopt;
  Vector d(2 * N + m);
  d.head(2 * N) = known;
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::Index column = motions[static_cast<std::size_t>(k)];
    d[column] = (*solved)[k];
    const Branch& branch = at.branches[static_cast<std::size_t>(column / 2)];
    if (column % 2 == 0 && branch.tangent == Branch::Tangent::slip)
      d[column + 1] += problem_.mu[column / 2] * branch.sign * d[column];
  }
  d.tail(m) = solved->tail(m);
  return d;
}

bool BDifferentiableEquations::line_search(const Vector& d, Vector& p, Vector& a, Residual& at) const {
  constexpr double sufficient = 1e-4;
  constexpr int halvings = 12;
  const double merit = at.merit();
  double step = 1.0;
  for (int k = 0; k <= halvings; ++k, step *= 0.5) {
    const Vector p_next = p + step * d.head(p.size());
    const Vector a_next = a + step * d.tail(a.size());
    Residual next = residual(p_next, a_next);
    if (next.merit() <= (1.0 - 2.0 * sufficient * step) * merit) {  // theta'(z; d) = -2 theta
      p = p_next;
      a = a_next;
      at = std::move(next);
      return true;
    }
  }
  return false;
}

Residual BDifferentiableEquations::other_branch(const Residual& at) const {
  Residual other = at;
  for (Branch& branch : other.branches) {
    if (branch.normal_tie) branch.contact = !branch.contact;
    if (!branch.tangent_tie || branch.tangent == Branch::Tangent::free) continue;
    branch.tangent = branch.tangent == Branch::Tangent::stick ? Branch::Tangent::slip : Branch::Tangent::stick;
  }
  return other;
}

NewtonEnd BDifferentiableEquations::newton(Vector p, Vector a, double small, int iterations) const {
  NewtonEnd end;
  end.p = p;
  end.a = a;
  end.residual = HUGE_VAL;  // stays where H is not finite: never converged
  Residual at = residual(p, a);
  double best_merit = HUGE_VAL;
  const auto keep_best = [&] {
    if (!(at.merit() < best_merit)) return;
    best_merit = at.merit();
    end.p = p;
    end.a = a;
    end.residual = at.H.size() > 0 ? at.H.lpNorm<Eigen::Infinity>() : 0.0;
  };
  int unchecked = 0;  // full steps without descent since the best point
  while (true) {
    keep_best();
    end.trace.push_back({end.iterations, at.H.size() > 0 ? at.H.lpNorm<Eigen::Infinity>() : 0.0, at.merit(), 1.0, 0, "newton"});
    end.converged = end.residual <= small;
    if (end.converged || end.iterations >= iterations) break;
    const std::optional<Vector> d = direction(at);
    ++end.iterations;
    if (d && line_search(*d, p, a, at)) continue;
    const Residual other = other_branch(at);
    if (other.branches != at.branches) {
      const std::optional<Vector> second = direction(other);
      if (second && line_search(*second, p, a, at)) continue;
    }
    // H is piecewise linear: near a kink the full step may lead on where no shorter one descends. A few are allowed,
    // and the best point is kept.
    constexpr int most_unchecked = 8;
    if (!d || ++unchecked > most_unchecked) {
      end.singular = !d;
      break;
    }
    p += d->head(p.size());
    a += d->tail(a.size());
    at = residual(p, a);
  }
  return end;
}

}  // namespace scabo::contact
