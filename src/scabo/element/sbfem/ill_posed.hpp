// Error for a super-element that has no solution, or none to working precision.
#pragma once

#include <stdexcept>
#include <string>

namespace scabo::element {

/// Says what is wrong and, if it is a single boundary element, its number (counted from 0). The mesh excludes most of
/// these cases for models read from files.
struct IllPosed : std::runtime_error {
  explicit IllPosed(const std::string& what) : std::runtime_error("ill-posed super-element: " + what) {}
};

}  // namespace scabo::element
