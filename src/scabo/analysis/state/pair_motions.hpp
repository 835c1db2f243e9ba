// Relative motions of the pairs, along [n, t], by the displacements of the parts.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Under displacements (or velocities) of all parts, with `motion` of each; `rows`: 2 for each pair.
Vector motion_under(const std::vector<Eigen::SparseMatrix<double>>& motion, const std::vector<Vector>& u,
                    Eigen::Index rows);

/// Without contact forces.
struct FreeMotion {
  Vector pairs, held;  ///< 2N; of pairs that supports hold
};
/// Under the forces and prescribed values of a state.
FreeMotion free_motion(const Prepared& prepared, const State& state, std::vector<system::BegunSolve>* begun = nullptr);

/// Supports on both sides may hold a pair; they must not press its points into each other, or InputError is thrown.
/// `motion`: of these pairs, without the offsets of `state`.
void check_held_pairs(const Prepared& prepared, Vector motion, const State& state);

}  // namespace scabo::analysis
