// The discrete problem of frictional contact, as a value that is independent of its solver.
//
// N pairs with relative motions u and forces p on B, for every pair [normal, tangent] in the plane (d = 2), [normal,
// tangent 1, tangent 2] in space (d = 3); signs as in docs/notation.md (n out of A, towards B; forces act on B), which
// are those of FCLIB, the public collection of such problems:
//
//     u = q + W p + G a          length (or velocity): gap u_n, > 0 open; slip u_t since the last accepted increment
//     0 = G' p + f               equilibrium of the rigid motions that contact alone holds
//
//     min(r u_n, p_n + c_t) = 0                                                               (H2; Zhu 2017, eq. 7)
//     p_t - lambda p_t(r) = 0, p_t(r) = p_t - r u_t, lambda = min(b / |p_t(r)|, 1),
//     b = c + mu (p_n)+                                                                       (H3; eq. 8)
//
// c: cohesion, c_t: tensile strength of a pair, both as forces and both 0 for Coulomb's law. Friction opposes slip.
//
// In the plane mu may differ by the direction of slip: mu_f forward, u_t > 0, which friction p_t < 0 opposes, and mu_b
// backward. The admissible p_t are then an interval around 0, and p_t(r) is still projected along its own sign:
//
//     -(c + mu_f (p_n)+) <= p_t <= c + mu_b (p_n)+,   mu = mu_b where p_t(r) > 0, mu_f where p_t(r) < 0
#pragma once

#include <vector>

#include "scabo/base/types.hpp"
#include "scabo/contact/delassus.hpp"
#include "scabo/contact/rigid_map.hpp"

namespace scabo::contact {

struct Problem {
  int dimension = 2;   // d, 2 or 3
  Delassus W;          // dN x dN, motion per force
  Vector q;            // dN, motion without contact forces
  Vector mu;           // N, coefficient of friction, >= 0; mu_f where it differs by direction
  Vector mu_backward;  // N, mu_b, >= 0; empty: that of `mu`, as always with d = 3
  Vector cohesion;     // N, >= 0, or empty: 0
  Vector tension;      // N, >= 0, or empty: 0; infinity: bonded
  RigidMap G;          // dN x m, motion of the pairs per unit rigid motion; m may be 0
  Vector f;            // m, work of the applied loads per unit rigid motion

  int pairs() const { return static_cast<int>(mu.size()); }
  double cohesion_of(Eigen::Index pair) const { return cohesion.size() > 0 ? cohesion[pair] : 0.0; }
  double tension_of(Eigen::Index pair) const { return tension.size() > 0 ? tension[pair] : 0.0; }
  /// The coefficient that bounds a tangential force of this sign: backward slip makes p_t > 0, forward slip p_t < 0.
  double mu_against(Eigen::Index pair, double p_t) const {
    return p_t > 0.0 && mu_backward.size() > 0 ? mu_backward[pair] : mu[pair];
  }
  /// The larger one.
  double largest_mu(Eigen::Index pair) const {
    return mu_backward.size() > 0 && mu_backward[pair] > mu[pair] ? mu_backward[pair] : mu[pair];
  }
  /// The largest tangential force of the sign of p_t under the normal force p_n.
  double friction_bound(Eigen::Index pair, double p_n, double p_t) const {
    return cohesion_of(pair) + mu_against(pair, p_t) * (p_n > 0.0 ? p_n : 0.0);
  }
};

/// The start of an increment, part of a saved problem: forces and rigid motions of the previous increment (empty:
/// zero). Previous slip is included in q.
struct Start {
  Vector p, a;
  std::vector<bool> touching = {};  ///< N, pairs in contact before the increment; empty: unknown
};

/// Forces and rigid motions: where a solver is.
struct Point {
  Vector p, a;  // dN, m
};

enum class ContactState { open, stick, slip };

}  // namespace scabo::contact
