// Damped Newton method on the B-differentiable equations: direction (newton_direction.hpp), line search on the merit
// theta = 1/2 |H|^2, until H is small or a judge of its own is content. Where no step descends, a few full steps are
// tried (H is made of pieces, and a step may lead past a kink); the best point is kept.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scabo/contact/b_differentiable.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct NewtonOptions {
  double small = 0.0;           ///< converged when the largest |H| is not above it
  int iterations = 50;          ///< most
  double regularisation = 0.0;  ///< alpha, relative to 1 / r: at the start; it vanishes with |H|
  int unchecked = 8;            ///< full steps without descent, most
  std::string stage = "newton";
  /// Converged as well when this says so of forces and motions; may be empty.
  std::function<bool(const Vector& p, const Vector& motion)> content;
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
