// The text of a model file as it is on the disk.
#pragma once

#include <string>

#include "scabo/input/yaml_document.hpp"

namespace scabo::input {

/// Throws an InputError about a file as a whole.
[[noreturn]] void refuse_file(const std::string& file, std::string message);

/// The content of a file. Throws InputError if it does not exist, is not a file, cannot be read or exceeds the limit.
std::string read_text_file(const std::string& file, const YamlLimits& limits = {});

}  // namespace scabo::input
