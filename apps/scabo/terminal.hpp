// Properties of standard error (a terminal or a pipe, with or without colour), and messages written to it.
#pragma once

#include <string>
#include <string_view>

#include "scabo/base/error.hpp"

namespace scabo::app {

bool stderr_is_terminal();
bool stderr_has_colour();  ///< a terminal, not a dumb one, and NO_COLOR unset or empty
int terminal_width();      ///< columns of standard error, 80 if unknown

/// If standard error cannot be written (closed, a broken pipe, a full disk), the text is lost and the program
/// continues; the exit status gives the same information.
void print_to_stderr(std::string_view text);
/// Whether an option is wrong (`--set`, `--vary`), not a file.
bool is_of_an_option(const InputError& error);
/// Every mistake of the input on its own line, `model.yaml:12:5: bodies.upper.material: ...`, or `scabo: --set: ...`
/// where an option itself is wrong.
void print_mistakes(const InputError& error);
void print_error(std::string_view message);    ///< `scabo: message`
void print_warning(std::string_view message);  ///< `scabo: warning: message`

/// Writes to standard output. Throws if that fails (a full disk, a closed pipe), so that incomplete output is not taken
/// for complete.
void print_output(std::string_view text);

/// The same for text that repeats the content of files: if it cannot be written, there is only a warning, and none if
/// the reader has ended (`| head`) or standard output is closed (`>&-`).
void print_summary(std::string_view text);

}  // namespace scabo::app
