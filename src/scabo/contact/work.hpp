// Estimates of work in operations, a multiplication and an addition each: for limits that are the same on every machine
// (deadline.hpp). They follow from sizes alone.
#pragma once

#include <algorithm>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// One product with W, or one sweep over its pairs.
inline double operations_of_sweep(const Problem& problem) {
  const auto rows = static_cast<double>(problem.W.size());
  return problem.W.is_sparse() ? static_cast<double>(problem.W.sparse().nonZeros()) : rows * rows;
}

/// One system of Newton's method or of interior points. That of rigid bodies takes as long as about fifty sweeps
/// (measured on walls of 700 to 3,800 pairs: 40 to 60); a dense LU has n^3/3 operations, of which vector units do about
/// eight at a time.
inline double operations_of_system(const Problem& problem) {
  constexpr double sweeps = 50.0, at_a_time = 8.0;
  const auto rows = static_cast<double>(problem.W.size() + problem.G.cols());
  const double sparse = sweeps * operations_of_sweep(problem);
  return problem.W.is_sparse() ? sparse : rows * rows * std::max(rows / (3.0 * at_a_time), 1.0);
}

}  // namespace scabo::contact
