#include "scabo/contact/interior/interior_points.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/constants.hpp"
#include "scabo/contact/interior/judged_steps.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

namespace {

template <int d>
InteriorPointEnd along_path(const Problem& problem, const IsSolution& accepts, const Deadline& deadline, double start,
                            double aim) {
  const InteriorConstants& c = interior_constants;
  const Measure measure(problem);
  InteriorSteps<d> steps(problem);
  steps.start(start);
  steps.evaluate();
  steps.measure_from_here();
  double least_gap = HUGE_VAL, least_residual = HUGE_VAL;
  InteriorPointEnd end;
  for (int since = 0;; ++end.iterations) {
    interruption_point();
    deadline.spend(operations_of_system(problem));
    const double residual = judge_iterate(steps, problem, measure, accepts, "interior point", end);
    if (!std::isfinite(residual) || end.accepted || residual <= aim) break;
    since = steps.gap() <= c.gain * least_gap || residual <= c.gain * least_residual ? 0 : since + 1;
    least_gap = std::min(least_gap, steps.gap());
    least_residual = std::min(least_residual, residual);
    if (end.iterations >= c.most || since >= c.patience || deadline.passed() || !steps.advance()) break;
    steps.evaluate();
  }
  return end;
}

}  // namespace

bool may_take_interior_points(const Problem& problem) {
  return problem.pairs() > 0 &&
         (problem.W.is_sparse() || (problem.W.is_dense() && problem.W.size() <= interior_constants.most_dense)) &&
         problem.W.diagonal().minCoeff() >= 0.0 && !(problem.q.isZero(0.0) && problem.f.isZero(0.0));
}

InteriorPointEnd interior_points(const Problem& problem, const IsSolution& accepts, const Deadline& deadline,
                                 double start, double aim) {
  return problem.dimension == 3 ? along_path<3>(problem, accepts, deadline, start, aim)
                                : along_path<2>(problem, accepts, deadline, start, aim);
}

}  // namespace scabo::contact
