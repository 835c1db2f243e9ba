// Whether a solution of a contact problem is the only one, and whether a problem without a solution has none
// (docs/methods/21_uniqueness.md).
//
// Uniqueness is proven when W is positive definite, bodies are held without contact (no G), and
//
//     lambda(M D (W^-1)_nn D M) lambda(M D^-1 W_tt D^-1 M) < 1,
//     M = diag(sqrt(mu_i)),  D = diag(sqrt((W_tt)_ii)),
//
// lambda the largest eigenvalue: for two solutions, dp'W dp = sum dp_i.du_i <= sum mu_i |dp_n,i| |du_t,i|. Up
// to `most_enumerated` plane pairs all combinations of states (open, stick, slip either way) are solved
// instead: the whole set of solutions. Beyond both, other solutions are looked for by Newton from other
// starts; finding none proves nothing.
//
// The sign of (-1)^m det H'(z) on the active branches is the index of a solution: mu = 0 has one solution of index
// +1, and where no ray interferes the sum over all solutions stays 1, so that a solution of index -1 is never
// alone.
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
  double bound = HUGE_VAL;     ///< left side of the condition; below 1: proven. Infinite where it does not apply
  int index = 0;               ///< sign of (-1)^m det H'(z); 0 on a kink or where it is not computed
  std::vector<Vector> others;  ///< forces of the other solutions found, each certified
  int nearest = -1;            ///< of `others`: nearer to the start than the solution at hand; -1: none is
  bool complete = false;       ///< all states were tried: there are no more
};

/// `solution` solves the problem; `start` is the accepted state before it.
UniquenessReport examine_uniqueness(const Problem& problem, const Start& start, const Solution& solution,
                                    const SolverOptions& options);

/// Left side of the condition; infinite where it does not apply.
double uniqueness_bound(const Problem& problem);

/// All solutions of a plane problem of few pairs without rigid motions, by trying every combination of
/// states; nothing where there are too many pairs, cohesion or tension, or states that leave the forces
/// undetermined. `force_scale` as in SolverOptions.
constexpr int most_enumerated = 5;
std::optional<std::vector<Vector>> all_solutions(const Problem& problem, double tolerance, double force_scale = 0.0);

/// Why a problem that did not converge has no solution, where that can be shown; empty otherwise.
std::string why_no_solution(const Problem& problem, const SolverOptions& options);

/// Sign of (-1)^m det H'(z) at (p, a) on its branches; 0 on a kink, where it is singular or too large.
int index_of(const Problem& problem, const Vector& p, const Vector& a);

}  // namespace scabo::contact
