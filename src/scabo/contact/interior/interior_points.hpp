// Interior points: all forces at once, from the inside of what the laws allow (interior_steps.hpp). Stacks of bodies,
// rigid or elastic, need that: sweeps carry forces from body to body, Newton's method needs nearly all states right,
// and this asks for neither.
#pragma once

#include <cmath>
#include <vector>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/problem.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct InteriorPointEnd {
  Vector p, a;  ///< that the judge accepts; otherwise of the least residual; empty: no point is finite
  bool accepted = false;
  int iterations = 0;
  double residual = HUGE_VAL;    ///< least natural map met, of forces in the units of W p, over |q|
  std::vector<Iteration> trace;  ///< its residual, its step length; merit is m / 2
};

/// W sparse, or dense with few enough rows to be factorised in each step; some load.
bool may_take_interior_points(const Problem& problem);

/// From all pairs with the same normal force, `start` times what the loads suggest, until `accepts`, which may be
/// empty, accepts forces and motions, the natural map is at most `aim`, or steps no longer lead on.
InteriorPointEnd interior_points(const Problem& problem, const IsSolution& accepts, const Deadline& deadline = {},
                                 double start = 1.0, double aim = 0.0);

}  // namespace scabo::contact
