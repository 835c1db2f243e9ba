// `parameters` of a model file and their uses, `${b * 2}`.
#pragma once

#include <vector>

#include "scabo/base/warning.hpp"
#include "scabo/input/reader.hpp"
#include "scabo/input/yaml_document.hpp"

namespace scabo::input {

/// The tree with the formulas of all values replaced by numbers. A value that is `${...}`, or in which only numbers and
/// operators stand around it, becomes a number; in any other text, and in the title, `${...}` is replaced by the text
/// of its number. Mistakes are reported, and their values marked as unreadable. Parameters that nothing uses are told
/// in `warnings`; if they exist only on the command line, they are mistakes.
NodePtr apply_parameters(const NodePtr& root, Report& report, std::vector<Warning>& warnings);

}  // namespace scabo::input
