// The discrete problem of frictional contact in the plane: a value, apart from its solver.
//
// N pairs with relative motions and forces, for every pair [normal, tangential] (signs as in docs/notation.md:
// n out of A, towards B; forces act on B):
//
//     gap            g_i  = q_n + (W p)_n + (G a)_n      length, > 0 open
//     slip increment ds_i = q_t + (W p)_t + (G a)_t      length, since the last accepted increment
//     0 = G' p + f                                       equilibrium of the rigid motions that contact alone holds
//
//     min(r g, p_n) = 0                                                                 (H2; Zhu 2017, eq. 7)
//     p_t - lambda p_t(r) = 0, p_t(r) = p_t - r ds, lambda = min(mu (p_n)+ / |p_t(r)|, 1)   (H3; eq. 8)
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::contact {

struct Problem {
  Matrix W;   // 2N x 2N, Delassus operator: motion per force, symmetric positive semi-definite
  Vector q;   // 2N, motion without contact forces
  Vector mu;  // N, coefficient of friction, >= 0
  Matrix G;   // 2N x m, motion of the pairs per unit rigid motion; m may be 0
  Vector f;   // m, work of the applied loads per unit rigid motion

  int pairs() const { return static_cast<int>(mu.size()); }
};

enum class ContactState { open, stick, slip };

}  // namespace scabo::contact
