// What is wrong with a cell whose Jacobian is not positive, found by looking at its nodes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scabo/base/types.hpp"
#include "scabo/files/imported_mesh.hpp"

namespace scabo::files {

/// The words after the name of the cell: what was found at its nodes `numbers`, at `points`, and what to do. `folded`:
/// of cell_shape.hpp.
std::string why_folded(CellKind kind, std::span<const Vec2> points, std::span<const std::int64_t> numbers, int folded);

}  // namespace scabo::files
