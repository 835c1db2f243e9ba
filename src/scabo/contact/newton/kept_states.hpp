// A start for Newton's method from the increment before: where the loads lead as long as no pair changes its state.
//
//     p_n + c_t = 0, p_t = 0             open (with cohesion the tangent as below)
//     u = 0                              stick
//     u_n = 0, p_t = e (c + mu p_n)      slip, e the direction of friction before
//     G' p + f = 0
//
// The states are those that the forces before tell: a force opens a pair, sticks or is as large as friction allows.
// Newton's method itself takes states from those forces together with the motions under the new loads. Where contact
// alone holds a body, that body has not moved with the loads yet, and nearly all pairs seem to slip or to open: 602
// unknowns under loads that grow in proportion take ten factorisations that way, and one this way.
#pragma once

#include <optional>

#include "scabo/contact/newton/b_differentiable.hpp"

namespace scabo::contact {

/// `from`: forces and rigid motions of the increment before. Nothing where p = 0, nearly all pairs seem to keep their
/// states anyway, these states do not hold the bodies, or |H| is not smaller there.
std::optional<Point> with_states_kept(const BDifferentiableEquations& equations, const Point& from);

}  // namespace scabo::contact
