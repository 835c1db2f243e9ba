// Names of the outcomes of the contact solver, as users see them.
#pragma once

#include <string_view>

#include "scabo/base/error.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact {

/// `solved`, `not_converged`, `mechanism`, `collapse`, `infeasible`.
inline std::string_view name_of(Status status) {
  switch (status) {
    case Status::solved:
      return "solved";
    case Status::not_converged:
      return "not_converged";
    case Status::mechanism:
      return "mechanism";
    case Status::collapse:
      return "collapse";
    case Status::infeasible:
      return "infeasible";
  }
  throw BrokenInvariant("a status without a name");
}

}  // namespace scabo::contact
