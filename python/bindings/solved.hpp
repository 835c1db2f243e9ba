// Results as the extension module keeps them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "scabo/analysis/modal/modal_analysis.hpp"
#include "scabo/analysis/space/posed_solids.hpp"
#include "scabo/analysis/static_analysis.hpp"

namespace scabo::python {

/// What every kind of analysis returns besides its arrays.
struct [[gnu::visibility("hidden")]] RunRecord {
  std::string summary;                   ///< content of summary.json
  std::optional<std::string> directory;  ///< where the results are written
  std::vector<std::string> warnings;     ///< one sentence each
  py::object error = py::none();         ///< an exception of the callback, or KeyboardInterrupt
  std::string why_not_solved;            ///< empty if solved
};

/// Results of a static analysis. Increments are numbered from 0 in the order of the run, bodies and contacts in the
/// order of the model. Arrays show the memory of the solution without a copy unless their docstring says so, and cannot
/// be written.
struct [[gnu::visibility("hidden")]] StaticResult {
  analysis::StaticSolution solution;
  RunRecord record;  ///< summary, directory, warnings, and why the run ended
};

/// Results of a static analysis in space, numbered alike. Nodes and displacements show the memory of the solution;
/// other arrays are new ones.
struct [[gnu::visibility("hidden")]] SpaceResult {
  std::shared_ptr<const model::SpaceModel> model;
  std::shared_ptr<const analysis::PosedSolids> posed;  ///< of `model`
  std::vector<analysis::SolidIncrement> increments;    ///< those that are solved, and at most one that is not
  std::string status;                                  ///< solved, not_converged, mechanism, collapse or interrupted
  RunRecord record;                                    ///< summary, directory, warnings, and why the run ended
};

/// Results of a modal analysis: modes in ascending frequency.
struct [[gnu::visibility("hidden")]] ModalRunResult {
  analysis::ModalResult result;
  RunRecord record;  ///< summary, directory and warnings
};

}  // namespace scabo::python
