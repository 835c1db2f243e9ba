// Damped Newton method on the B-differentiable equations: direction (newton_direction.hpp), line search on the merit
// theta = 1/2 |H|^2, until H is small or the given judge accepts the point. Where no step descends, a few full steps
// are tried (H is piecewise smooth, and a step may lead past a kink); the best point is kept.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scabo/contact/b_differentiable.hpp"
#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct NewtonOptions {
  double small = 0.0;           ///< converged when the largest |H| is not above it,
  double relative = 0.0;        ///< or not above this part of the largest force
  int iterations = 50;          ///< most
  double regularisation = 0.0;  ///< alpha, relative to 1 / r: at the start; it vanishes with |H|
  int unchecked = 8;            ///< full steps without descent, most
  int watched = 6;              ///< the same of many bodies, after which the search is used; 0: none, and it ends there
  int patience = 0;             ///< ends when the smallest merit did not fall by `fall` in so many iterations; 0: never
  double fall = 0.5;
  double first_fall = 1.0;  ///< ends where the first iteration leaves more than this part of the merit
  double first_step = 0.0;  ///< of soft_newton: ends where the first step is shorter
  double undecided = 0.0;   ///< pairs with less than this part of |H| stick in the first step (not of soft_newton)
  std::string stage = "newton";
  Deadline deadline = {};                                   ///< no iteration begins after it
  std::function<void(const Iteration&)> on_iteration = {};  ///< may be empty; what it throws ends the solve
  /// Converged as well when this says so of forces and motions; may be empty.
  IsSolution content = {};
  bool ask_when_stuck = false;  ///< `content` is asked only where |H| is small and no longer falls
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
