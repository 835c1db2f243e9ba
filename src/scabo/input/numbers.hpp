// Strict reading of numbers: the whole text must be a finite number without a unit.
#pragma once

#include <string>
#include <string_view>
#include <variant>

namespace scabo::input {

/// The number that `text` gives in decimal notation (`3`, `-0.5`, `10e9`, `.5`, `+1`), or the reason why it is not a
/// number, as a sentence without a subject: `must be a number, not 'abc'`. Magnitudes above 1e100 and below 1e-100 are
/// refused: no length, force or stiffness has them, and their squares would overflow.
std::variant<double, std::string> parse_number(std::string_view text);

}  // namespace scabo::input
