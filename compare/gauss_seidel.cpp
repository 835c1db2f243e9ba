#include "compare/gauss_seidel.hpp"

#include "scabo/contact/sweeps/gauss_seidel.hpp"

namespace scabo::compare {

End gauss_seidel(const Problem& problem, Vector p, const Control& control) {
  const Matrix r = pair_stiffness(problem);
  End end;
  Best best(end);
  std::vector<int> before;
  const std::unique_ptr<GaussSeidel> iteration = contact::gauss_seidel(problem);
  const int sweeps = 400 * control.iterations;
  for (int sweep = 0;; ++sweep) {
    if (sweep % 10 == 0 || sweep == sweeps) {
      iteration->start(p);  // anew, because rounding accumulates
      const Vector H = residual_of(problem, r, p, Vector());
      best.offer(p, Vector(), largest(H));
      const std::vector<int> states = states_at(problem, r, p, contact::motion_of(problem, p, Vector()));
      end.trace.push_back({sweep, largest(H), 0.5 * H.squaredNorm(), 1.0, changes(before, states), "gauss_seidel"});
      before = states;
      end.iterations = sweep;
      end.converged = largest(H) <= control.small;
      if (end.converged) return end;
      if (!p.allFinite() || sweep == sweeps || control.deadline.passed()) break;
    }
    iteration->sweep(p);
  }
  end.reason =
      p.allFinite() ? "the sweeps did not reach the tolerance within the limit of iterations" : "the sweeps diverged";
  return end;
}

}  // namespace scabo::compare
