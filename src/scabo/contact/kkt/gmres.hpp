// GMRES with restarts and right preconditioning (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856), for
// matrices given only by their products.
#pragma once

#include <functional>

#include "scabo/contact/constants.hpp"

namespace scabo::contact {

/// x <- A^-1 b, starting from x. Returns |b - A x| / |b| at the end.
double gmres(const std::function<void(const Vector&, Vector&)>& multiply,
             const std::function<void(const Vector&, Vector&)>& precondition, const Vector& b, Vector& x,
             const GmresOptions& options);

}  // namespace scabo::contact
