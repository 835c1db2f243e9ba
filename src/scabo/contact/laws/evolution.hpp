// One increment of pairs whose laws depend on history: solve, determine which histories the solution changes, solve
// again with the resulting strengths, until nothing changes.
//
//     set limits by the trial histories -> solve -> ends of the pairs -> new histories
//
// Strengths that fall at once (a joint breaks, slip begins) fall for the most overloaded pairs first, so that
// failure runs through a joint pair by pair and neighbours that are relieved stay whole:
//
//     overload = ((g)+ / W_nn + |ds| / W_tt) / (c A + tau_t A + mu (p_n)+)
//
// where the motions are those beyond the strength, which is held meanwhile; pairs within 1e-6 of the largest
// overload go together (symmetry stays). What fell stays so within the increment. Coefficients that fall
// gradually follow the slip of the solution by fixed-point iteration with Aitken's extrapolation. Rounds are
// bounded by the number of strengths that can fall; beyond that the increment has not converged.
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

using History = std::vector<PairHistory>;  // N; a value, handed from increment to increment

/// mu, cohesion and tension of the problem for these histories; vectors of strengths stay empty where all are
/// zero.
void set_limits(const JointLaws& laws, const History& history, Problem& problem);

struct Evolution {
  Solution solution;  ///< of the last round; iterations and trace of all
  Problem problem;    ///< of the last round
  History history;    ///< after the increment; as before it where it was not solved
  int rounds = 0;
};

/// `problem` needs no mu, cohesion or tension.
Evolution evolve(Problem problem, const JointLaws& laws, const History& from, const Start& start,
                 const SolverOptions& options);

/// Of a problem for which no forces were found: the motion that nothing holds once every joint that can break is
/// broken. Nothing where the loads are held without those strengths.
std::optional<Vector> mechanism_once_broken(Problem problem, const JointLaws& laws, History history);

}  // namespace scabo::contact
