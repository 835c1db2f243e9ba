#include "compare/tresca.hpp"

#include "compare/alart_curnier.hpp"
#include "compare/proximal_point.hpp"

namespace scabo::compare {

End tresca(const Problem& problem, Vector p, Vector a, const Control& control) {
  const Eigen::Index d = problem.dimension, N = problem.pairs();
  const Matrix r = pair_stiffness(problem);
  End end;
  Best best(end);
  std::vector<int> before;
  start_softly(problem, p, a, control);
  for (int round = 0;; ++round) {
    const Vector H = residual_of(problem, r, p, a);
    const std::vector<int> states = states_at(problem, r, p, motion_of(problem, p, a));
    best.offer(p, a, largest(H));
    end.trace.push_back({round, largest(H), 0.5 * H.squaredNorm(), 1.0, changes(before, states), "tresca"});
    before = states;
    end.iterations = round;
    end.converged = largest(H) <= control.small;
    if (end.converged) return end;
    if (round >= 4 * control.iterations || control.deadline.passed()) {
      end.reason = "the iterations on the friction bounds did not converge within the limit of iterations";
      return end;
    }
    Vector bound(N);
    for (Eigen::Index i = 0; i < N; ++i) bound[i] = pair_law(problem, i).bound(p[d * i]);
    // Well below what the next iteration needs, because the error of the bound dominates.
    const Control inner{std::max(0.3 * control.small, 1e-3 * largest(H)), control.iterations, control.deadline};
    End solved = alart_curnier(problem, p, a, inner, &bound);
    if (!solved.converged) solved = proximal_point(problem, p, a, inner, &bound);
    if (!solved.converged) {
      end.reason = "the problem with given friction bounds was not solved: " + solved.reason;
      return end;
    }
    p = solved.p;
    a = solved.a;
  }
}

}  // namespace scabo::compare
