// Solvers of Siconos (Acary, Bremond, Huber; libsiconos-numerics 4.4), called through its C interface:
// nonsmooth Gauss-Seidel in the plane and in space, Lemke's pivots in the plane, the nonsmooth Newton methods
// of Alart and Curnier and of Fischer and Burmeister in space. Only with the CMake option SCABO_SICONOS;
// Siconos is an Apache-licensed library of its own, never needed.
//
// Siconos has no rigid motions beside W and no cohesion: problems in W, q, mu only. It judges by its own
// residual; what it returns is certified as all else.
#pragma once

#include <string>

#include "scabo/contact/solvers/road.hpp"

namespace scabo::contact::solvers {

bool siconos_is_built();

/// `name`: siconos_nsgs, siconos_lemke, siconos_nsn_ac, siconos_nsn_fb.
End siconos(const std::string& name, const Problem& problem, const Vector& p, const Control& control);

}  // namespace scabo::contact::solvers
