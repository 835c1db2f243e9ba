// A start for Newton from the increment before: every pair keeps its state.
//
// As long as no pair changes its state, forces and rigid motions follow from the loads by one linear system, whatever
// loads have changed and by how much:
//
//     p_n + c_t = 0, p_t = 0             open (with cohesion the tangent as below)
//     u = 0                              stick
//     u_n = 0, p_t = e (c + mu p_n)      slip, e = +1 or -1 as the friction before
//     G' p + f = 0
//
// The states are those that the forces before tell: a force opens a pair, sticks or is as large as friction allows.
// Newton's method itself takes states from those forces together with the motions under the new loads. Where contact
// alone holds a body, that body has not moved with the loads yet, and nearly all pairs seem to slip or to open: 602
// unknowns under loads that grow in proportion take ten factorisations that way, and one this way. Bodies that supports
// hold move without it, and Newton mostly takes one or two iterations; this start follows if it takes more.
#pragma once

#include <optional>

#include "scabo/contact/b_differentiable.hpp"

namespace scabo::contact {

struct KeptStates {
  Vector p, a;  ///< dN, m
};

/// `p`, `a`: forces and rigid motions of the increment before; `at`: H there. In the plane. Nothing where p = 0 or
/// where these states do not hold the bodies.
std::optional<KeptStates> keep_states(const BDifferentiableEquations& equations, const Vector& p, const Vector& a,
                                      Residual at);

}  // namespace scabo::contact
