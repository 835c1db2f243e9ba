// Rigid motions of bodies that neither supports nor friction nor loads determine
// (docs/methods/06_newton.md#undetermined-motions): which of them is given, and the warning that names them.
//
// The forces of a solution allow any motions v = U y of such bodies as long as the gaps g of open pairs stay open and
// what slips under friction slips against it:
//
//     g + G_n U y >= 0,    -sign(p_t) (s + G_t U y) >= 0                                                          (1)
//
// Given is the one for which the bodies move least in the increment,
//
//     min sum_b integral over the area of b of |w_b + r_b(y)|^2 dA                                                (2)
//
// w_b: the rigid motion nearest to what the nodes of part b have moved since the increment began, r_b(y): its rigid
// motion by y. (2) is a sum of squares of displacements: it has no unit, and depends neither on the axes nor on the
// order of the bodies or on how amplitudes are measured.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// So many undetermined motions, at most, are chosen by (2): dense matrices.
constexpr Eigen::Index most_undetermined = 300;

/// Gives those motions of `solution`, and of its state `to`, for which the bodies move least since `from`; but for the
/// displacements of `to`. What laws remember of slip stays. Whether there was anything to choose.
bool give_smallest_motions(const Prepared& prepared, const contact::Problem& problem, const contact::JointLaws& laws,
                           const contact::Start& start, const contact::SolverOptions& options, const State& from,
                           State& to, contact::Solution& solution);

/// The warning of motions `undetermined` (m x k), in one sentence: which bodies may move, and how. Its subject are
/// these bodies. Nothing if there are none, or if warnings of all of them were given before.
std::optional<Warning> undetermined_motion_warning(const Prepared& prepared, const Matrix& undetermined,
                                                   const std::vector<Warning>& given);

}  // namespace scabo::analysis
