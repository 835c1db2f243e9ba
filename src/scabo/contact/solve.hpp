// Solves a discrete contact problem: a ladder of attempts, each honest about its end
// (docs/methods/12_contact_solver.md).
//
// Newton on the B-differentiable equations is tried from several starts: the forces of the increment before, a few
// sweeps of Gauss-Seidel, the frictionless solution and growing friction, a sequence of problems held softly where they
// last were (proximal point, the hold vanishes), Lemke's pivoting, other r. Whatever the start, Newton on the problem
// itself has the last word. The result is solved and judged so, or says what it is instead.
#pragma once

#include "scabo/contact/solution.hpp"

namespace scabo::contact {

/// What "solved" means. certificate: every figure of the certificate is within the tolerance (increments of elastic
/// bodies). natural_map: natural_map_residual is (problems of others; W may be rank deficient, so sweeps come first),
/// and so is certificate.rigid_balance, which the natural map does not know.
enum class Judge { certificate, natural_map };

struct SolverOptions {
  double tolerance = 1e-10;  ///< of the judge, free of units
  Judge judge = Judge::certificate;
  int iterations = 50;       ///< of Newton in one attempt, > 0
  double r_factor = 1.0;     ///< r = r_factor / W_ii; the solution does not depend on it
  double force_scale = 0.0;  ///< largest applied force, >= 0: part of the scale by which forces are judged
};

Solution solve(const Problem& problem, const Start& start = {}, const SolverOptions& options = {});

}  // namespace scabo::contact
