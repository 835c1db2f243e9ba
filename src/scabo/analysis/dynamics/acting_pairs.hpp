// Which pairs act in a time step, and their contact problem.
#pragma once

#include "scabo/analysis/dynamics/time_step.hpp"

namespace scabo::analysis {

struct ActingPairs {
  std::vector<int> places;  ///< among all pairs, ascending
  contact::JointLaws laws;
};
/// `at_end`: the coefficients of friction.
ActingPairs acting_pairs(const InTime& in, const State& from, const Factors& at_end);

/// Whether a side of a pair has no mass. As its theta is another one, such a pair keeps a gap or an overlap below half
/// of the way that it closes in one step while it carries a force: the gap does not tell whether it is closed, and a
/// projection would give it energy.
bool has_massless_side(const InTime& in, Eigen::Index pair);

/// What numbers of a length may be without being a gap.
double rounding_of_gaps(const Prepared& prepared);

template <typename T>
std::vector<T> at_places(const std::vector<T>& all, const std::vector<int>& places) {
  std::vector<T> some;
  some.reserve(places.size());
  for (const int i : places) some.push_back(all[static_cast<std::size_t>(i)]);
  return some;
}
/// Both components of some pairs.
Vector entries_of(const Vector& of_pairs, const std::vector<int>& places);
/// W and G of some pairs, with q and f of zero, and without laws.
contact::Problem problem_of(const Prepared& prepared, const std::vector<int>& places);

/// The problem of acting pairs in a structure in time: motions are h V+, under the forces and prescribed values of `t`.
/// `begun`: per part, the solves by which the velocities of the bodies are found at a lower price.
contact::Problem pose(const ActingPairs& pairs, const Prepared& prepared, const State& t,
                      std::vector<system::BegunSolve>& begun);

/// Forces, histories and states of all pairs.
void give_to_all(const ActingPairs& pairs, const contact::Solution& solution, const contact::History& history,
                 const State& from, State& to);

/// Gaps of all pairs under the displacements of a state.
Vector gaps_at(const Prepared& prepared, const State& state);

}  // namespace scabo::analysis
