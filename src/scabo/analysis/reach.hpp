// The end of an increment, in one attempt or in parts.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/increment.hpp"
#include "scabo/analysis/increment_size.hpp"
#include "scabo/analysis/large_slip.hpp"
#include "scabo/analysis/mechanism.hpp"

namespace scabo::analysis {

/// Result of an attempt to reach the end of an increment.
struct Reached {
  State state;
  double part = 0.0;  ///< of the increment that was reached: 1, or less of an automatic increment
  Changes changes;    ///< of an automatic increment
  contact::Certificate certificate;
  /// Of an automatic increment: the part at which there was no equilibrium, if it is in parts for that; 0: none.
  double limit = 0.0;
  int iterations = 0, coarse_iterations = 0, halvings = 0;
  double residual = 0.0;
  Matrix undetermined;
  contact::Problem problem;  ///< that was solved last
  std::optional<UniquenessResult> uniqueness;
  bool mechanism = false, collapse = false, stopped = false;
  std::optional<Mechanism> motion;  ///< of a mechanism or collapse
  std::string reason;               ///< empty if the end was reached
  bool pairs_are_due = false;       ///< the end was not reached: before going on, pairs are to be found anew
  std::vector<AttemptResult> attempts;
  std::vector<DiscreteProblem> problems;  ///< of the attempts, if requested
};

/// Proceeds from the state in `reached` along `factors_at` (0: start of the increment, 1: its end), halving the step if
/// an attempt is not accepted; every part starts from the last accepted state. With `least`, that of an automatic
/// increment, it ends with the first attempt that is accepted, and is halved down to that, even where there is no
/// equilibrium, so that increments close in on the loads that can still be carried.
/// With large slip it also ends where pairs are to be found anew, and goes on from what it then `reached`; an attempt
/// whose sides pass each other too far is made again in equal smaller parts.
Reached reach(const Prepared& prepared, Reached reached, const std::function<Factors(double)>& factors_at,
              std::optional<double> least, const LargeSlip* large, const Options& options);

/// What to do about a tolerance that is missed by a figure of the certificate well below the default tolerance, as the
/// end of a sentence; empty for larger figures.
std::string tolerance_to_set(double figure, double tolerance, int degrees_of_freedom);

}  // namespace scabo::analysis
