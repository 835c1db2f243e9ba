// "Did you mean ...?" for misspelt names and keys.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scabo::model {

/// The one of `known` closest to `name`, by single-character changes and swaps; empty when none is close.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// The one of `known` keys that other programs and textbooks call `name`, as in `E` for `young`; empty when none is.
std::string key_of_synonym(std::string_view name, const std::vector<std::string>& known);

/// ` (did you mean 'concrete'?)`, or the list of what there is when nothing is close, or nothing.
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

/// `a, b, c`, cut after twelve.
std::string name_list(const std::vector<std::string>& names);

/// The text with line ends and tabs as spaces: a message is one line.
std::string one_line(std::string_view text);

/// The text, cut after `most` bytes (not within a character) with `...` for the rest.
std::string shortened(std::string_view text, std::size_t most);

/// `'name'` in one line, shortened when it is very long.
std::string quoted_name(std::string_view name);

}  // namespace scabo::model
