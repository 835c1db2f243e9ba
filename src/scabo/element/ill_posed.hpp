// A super-element that has no solution, or none to working precision.
#pragma once

#include <stdexcept>
#include <string>

namespace scabo::element {

/// Says what is wrong and, where it is one boundary element, which (counted from 0). The mesh rules most of it out for
/// models that are read from files.
struct IllPosed : std::runtime_error {
  explicit IllPosed(const std::string& what) : std::runtime_error("ill-posed super-element: " + what) {}
};

}  // namespace scabo::element
