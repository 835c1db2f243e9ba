// Rigid motions of a problem: mechanisms before the solve, undetermined motions after it.
#pragma once

#include <optional>
#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// So many rigid motions that questions about them take sparse factorisations, and are asked only where needed.
bool has_many_motions(const Problem& problem);

/// A rigid motion v (m) that nothing holds although the loads drive it, f'v > 0: no forces in the friction cones
/// balance f. With cohesion or tension: no forces in the convex hull of what the pairs carry. Nothing where the loads
/// can be balanced.
std::optional<Vector> find_mechanism(const Problem& problem);

/// Rigid motions (columns, m x k) that change no gap in contact and no tangent that sticks: the forces are known, the
/// position along these is not.
Matrix undetermined_motions(const Problem& problem, const std::vector<ContactState>& states);

/// Of these, in space, those that keep the direction of every slip under forces p: Coulomb's law ties it to that of the
/// friction.
Matrix undetermined_motions(const Problem& problem, const std::vector<ContactState>& states, const Vector& p);

}  // namespace scabo::contact
