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
//
// And one for pairs whose states a point does not tell, in which they all stick.
// Interior points know forces and motions to within |H|, which is more than pairs have at the tip of a crack: 1e-9 of
// the largest force, where sides are divided towards it. Their branches there are those of errors, of which Newton's
// method mends one ring of pairs after the other (13 to 28 iterations). Where they all stick, one step finds the field
// around the tip, which tells their states: 1 to 3 iterations follow. Where the faces slip at the tip the step leads
// away, and Newton's method is to begin at the point itself.
#pragma once

#include <optional>

#include "scabo/contact/newton/b_differentiable.hpp"

namespace scabo::contact {

/// `from`: forces and rigid motions of the increment before. Nothing where p = 0, nearly all pairs seem to keep their
/// states anyway, these states do not hold the bodies, or |H| is not smaller there.
std::optional<Point> with_states_kept(const BDifferentiableEquations& equations, const Point& from);

/// The point after that step; nothing where less than a tenth of the pairs are undecided, or there is no step.
std::optional<Point> with_undecided_stuck(const BDifferentiableEquations& equations, const Point& from);

}  // namespace scabo::contact
