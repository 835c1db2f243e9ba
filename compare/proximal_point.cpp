#include "compare/proximal_point.hpp"

#include "compare/alart_curnier.hpp"

namespace scabo::compare {

namespace {

/// The problem held at (p, a), rigid motions eliminated: a = a_k + (G'p + f) / beta. alpha and beta in the
/// units of forces.
Problem held_at(const Problem& problem, const Vector& p, const Vector& a, double alpha, double beta) {
  Problem held = problem;
  Matrix W = problem.W.dense();
  W.diagonal().array() += alpha;
  held.q -= alpha * p;
  if (a.size() > 0) {
    W.noalias() += problem.G.dense() * problem.G.dense().transpose() / beta;
    held.q.noalias() += problem.G * (a + problem.f / beta);
    held.G.resize(problem.q.size(), 0);
    held.f.resize(0);
  }
  held.W = Delassus(std::move(W));
  return held;
}

}  // namespace

End proximal_point(const Problem& problem, Vector p, Vector a, const Control& control, const Vector* bound) {
  const Matrix r = pair_stiffness(problem);
  const double smallest = 1e-7;
  double alpha = 0.1;  // of the mean of W, which is 1
  End end;
  Best best(end);
  std::vector<int> before;
  const auto residual_here = [&] {
    if (!bound) return residual_of(problem, r, p, a);
    Problem given = problem;  // Tresca's law as cohesion without friction
    given.mu.setZero();
    given.cohesion = *bound;
    return residual_of(given, r, p, a);
  };
  for (int round = 0;; ++round) {
    const Vector H = residual_here();
    const std::vector<int> states = states_at(problem, r, p, motion_of(problem, p, a));
    best.offer(p, a, largest(H));
    end.trace.push_back(
        {end.iterations, largest(H), 0.5 * H.squaredNorm(), 1.0, changes(before, states), "proximal_point"});
    before = states;
    end.converged = largest(H) <= control.small;
    if (end.converged) return end;
    if (round >= 4 * control.iterations || control.deadline.passed()) {
      end.reason = "the proximal-point iterations did not converge within the limit of iterations";
      return end;
    }
    const Problem held = held_at(problem, p, a, alpha, alpha);
    const Control inner{std::max(0.1 * control.small, 1e-4 * largest(H)), control.iterations, control.deadline};
    const End solved = alart_curnier(held, p, Vector(), inner, bound);
    end.iterations += solved.iterations;
    if (!solved.converged && (alpha *= 10.0) > 1e4) {
      end.reason = "even the regularised problem was not solved: " + solved.reason;
      return end;
    }
    if (!solved.converged) continue;
    a += (problem.G.transpose() * solved.p + problem.f) / alpha;
    p = solved.p;
    if (solved.iterations <= 10) alpha = std::max(0.1 * alpha, smallest);
  }
}

int start_softly(const Problem& problem, Vector& p, Vector& a, const Control& control) {
  if (a.size() == 0 || !p.isZero(0.0)) return 0;
  const double soft = 0.1;
  const Control rough{std::max(control.small, 1e-8 * largest(problem.f)), control.iterations, control.deadline};
  const End held = alart_curnier(held_at(problem, p, a, 1e-8, soft), p, Vector(), rough);
  a += (problem.G.transpose() * held.p + problem.f) / soft;
  p = held.p;
  return held.iterations;
}

}  // namespace scabo::compare
