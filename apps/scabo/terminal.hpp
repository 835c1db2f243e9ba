// What standard error is: a terminal or a pipe, with colour or without; and messages on it.
#pragma once

#include <string>
#include <string_view>

#include "scabo/base/error.hpp"

namespace scabo::app {

bool stderr_is_terminal();
bool stderr_has_colour();  ///< a terminal, not a dumb one, and NO_COLOR unset or empty
int terminal_width();      ///< columns of standard error, 80 where unknown

/// Where standard error cannot be written (closed, a broken pipe, a full disk), the text is lost and the program goes
/// on: the exit status tells the same.
void print_to_stderr(std::string_view text);
/// Every mistake of the input on its own line, `model.yaml:12:5: bodies.upper.material: ...`.
void print_mistakes(const InputError& error);
void print_error(std::string_view message);    ///< `scabo: message`
void print_warning(std::string_view message);  ///< `scabo: warning: message`

/// Writes to standard output; throws where that fails (a full disk, a closed pipe), so that nobody takes half
/// an answer for a whole one.
void print_output(std::string_view text);

/// The same for text that repeats what lies in files: where it cannot be written, a warning at most. None where the
/// reader has gone (`| head`) or standard output is closed (`>&-`).
void print_summary(std::string_view text);

/// `1 node`, `2 nodes`.
std::string count(long number, std::string_view noun);

}  // namespace scabo::app
