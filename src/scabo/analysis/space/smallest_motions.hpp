// Which of the motions is given that neither supports nor friction nor loads determine, as
// analysis/diagnostics/undetermined_motions.hpp in the plane.
//
// The forces of a solution allow any motions U y of such bodies as long as open pairs stay open and what slips under
// friction slips against it, along the same line. Given is the one for which the bodies move least in the increment,
//
//     min sum_b integral over the volume of b of |du_b + R_b U y|^2 dV
//
// du_b: what the nodes of body b have moved since the increment began, R_b: its motions without deformation. The
// integrals are sums over nodes, as in solid_mechanism.hpp. It depends on no axis, no unit and no order of nodes or
// bodies.
#pragma once

#include "scabo/analysis/space/solid_mechanism.hpp"

namespace scabo::analysis {

/// Amplitudes in place of those of `solution`; `moved`: du of every body with those of the solution. Nothing if there
/// is no choice, or too much of it.
std::optional<Vector> smallest_motions(const MovingSolids& solids, const contact::Problem& problem,
                                       const contact::Solution& solution, const std::vector<Vector>& moved);

}  // namespace scabo::analysis
