#include "scabo/analysis/march/limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scabo::analysis {

namespace {

constexpr double first_size = 1.0;         // of the factor: loads as they are given, friction halved
constexpr double endless = 1048576.0;      // 2^20: loads that bodies carry without limit
constexpr double smallest_bracket = 1e-6;  // of a limit that may be 0

double size_of(const StepProgress& progress) { return progress.size > 0.0 ? progress.size : first_size; }

}  // namespace

std::optional<LimitTrial> next_trial(const model::Step& step, const StepProgress& progress) {
  const double solved = model::limit_factor(step, progress.reached);
  if (progress.limit == 0.0) {
    if (size_of(progress) > endless) return {};
    return LimitTrial{model::part_at_factor(step, solved + size_of(progress)), false};
  }
  const double beyond = model::limit_factor(step, progress.limit);
  const double wanted = std::max(step.limit->relative * std::abs(beyond), smallest_bracket);
  if (beyond - solved <= wanted) return LimitTrial{progress.limit, true};
  return LimitTrial{model::part_at_factor(step, 0.5 * (solved + beyond)), false};
}

StepProgress after_trial(const model::Step& step, StepProgress progress, const LimitTrial& trial) {
  if (trial.last) {
    progress.size = 2.0 * (model::limit_factor(step, trial.end) - model::limit_factor(step, progress.reached));
    progress.limit = 0.0;
  } else if (progress.limit == 0.0) {
    progress.size = 2.0 * size_of(progress);
  }
  progress.reached = trial.end;
  ++progress.increment;
  return progress;
}

Limit limit_at(const model::Step& step, const StepProgress& progress, const Reached* reached) {
  const double solved = model::limit_factor(step, progress.reached);
  if (!reached) return {solved, std::numeric_limits<double>::infinity(), Outcome::solved, {}};
  const Outcome outcome = reached->mechanism  ? Outcome::mechanism
                          : reached->collapse ? Outcome::collapse
                                              : Outcome::not_converged;
  return {solved, model::limit_factor(step, progress.limit), outcome, reached->reason};
}

}  // namespace scabo::analysis
