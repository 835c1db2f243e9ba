// The `--set path=value` of the command line.
#pragma once

#include <string>
#include <vector>

#include "scabo/input/read_model.hpp"

namespace scabo::input {

/// Throws InputError with every setting that cannot be understood.
std::vector<Override> parse_settings(const std::vector<std::string>& settings);

}  // namespace scabo::input
