// Whether a solution of a contact problem is unique, and whether a problem that was not solved has no solution
// (docs/methods/21_uniqueness.md).
//
// Uniqueness is proven if W is positive definite, bodies are held without contact (no G), and
//
//     lambda(M D (W^-1)_nn D M) lambda(M D^-1 W_tt D^-1 M) < 1,
//     M = diag(sqrt(mu_i)),  D = diag(sqrt((W_tt)_ii)),
//
// with lambda the largest eigenvalue, mu_i the larger coefficient where it differs by direction: for two solutions,
// dp'W dp = sum dp_i.du_i <= sum mu_i |dp_n,i| |du_t,i|. For up to
// `most_enumerated` plane pairs all combinations of states (open, stick, slip in either direction) are solved instead,
// which gives all solutions. In other cases, other solutions are searched by Newton from other starts; if none is
// found, nothing is proven.
//
// The sign of (-1)^m det H'(z) on the active branches is the index of a solution. For mu = 0 there is one solution,
// with index +1, and unless a ray interferes the sum over all solutions remains 1, so that a solution of index -1 is
// never the only one.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scabo/contact/solve.hpp"

namespace scabo::contact {

enum class Uniqueness { not_decided, proven, several };
/// `proven`, `several found`, `not decided`.
const char* name_of(Uniqueness uniqueness);

struct UniquenessReport {
  Uniqueness unique = Uniqueness::not_decided;
  double bound = HUGE_VAL;     ///< left side of the condition; below 1: proven; infinite if it does not apply
  int index = 0;               ///< sign of (-1)^m det H'(z); 0 on a kink or where it is not computed
  std::vector<Vector> others;  ///< forces of the other solutions found, each certified
  int nearest = -1;            ///< index in `others` of the one closer to the start than this solution, or -1
  bool complete = false;       ///< all states were tried, so that there are no more solutions
};

/// `solution` solves the problem; `start` is the previous accepted state.
UniquenessReport examine_uniqueness(const Problem& problem, const Start& start, const Solution& solution,
                                    const SolverOptions& options);

/// Left side of the condition; infinite if it does not apply.
double uniqueness_bound(const Problem& problem);

/// All solutions of a plane problem with few pairs and without rigid motions, by trying all combinations of states;
/// nothing if there are too many pairs, cohesion or tension, or states that leave the forces undetermined.
/// `force_scale` as in SolverOptions.
constexpr int most_enumerated = 5;
std::optional<std::vector<Vector>> all_solutions(const Problem& problem, double tolerance, double force_scale = 0.0);

/// The reason why a problem that did not converge has no solution, if that can be shown; otherwise empty.
std::string why_no_solution(const Problem& problem, const SolverOptions& options);

/// Sign of (-1)^m det H'(z) at (p, a) on its branches; 0 on a kink, where it is singular or too large.
int index_of(const Problem& problem, const Vector& p, const Vector& a);

}  // namespace scabo::contact
