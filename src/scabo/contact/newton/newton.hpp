// Newton's method on the B-differentiable equations: direction (kkt/newton_direction.hpp), line search on the merit
// theta = 1/2 |H|^2, until H is small or the given judge accepts the point.
//
// The search is that of Grippo, Lampariello and Lucidi. Where the matrix of a branch is singular, or no step passes the
// search, the system is regularised from then on (docs/methods/12_contact_solver.md, stage 1).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/newton/b_differentiable.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct NewtonOptions {
  double small = 0.0;     ///< converged when the largest |H| is not above it,
  double relative = 0.0;  ///< or not above this part of the largest force,
  double rounding = 0.0;  ///< or where it falls no longer, and not above what may be rounding
  int iterations = 50;    ///< most
  int patience = 0;       ///< ends when the smallest merit was not halved in so many iterations; 0: never
  std::string stage = "newton";
  Deadline deadline = {};                                   ///< no iteration begins after it
  std::function<void(const Iteration&)> on_iteration = {};  ///< may be empty; what it throws ends the solve
  /// Converged when this says so of forces and motions, or, where it does not, when |H| is small enough and falls no
  /// longer. May be empty.
  IsSolution accepts = {};
  bool ask_when_stuck = false;  ///< `accepts` is asked only where |H| is small enough, or near it and no longer falls
};

struct NewtonEnd {
  Vector p, a;  ///< the best point
  bool converged = false;
  bool singular = false;  ///< a direction did not exist: forces cannot balance on the branch
  int iterations = 0;
  double residual = 0.0;  ///< largest |H|
  std::vector<Iteration> trace;
};

NewtonEnd newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options);

}  // namespace scabo::contact
