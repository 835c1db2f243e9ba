// Model file (YAML, docs/model_file.md) -> Model.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scabo/model/model.hpp"

namespace scabo::input {

/// `contacts.joint.friction=0.5`: replaces (or adds) the value at a path; the value is YAML.
struct Override {
  std::string path;
  std::string value;
};

/// Splits `path=value`; throws InputError when there is no `=` or the path is empty.
Override parse_override(std::string_view text);

/// Reads and checks a model file. Throws InputError with all mistakes found, each with its line and column.
model::Model read_model(const std::string& file, const std::vector<Override>& overrides = {});

/// The same from text; `file` is only used in messages.
model::Model parse_model(std::string_view text, const std::string& file, const std::vector<Override>& overrides = {});

/// JSON Schema (draft 2020-12) of the model file, as printed by `scabo schema`.
std::string_view model_schema();

}  // namespace scabo::input
