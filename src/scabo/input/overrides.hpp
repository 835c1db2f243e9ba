// Replacement of values in the tree of a model file (`--set path=value`).
#pragma once

#include <vector>

#include "scabo/input/read_model.hpp"
#include "scabo/input/reader.hpp"
#include "scabo/input/yaml_document.hpp"

namespace scabo::input {

/// The tree with all overrides applied in their order. Mistakes are reported, and their overrides are left out.
NodePtr apply_overrides(NodePtr root, const std::vector<Override>& overrides, Report& report);

}  // namespace scabo::input
