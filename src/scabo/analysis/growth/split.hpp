// Whether cracks divide a body.
#pragma once

#include "scabo/model/body.hpp"

namespace scabo::analysis {

/// Whether cracks, each from a point of the boundary or of another crack to another one, divide the body into pieces.
///
/// Closed boundaries and cracks are joined where a crack ends. As long as every such end joins what was not joined
/// before, whatever lies on one side of a crack can be reached from the other one around its tip or around what it
/// joins; the first end that joins what was joined already closes a line around a piece.
bool is_split(const model::Body& body);

}  // namespace scabo::analysis
