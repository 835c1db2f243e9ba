// Formulas of the model file, as in `${2 * b + 1}`: numbers, parameters, + - * / ^, parentheses and a few functions.
//
// muParser evaluates them. There are no assignments, conditions, loops or functions of the user; a formula has at most
// `longest_formula` characters, so that its evaluation takes less than a millisecond and no memory to speak of. Every
// operation must give a finite number.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace scabo::input {

constexpr std::size_t longest_formula = 1000;

/// Values of parameters by name.
using ParameterValues = std::map<std::string, double, std::less<>>;

/// Whether `text` is a name that a parameter may have: letters, digits and _, no function or constant, and not a word
/// that YAML 1.1 reads as a truth value.
bool is_parameter_name(std::string_view text);

/// Names in a formula that are neither functions nor constants, each once.
std::vector<std::string> names_in_formula(std::string_view formula);

/// Functions and constants.
std::vector<std::string> words_of_formulas();

/// Why it cannot be read, whatever the values of its names, as a sentence without a subject; empty: it can.
std::string mistake_in_formula(const std::string& formula);

/// The value, or the reason why there is none, as a sentence without a subject. All its names must be in `values`.
std::variant<double, std::string> value_of_formula(const std::string& formula, const ParameterValues& values);

}  // namespace scabo::input
