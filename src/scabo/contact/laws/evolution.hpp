// One increment with laws that depend on history: solve, determine which histories the solution changes, and solve
// again with the resulting strengths until nothing changes.
//
//     set limits by the trial histories -> solve -> ends of the pairs -> new histories
//
// Strengths that drop at once (a joint breaks, slip begins) drop for the most overloaded pairs first, so that failure
// propagates through a joint pair by pair and unloaded neighbours stay intact:
//
//     overload = ((g)+ / W_nn + |ds| / W_tt) / (c A + tau_t A + mu (p_n)+)
//
// with W under forces in balance (compliance.hpp), where the motions are those beyond the strength, which is kept
// meanwhile; pairs within 1e-6 of the largest overload fail together (to preserve symmetry). A drop is permanent within
// the increment. A strength that pairs have while they are closed comes back where they have closed, once nothing falls
// any more, and once within the increment. Coefficients that decrease gradually follow the slip of the solution by
// fixed-point iteration with Aitken's extrapolation. The number of rounds is limited by the number of strengths that
// can drop; beyond that the increment has not converged.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "scabo/contact/laws/law.hpp"
#include "scabo/contact/solve.hpp"

namespace scabo::contact {

struct JointLaws {
  std::vector<std::shared_ptr<const Law>> of_pair;  // N
  Vector area;                                      // N, length^2, > 0: tributary length times thickness
};

using History = std::vector<PairHistory>;  // N; a value, passed from increment to increment

/// Sets mu, cohesion and tension of the problem for these histories; vectors of strengths remain empty if all are zero.
void set_limits(const JointLaws& laws, const History& history, Problem& problem);

struct Evolution {
  Solution solution;  ///< of the last round; iterations and trace are those of all rounds
  Problem problem;    ///< of the last round
  History history;    ///< after the increment; unchanged if it was not solved
  int rounds = 0;
};

/// `problem` needs no mu, cohesion or tension.
Evolution evolve(Problem problem, const JointLaws& laws, const History& from, const Start& start,
                 const SolverOptions& options);

/// For a problem without a solution found: the rigid motion that nothing restrains once all joints that can break are
/// broken. Nothing if the loads can be carried without those strengths.
std::optional<Vector> mechanism_once_broken(Problem problem, const JointLaws& laws, History history);

}  // namespace scabo::contact
