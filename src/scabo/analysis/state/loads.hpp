// What acts on the parts at given factors of loads and supports: applied forces and prescribed displacements.
#pragma once

#include <vector>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Loads, and what removed bodies still exert of the forces that they exerted.
std::vector<Vector> applied_forces(const Prepared& prepared, const Factors& factors,
                                   const std::vector<Vector>& released);

/// Forces of fluids that have entered contacts: [n, t] of every pair, on B; empty where none has.
Vector entered_forces(const Prepared& prepared, const Factors& factors);
/// Whether some fluid may enter a contact.
bool may_enter(const Prepared& prepared);

/// What acts of gravity on a body, an acceleration.
Vec2 gravity_on(const Prepared& prepared, const Factors& factors, int body);

/// What acts of the preload of a bar, a force.
double preload_of(const Prepared& prepared, const Factors& factors, std::size_t bar);

/// Takes out of the forces on part `p` resultants along its free rigid motions that are rounding, spread over all
/// forces. Contact balances the resultants without them (loads_on_motions); left in, they would be found unbalanced on
/// the few degrees of freedom that hold the part in displacement(): with a thousand pairs, 5e-11 of the largest force.
void take_out_rounding(const Matrix& rigid, double sum, Vector& forces);

/// Resultants of the loads on part `p` along its free rigid motions. Loads in equilibrium, as two equal opposite forces
/// or the forces of a temperature, leave rounding of their sum, which nothing could balance where neither supports nor
/// friction hold it: it is zero, whatever the unit of length makes of the last digits.
Vector loads_on_motions(const Prepared& prepared, std::size_t p, const State& state);

/// Prescribed displacements: per part, one for each constraint, without the translations `moved` of the parts.
std::vector<Vector> prescribed_values(const Prepared& prepared, const std::vector<double>& factors,
                                      const std::vector<Vec2>& moved);

}  // namespace scabo::analysis
