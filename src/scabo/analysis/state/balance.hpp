// Displacements, reactions and energy of a state whose contact forces are known, and what of the forces they leave
// unbalanced.
#pragma once

#include <limits>
#include <vector>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// What acts on the parts of a state, and what of it their displacements leave unbalanced (BodySystem::unbalanced): one
/// product with the stiffness for reactions, certificate and energy. Empty for an absent part.
struct Balance {
  Vector forces, unbalanced;
};

/// Displacements and reactions under the loads and contact forces of a state; `known`: the displacements without rigid
/// motions.
std::vector<Balance> add_displacements(const Prepared& prepared, const std::vector<Vector>* known, State& to,
                                       const std::vector<system::BegunSolve>& begun = {});

/// Of a part, what its stored energy is beyond 1/2 u'K u because its temperature has changed
/// (system/thermal_energy.hpp).
double thermal_energy(const Prepared& prepared, const Factors& factors, std::size_t p, const Vector& u);
/// Nodal forces of the temperatures of a part; empty where there are none.
Vector thermal_forces(const Prepared& prepared, const Factors& factors, std::size_t p);

/// Work done on the way between two accepted states, by the trapezoidal rule; displacements are relative to the
/// reference point. The nodal displacements are not: there the stiffness of an unbounded body is that of one held far
/// away, which resists a translation. A temperature does the work of the stress on the strain that it frees, taken from
/// or given to heat: free expansion takes none, and stores none.
Energy energy_between(const Prepared& prepared, const State& from, const State& to,
                      const std::vector<Balance>& balances);

/// Largest force at work in a state.
double largest_force(const State& state);

/// Of K u, against resistance().
constexpr double rounding_of_resistance = 1e3 * std::numeric_limits<double>::epsilon();

/// The forces by which K would resist displacements as large.
double resistance(const Prepared& prepared, const State& state);

/// What forces of a state are judged against: the largest at work so far. Without any load, and where nothing but the
/// rounding of K u is at work (supports that move a body without stress), the forces by which K would resist
/// displacements as large.
double scale_of(const Prepared& prepared, const State& state, double largest_at_work);

/// Completes the certificate with what only the whole structure can tell: equilibrium of every node and of every part.
void certify_structure(const Prepared& prepared, const State& state, std::vector<Balance> balances, double scale,
                       contact::Certificate& certificate);

}  // namespace scabo::analysis
