// The motion with which bodies begin to move where no forces balance the loads.
//
// What proves a mechanism (rigid_motions.hpp) is a motion with u_n >= mu |u_t| in every pair: that of an associated
// flow rule, by which joints open as they slide. Coulomb's joints do not. Rigid bodies at rest that nothing restrains
// begin to move by their acceleration, of which only the direction counts:
//
//     v = M^-1 (f + G'p),   u = G v,   min(u_n, p_n) = 0,   |p_t| <= mu p_n, opposite to u_t and at the bound where
//     u_t is not 0                                                                                                (1)
//
// This is a contact problem of its own, with W = G M^-1 G', q = G M^-1 f and no rigid motions; problems of this
// kind have a solution (Stewart, Trinkle, Int. J. Numer. Methods Engrg. 39 (1996) 2673). Where nothing balances the
// loads v is not 0, and f'v = v'M v - p'u > 0: the loads do work. Cohesion and tensile strength keep their place in the
// law. All pairs count, also those that are open, because a motion without end closes them. (With an associated rule in
// (1), and M = 1, v is the proof itself.)
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// Work that a motion is worth (work.hpp), the same on every machine; it takes one processor about 20 s. Walls of 700
/// and 2,100 pairs need 3e8 and 1.2e9 (0.15 and 0.7 s).
inline constexpr double most_operations_of_onset = 4e10;

/// v of (1), m numbers, of length 1; nothing without loads, where W of (1) would have more than 64 million
/// entries (4,000 pairs of few bodies, some 300,000 of a wall), or if it is not found by this work.
/// `inverse_mass`: M^-1, m x m, symmetric positive definite; its unit does not matter.
std::optional<Vector> onset_of_motion(const Problem& problem, const Eigen::SparseMatrix<double>& inverse_mass,
                                      double most_operations = most_operations_of_onset);

/// M^-1 for bodies whose masses are not known: every motion weighs as much as the pairs feel of it.
Eigen::SparseMatrix<double> unit_mass(const Problem& problem);

}  // namespace scabo::contact
