// Contact forces that are not unique although all displacements are.
//
// Forces dp that change no force on any body, M_b' dp = 0 for every body b (M_b: motion of the pairs per displacement
// of the body; forces that supports take do not count), move nothing. Such dp may be added to a solution as far as the
// laws of the pairs allow: three bodies that stick to each other in a point can carry a force around it, and a rigid
// block on points that supports hold may stand on more of them than it needs. With the pairs in their states, and those
// left out that have hardly any force to change,
//
//     dp = C y:   stick p_n and p_t are free; slip p_t = -+ mu p_n;      A y = 0,   A = [M_b' C] for all b
//
// y is computed as the part of a random vector in the null space of A, y - A'(A A' + e)^-1 A y, repeated: with
// probability one an entry is zero exactly if the force is unique. One sparse Cholesky factorisation, whatever the
// number of redundant pairs.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Replaces forces that are not unique by the smoothest ones that the solution admits
/// (contact/questions/smoothest_forces.hpp), judged anew. Does nothing to a problem that is not solved, or would not be
/// with them.
void give_smoothest_forces(const Prepared& prepared, const contact::Problem& problem, const contact::Start& start,
                           const contact::SolverOptions& options, contact::Solution& solution);

/// 2N, [n, t] of every pair: forces of size 1 that may be added in part to those of the state, and zero where the force
/// of a pair is unique. `problem`: that of the state, with its coefficients. Empty where all forces are unique.
Vector undetermined_forces(const Prepared& prepared, const State& state, const contact::Problem& problem);

/// The warning of it; nothing where all forces are unique. Says how many pairs are concerned, and of which contacts the
/// total force is not unique either.
std::optional<Warning> undetermined_forces_warning(const Prepared& prepared, const State& state,
                                                   const contact::Problem& problem);

}  // namespace scabo::analysis
