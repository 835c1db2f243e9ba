// GMRES with restarts and a preconditioner on the right (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856),
// for matrices that are known by their products alone.
#pragma once

#include <functional>

#include "scabo/base/types.hpp"

namespace scabo::contact {

struct GmresOptions {
  double tolerance = 1e-11;  ///< of the residual, relative to b
  int restart = 80;          ///< vectors kept
  int iterations = 400;      ///< products with A, in all
};

/// x <- A^-1 b from the start x. Returns |b - A x| / |b| at the end.
double gmres(const std::function<void(const Vector&, Vector&)>& multiply,
             const std::function<void(const Vector&, Vector&)>& precondition, const Vector& b, Vector& x,
             const GmresOptions& options);

}  // namespace scabo::contact
