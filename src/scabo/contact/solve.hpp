// Solves a discrete contact problem in three stages; each reports why it stopped (docs/methods/12_contact_solver.md).
//
// Newton's method on the B-differentiable equations, interior points with Newton's method after them, and sweeps of
// Gauss-Seidel (stages.hpp). Motions that no pair feels are taken out before (neutral_motions.hpp). The result is
// solved, as confirmed by contact/judge, or its status and reason say why not.
#pragma once

#include <functional>
#include <optional>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct SolverOptions {
  double tolerance = 1e-10;          ///< of the judge, dimensionless
  Judge judge = Judge::certificate;  ///< natural_map: W may be rank deficient
  int iterations = 50;               ///< of Newton in one attempt, > 0
  double r_factor = 1.0;             ///< r = r_factor / W_ii; the solution does not depend on it
  double force_scale = 0.0;          ///< largest applied force, >= 0: part of the scale of forces
  Deadline deadline;                 ///< end of the search, at which the best iterate is returned
  /// Told every iteration of Newton's method, for display; may be empty. What it throws ends the solve.
  std::function<void(const Iteration&)> on_iteration;
};

Solution solve(const Problem& problem, const Start& start = {}, const SolverOptions& options = {});

/// A solution with other forces p that cause the same motions, judged anew; nothing if it is not solved with these.
/// Gaps and slips stay those of `solution`, to the last bit.
std::optional<Solution> with_forces(const Solution& solution, Vector p, const Problem& problem, const Start& start,
                                    const SolverOptions& options);

/// A solution with other rigid motions a under the same forces, judged anew; nothing if it is not solved with these.
/// Which motions are undetermined stays known from `solution`.
std::optional<Solution> with_motions(const Solution& solution, Vector a, const Problem& problem, const Start& start,
                                     const SolverOptions& options);

}  // namespace scabo::contact
