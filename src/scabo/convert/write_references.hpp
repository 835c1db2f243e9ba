// Bolts, rigid plates and spread forces of a model, from the reference nodes of a deck of solids.
#pragma once

#include "scabo/convert/solid_model_writer.hpp"

namespace scabo::convert {

/// A section of a bolt becomes a `preload`; a face or body that moves as one piece a rigid body, a face with a tie; a
/// force that is spread over a face a `force` and a `moment`. Others become remarks.
void write_references(SolidModelWriter& writer);

}  // namespace scabo::convert
