// Results as the extension module keeps them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "scabo/analysis/modal_analysis.hpp"
#include "scabo/analysis/static_analysis.hpp"

namespace scabo::python {

/// What both kinds of analysis return.
struct [[gnu::visibility("hidden")]] RunRecord {
  std::string summary;                   ///< content of summary.json
  std::optional<std::string> directory;  ///< where the results are written
  std::vector<std::string> warnings;     ///< one sentence each
  py::object error = py::none();  ///< an exception of the callback, or KeyboardInterrupt
  std::string why_not_solved;     ///< empty if solved
};

struct [[gnu::visibility("hidden")]] StaticResult {
  analysis::StaticSolution solution;
  RunRecord record;
};

struct [[gnu::visibility("hidden")]] ModalRunResult {
  analysis::ModalResult result;
  RunRecord record;
};

}  // namespace scabo::python
