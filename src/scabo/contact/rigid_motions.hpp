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

/// Rigid motions (orthonormal columns, m x k) that no force of any pair resists, open or closed: of a body that slides
/// along sides that are straight or concurrent without friction, or with a coefficient up to 1e-12. None where bodies
/// are many.
Matrix neutral_motions(const Problem& problem);

/// The problem without the rigid motions `neutral`, which stay as they are: a = kept b + neutral neutral' a_0. `kept`
/// (m x (m - k)) completes them to an orthonormal basis. Whether the loads drive a neutral motion is for the caller to
/// ask: the equilibrium of these motions is no part of the problem that is left.
struct WithoutNeutral {
  Problem problem;
  Matrix kept;
};
WithoutNeutral without_neutral(const Problem& problem, const Matrix& neutral);

/// Rigid motions eliminated by a proximal term: G'p + f = c (a - a_0), so that a = a_0 + (G'p + f) / c. W is formed; m
/// = 0.
Problem held_at(const Problem& problem, const Vector& a_0, double c);

}  // namespace scabo::contact
