// GMRES with restarts and right preconditioning (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856), for
// matrices given only by their products.
#pragma once

#include <functional>

#include "scabo/base/types.hpp"

namespace scabo::contact {

struct GmresOptions {
  double tolerance = 1e-11;  ///< bound of the residual relative to b
  int restart = 80;          ///< number of vectors kept
  int iterations = 400;      ///< total number of products with A
};

/// x <- A^-1 b, starting from x. Returns |b - A x| / |b| at the end.
double gmres(const std::function<void(const Vector&, Vector&)>& multiply,
             const std::function<void(const Vector&, Vector&)>& precondition, const Vector& b, Vector& x,
             const GmresOptions& options);

}  // namespace scabo::contact
