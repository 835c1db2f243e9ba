// The judgement of iterates, for all that goes along interior points.
#pragma once

#include <cmath>

#include "scabo/contact/interior/interior_points.hpp"
#include "scabo/contact/interior/interior_steps.hpp"

namespace scabo::contact {

/// Judges the iterate of now and returns its natural map; the least one and its forces are kept in `end`.
template <int d>
double judge_iterate(const InteriorSteps<d>& steps, const Problem& problem, const Measure& measure,
                     const IsSolution& accepts, const char* stage, InteriorPointEnd& end) {
  const Vector p = steps.forces(), a = steps.rigid_motions(), motion = motion_of(problem, p, a);
  const double residual = measure.natural_map(problem, p, motion);
  if (!std::isfinite(residual)) return residual;
  if (residual < end.residual) end.residual = residual, end.p = p, end.a = a;
  end.trace.push_back({end.iterations, residual, 0.5 * steps.gap(), steps.step(), 0, stage});
  if (accepts && accepts(p, a, motion)) {
    // What is open carries nothing, what slips carries all it can: where that is a solution too, it is the better one.
    const Vector snapped = steps.at_the_boundary();
    end.p = accepts(snapped, a, motion_of(problem, snapped, a)) ? snapped : p;
    end.a = a;
    end.accepted = true;
  }
  return residual;
}

}  // namespace scabo::contact
