// Natural modes of one body, K phi = omega^2 M phi on the degrees of freedom without supports.
//
// The rigid motions N left free by supports are known exactly (body_system.hpp) and satisfy K N = 0. They are therefore
// removed and not searched for: the other modes are M-orthogonal to them. With Q = an orthonormal basis of the space
// orthogonal to M N (Householder),
//
//     Q'K Q y = omega^2 Q'M Q y,   phi = Q y         K dense: LAPACK, as M y = 1/omega^2 K y                  (1)
//
// and for sparse K, by the Lanczos method in the inner product of M, applied to
//
//     P A P' M phi = 1/omega^2 phi,   P = 1 - N (N'M N)^-1 N'M                                                (2)
//
// A: displacement under forces in equilibrium, with as many degrees of freedom held as there are rigid motions. Both
// methods compute the largest 1/omega^2, so that the lowest frequencies are the most accurate. The Lanczos method may
// miss one of two equal frequencies; the number found is therefore checked by Sylvester's law of inertia.
#pragma once

#include "scabo/system/internal_levels.hpp"

namespace scabo::system {

struct NaturalModes {
  Vector eigenvalues;  // omega^2, ascending; 0 exactly for the rigid motions, which come first
  Matrix shapes;       // size x count, phi'M phi = 1; 0 on supports; below, the unknowns of the internal levels
  int rigid = 0;       // number of rigid motions among them
  Vector residuals;    // |K phi - omega^2 M phi| / ((|K| + omega^2 |M|) |phi|), largest norms
};

/// The lowest `count` modes, or fewer if there are not as many degrees of freedom. `M`: mass, stored like the
/// stiffness, positive definite. Internal levels are further unknowns (internal_levels.hpp). The rigid motions of a
/// free body are both translations and the rotation about its centre of mass. Throws BrokenInvariant if modes were
/// missed.
NaturalModes natural_modes(const Stiffness& K, const Stiffness& M, const std::vector<Vec2>& nodes,
                           const std::vector<Constraint>& constraints, int count,
                           const std::vector<BodyLevel>& levels = {});

}  // namespace scabo::system
