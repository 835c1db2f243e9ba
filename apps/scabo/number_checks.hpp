// Checks of numbers on the command line. The messages are those of numbers in a model file: `must be ..., not '0'`.
#pragma once

#include <CLI/CLI.hpp>

namespace scabo::app {

/// A whole number from `least` to `most`.
CLI::Validator whole_number(long least, long most);

/// A number from `least` to `most`.
CLI::Validator number_from(double least, double most);

/// A finite number greater than 0.
CLI::Validator positive_number();

/// A finite number, 0 or more.
CLI::Validator number_from_zero();

}  // namespace scabo::app
