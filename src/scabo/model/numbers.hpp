// Strict reading of numbers: the whole text, finite, without a unit.
#pragma once

#include <string>
#include <string_view>
#include <variant>

namespace scabo::model {

/// The number that `text` writes in decimal (`3`, `-0.5`, `10e9`, `.5`, `+1`), or why it is none, as a
/// sentence without a subject: `must be a number, not 'abc'`. Sizes beyond 1e100 and below 1e-100 are
/// refused: no length, force or stiffness has them, and their squares would overflow.
std::variant<double, std::string> parse_number(std::string_view text);

/// `3`, `0.3`, `1e-9`: the shortest text that reads back as the same number.
std::string number_text(double value);

}  // namespace scabo::model
