// Newton's method at the end of interior points: nearly all states of a plane problem of many bodies are right.
// Directions are soft_direction.hpp's, the line search is on the merit alone, and it ends where steps become short:
// then it is too early.
#pragma once

#include "scabo/contact/newton.hpp"

namespace scabo::contact {

/// Whether the equations have what a SoftDirection needs.
bool may_soften(const Problem& problem);

/// Of the options `small`, `relative`, `iterations`, `patience`, `fall`, `first_step`, `stage`, `deadline`,
/// `on_iteration` and `content`. One iteration for each factorisation: steps with the factor of an earlier one have its
/// number in the trace.
NewtonEnd soft_newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options);

}  // namespace scabo::contact
