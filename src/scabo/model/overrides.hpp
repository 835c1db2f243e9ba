// `--set path=value`: a tree with some values replaced.
#pragma once

#include <vector>

#include "scabo/model/read_model.hpp"
#include "scabo/model/reader.hpp"
#include "scabo/model/yaml_document.hpp"

namespace scabo::model {

/// The tree with every override put in, in their order. Mistakes are reported; their overrides are left out.
NodePtr apply_overrides(NodePtr root, const std::vector<Override>& overrides, Report& report);

}  // namespace scabo::model
