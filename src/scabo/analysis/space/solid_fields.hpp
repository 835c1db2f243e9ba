// Every field of a state in space that is kept, declared once, as those of the plane (analysis/state/fields.hpp).
#pragma once

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/analysis/state/fields.hpp"

namespace scabo::analysis {

using SolidField = FieldOf<SolidState>;

std::span<const SolidField> fields_of_solid_state();

}  // namespace scabo::analysis
