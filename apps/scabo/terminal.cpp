#include "terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace scabo::app {

namespace {

constexpr std::string_view bold = "\033[1m", red = "\033[1;31m", yellow = "\033[1;33m", plain = "\033[0m";

std::string painted(std::string_view text, std::string_view colour) {
  return stderr_has_colour() ? fmt::format("{}{}{}", colour, text, plain) : std::string(text);
}

}  // namespace

bool stderr_is_terminal() {
  static const bool is = isatty(STDERR_FILENO) == 1;
  return is;
}

bool stderr_has_colour() {
  static const bool has = [] {
    const char* no_color = std::getenv("NO_COLOR");
    const char* term = std::getenv("TERM");
    return stderr_is_terminal() && !(no_color && *no_color) && term && std::string_view(term) != "dumb";
  }();
  return has;
}

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void print_to_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

bool is_of_an_option(const InputError& error) { return error.file().starts_with("--"); }

void print_mistakes(const InputError& error) {
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    if (is_of_an_option(error)) {
      print_error(format_diagnostic(error.file(), diagnostic));
      continue;
    }
    const std::string line = format_diagnostic(error.file(), diagnostic);
    const size_t message = line.size() - diagnostic.message.size();
    print_to_stderr(fmt::format("{}{}\n", painted(line.substr(0, message), bold), diagnostic.message));
  }
}

void print_error(std::string_view message) { print_to_stderr(fmt::format("{} {}\n", painted("scabo:", red), message)); }

void print_warning(std::string_view message) {
  print_to_stderr(fmt::format("{} {}\n", painted("scabo: warning:", yellow), message));
}

void print_output(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
}

void print_summary(std::string_view text) {
  try {
    print_output(text);
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::broken_pipe && error.code() != std::errc::bad_file_descriptor)
      print_warning(fmt::format("{}; the results are nevertheless complete", error.what()));
  }
}

}  // namespace scabo::app
