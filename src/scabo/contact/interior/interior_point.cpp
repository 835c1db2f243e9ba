#include "scabo/contact/interior/interior_point.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/interior/interior_steps.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

namespace {

template <int d>
InteriorPointEnd follow_to_the_end(const Problem& problem, double start_factor, const IsSolution& content,
                                   const Deadline& deadline) {
  constexpr int most = 100;     // towers and walls that are solved take 11 to 90
  constexpr int patience = 5;   // steps without `gain` in the residual or in m: rounding, or steps that collapsed
  constexpr double gain = 0.9;  // of the least so far
  InteriorSteps<d> steps(problem, start_factor);
  InteriorPointEnd end;
  end.residual = HUGE_VAL;
  const Measure measure(problem);
  double least_gap = HUGE_VAL;
  int since = 0;
  for (;; ++end.iterations) {
    interruption_point();
    deadline.spend(operations_of_system(problem));
    steps.evaluate();
    if (end.iterations == 0) steps.measure_from_here();
    const double before = end.residual;
    const double residual = judge_iterate(steps, problem, measure, content, "interior point", end);
    if (!std::isfinite(residual) || end.content) break;
    ++since;
    if (steps.gap() <= gain * least_gap || residual <= gain * before) since = 0;
    least_gap = std::min(least_gap, steps.gap());
    if (end.iterations >= most || since >= patience || deadline.passed() || !steps.advance()) break;
  }
  return end;
}

}  // namespace

bool may_factorise_with_pairs(const Problem& problem, Eigen::Index most_dense) {
  return problem.pairs() > 0 && (problem.W.is_sparse() || (problem.W.is_dense() && problem.W.size() <= most_dense)) &&
         problem.W.diagonal().minCoeff() >= 0.0 && problem.W.diagonal().mean() > 0.0 &&
         !(problem.q.isZero(0.0) && problem.f.isZero(0.0));
}

bool may_take_interior_points(const Problem& problem) {
  constexpr Eigen::Index most_dense = 1000;
  return may_factorise_with_pairs(problem, most_dense) && problem.cohesion.size() == 0 && problem.tension.size() == 0 &&
         problem.mu_backward.size() == 0 &&  // the cone must be its own dual, scaled by one mu
         problem.mu.minCoeff() > 0.0;
}

InteriorPointEnd interior_points(const Problem& problem, const IsSolution& content, const Deadline& deadline,
                                 double start_factor) {
  return problem.dimension == 3 ? follow_to_the_end<3>(problem, start_factor, content, deadline)
                                : follow_to_the_end<2>(problem, start_factor, content, deadline);
}

}  // namespace scabo::contact
