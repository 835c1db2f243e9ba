// How far an increment was reached, in one attempt or in parts, and why it ended there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/diagnostics/mechanism.hpp"
#include "scabo/analysis/march/attempt.hpp"
#include "scabo/analysis/march/increment_size.hpp"
#include "scabo/analysis/march/options.hpp"

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
  bool mesh_is_due = false;         ///< the end was not reached: before going on, there must be another mesh
  std::vector<AttemptResult> attempts;
  std::vector<DiscreteProblem> problems;  ///< of the attempts, if requested
};

/// Keeps an attempt in the history of the increment, and its problem if that is wanted.
void record(const Prepared& prepared, const Attempt& tried, const Options& options, Reached& reached);

/// The attempt ends at part `part` of the increment.
void accept(Attempt tried, double part, Reached& reached);

/// Whether an attempt is so far from a solution that half of the loads would not be solved either where that is the
/// same problem, scaled. The tolerance is for forces relative to the largest load of the whole step, so that a figure
/// just above it may be within it at half of the loads.
bool is_far_from_solved(const Prepared& prepared, const Attempt& tried);

/// Why an attempt to reach part `part` of the increment is the last one.
void give_up(const Prepared& prepared, const Attempt& tried, double part, Reached& reached);

/// What to do about a tolerance that is missed by a figure of the certificate well below the default tolerance, as the
/// end of a sentence; empty for larger figures.
std::string tolerance_to_set(double figure, double tolerance, int degrees_of_freedom);

}  // namespace scabo::analysis
