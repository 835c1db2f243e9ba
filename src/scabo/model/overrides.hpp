// Replacement of values in the tree of a model file (`--set path=value`).
#pragma once

#include <vector>

#include "scabo/model/read_model.hpp"
#include "scabo/model/reader.hpp"
#include "scabo/model/yaml_document.hpp"

namespace scabo::model {

/// The tree with all overrides applied in their order. Mistakes are reported, and their overrides are left out.
NodePtr apply_overrides(NodePtr root, const std::vector<Override>& overrides, Report& report);

}  // namespace scabo::model
