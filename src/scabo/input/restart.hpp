// `restart`, of models in the plane and in space: a directory with the results of another run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/input/reader.hpp"
#include "scabo/model/model.hpp"

namespace scabo::input {

/// What the reader needs of the end of another run.
struct EndOfRun {
  std::string name;                ///< of its directory, as the model file spells it
  model::Restart restart;          ///< its directory; without factors
  NodePtr factors;                 ///< by sections and names
  std::vector<std::string> files;  ///< that the model depends on

  /// Numbers of a section by names in their order; 0 for a name that the other run does not have.
  std::vector<double> numbers(const char* section, const std::vector<std::string>& names) const;
};

/// `file`: of the model. Nothing after a mistake, which is reported.
std::optional<EndOfRun> read_end_of_run(Report& report, const Value& value, const std::string& file);

/// `what` (a bar or bolt) has been tightened in the other run, so that it has no step here.
std::string tightened_already(const char* what, const std::string& name, const EndOfRun& end);

}  // namespace scabo::input
