// A start for Newton's method from problems with half as many pairs, a quarter, and so on (coarse_problem.hpp): solved
// loosely, the coarsest first, each the start of the next.
#pragma once

#include <optional>

#include "scabo/contact/search.hpp"

namespace scabo::contact {

struct CoarseStart {
  Point point;
  int iterations = 0;  ///< on all coarser problems
  std::vector<Iteration> trace;
};

/// Of plane problems of one body with a dense W and some fifty pairs; of more bodies pairs may be redundant, and their
/// forces would differ from pair to pair. `a`: rigid motions of the coarsest start.
std::optional<CoarseStart> coarse_start(const Problem& problem, const Vector& a);

}  // namespace scabo::contact
