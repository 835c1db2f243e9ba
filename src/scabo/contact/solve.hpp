// Solves a discrete contact problem: attempts in order, each honest about its end.
#pragma once

#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct SolverOptions {
  double tolerance = 1e-10;   ///< every figure of the certificate, free of units
  int iterations = 50;        ///< of Newton in one attempt, > 0
  double r_factor = 1.0;      ///< r = r_factor / W_ii; the solution does not depend on it
  double force_scale = 0.0;   ///< largest applied force, >= 0: part of the scale by which forces are judged
};

/// Newton on the B-differentiable equations; where it stalls, other starts: the frictionless solution, growing
/// friction, Gauss-Seidel sweeps, Lemke's pivoting; for bodies that contact alone holds, the proximal-point iteration. The result is
/// solved and certified, or says what it is instead.
Solution solve(const Problem& problem, const Start& start = {}, const SolverOptions& options = {});

}  // namespace scabo::contact
