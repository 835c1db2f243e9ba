// "Did you mean ...?" for misspelt names and keys.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scabo::input {

/// The name in `known` that is closest to `name` by single-character changes and swaps; empty if none is close.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// The key in `known` that other programs and textbooks call `name`, as in `E` for `young`; empty if there is none.
std::string key_of_synonym(std::string_view name, const std::vector<std::string>& known);

/// ` (did you mean 'concrete'?)`, or the list of available names if none is close, or nothing.
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

/// The text with line ends and tabs replaced by spaces, because a message is one line.
std::string one_line(std::string_view text);

/// The text, shortened to `most` bytes (not within a character) and followed by `...`.
std::string shortened(std::string_view text, std::size_t most);

/// `'name'` on one line, shortened if it is very long.
std::string quoted_name(std::string_view name);

}  // namespace scabo::input
