// What equations between displacements of a deck of solids mean in a model: supports, where all but one displacement
// are known, and ties of faces.
#pragma once

#include "scabo/convert/solid_model_writer.hpp"

namespace scabo::convert {

/// Adds supports to the content of the deck, and ties to the model. All other equations become essential remarks.
void write_equations(SolidModelWriter& writer);

}  // namespace scabo::convert
