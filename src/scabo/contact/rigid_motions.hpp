// Rigid motions of a problem: mechanisms and motions that no pair feels before the solve, undetermined motions after it.
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

/// Motions that no pair feels, open or closed: G v = 0 in all rows that can carry a force (normals; tangents with
/// friction or strength). Two blocks pressed together may move sideways together, and a body that slides without friction
/// along its sides moves alone. Newton's equations are singular along them, or determined by the last digits of the
/// normals, which then decide about the forces: these motions are taken out first and stay as they were.
struct WithoutNeutral {
  Problem problem;              ///< without the columns `held` of G and f: these motions are 0 there
  Matrix neutral;               ///< m x k, orthonormal
  std::vector<int> held, kept;  ///< k and m - k motions, ascending

  /// The start with its neutral part changed so that the motions `held` are 0.
  Start start(const Start& given) const;
  /// Motions of the given problem whose neutral part is that of `a_start` (m), from those that are left.
  Vector motions(const Vector& a_left, const Vector& a_start) const;
};

/// Nothing where there are no such motions, the loads drive one (`force_scale`: largest applied force), or W is known
/// by its products alone.
std::optional<WithoutNeutral> without_neutral(const Problem& problem, double force_scale);

/// Rigid motions eliminated by a proximal term: G'p + f = c (a - a_0), so that a = a_0 + (G'p + f) / c. W is formed; m
/// = 0.
Problem held_at(const Problem& problem, const Vector& a_0, double c);

}  // namespace scabo::contact
