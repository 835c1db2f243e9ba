// Keys that other programs have and a model file does not: one sentence says what takes their place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scabo::input {

/// About an unknown key of a map with these `known` keys; empty if nothing is known about it.
std::string about_foreign_key(std::string_view key, const std::vector<std::string>& known);

}  // namespace scabo::input
