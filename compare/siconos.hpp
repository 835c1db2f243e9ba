// Solvers of Siconos (Acary, Bremond, Huber; libsiconos-numerics 4.4), called through its C interface: nonsmooth
// Gauss-Seidel in the plane and in space, Lemke's pivoting in the plane, the nonsmooth Newton methods of Alart and
// Curnier and of Fischer and Burmeister in space. Only with the CMake option SCABO_SICONOS; Siconos is a separate,
// Apache-licensed library and never required.
//
// Siconos has neither rigid motions besides W nor cohesion: it accepts only problems in W, q, mu. It uses its own
// residual; its results are certified like all others.
#pragma once

#include <string>

#include "compare/common.hpp"

namespace scabo::compare {

bool siconos_is_built();

/// `name`: siconos_nsgs, siconos_lemke, siconos_nsn_ac, siconos_nsn_fb.
End siconos(const std::string& name, const Problem& problem, const Vector& p, const Control& control);

}  // namespace scabo::compare
