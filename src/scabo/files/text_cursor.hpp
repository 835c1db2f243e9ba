// Reads words and numbers of a text from its start to its end and knows the line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace scabo::files {

/// A number of a text; empty text and trailing characters are none. Accepts a leading `+` and Fortran's exponent `D`.
/// An overflow gives an infinite value.
bool parse_number(std::string_view text, double& value);
bool parse_number(std::string_view text, std::int64_t& value);

/// The first 40 characters, others than printable ones replaced: for messages.
std::string printable(std::string_view text);

class TextCursor {
 public:
  TextCursor(std::string_view text, std::string file, int first_line = 1)
      : begin_(text.data()),
        at_(begin_),
        end_(begin_ + text.size()),
        line_begin_(begin_),
        line_(first_line),
        file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  int line() const { return line_; }
  std::size_t position() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
  std::string_view rest() const { return {at_, remaining()}; }

  /// Goes on to the next character that is not white; false at the end.
  bool skip_white() {
    while (at_ != end_ && static_cast<unsigned char>(*at_) <= ' ') {
      if (*at_ == '\n') {
        ++line_;
        line_begin_ = at_ + 1;
      }
      ++at_;
    }
    return at_ != end_;
  }

  /// The next characters up to white space; empty at the end.
  std::string_view word() {
    if (!skip_white()) return {};
    const char* first = at_;
    while (at_ != end_ && static_cast<unsigned char>(*at_) > ' ') ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
  }

  /// The rest of this line without its end; goes on to the next line.
  std::string_view rest_of_line();

  /// The next number, on this or a later line. `what` names it in the error, as in `the number of a node`.
  std::int64_t integer(const char* what);
  double number(const char* what);

  /// Moves by `count` bytes, at most `remaining()`, without looking for lines: binary data.
  void skip_bytes(std::size_t count) { at_ += count; }

  /// Moves to `position`, at or after the present one, and counts the lines between.
  void advance_to(std::size_t position);

  /// Throws InputError at the present position (line and column).
  [[noreturn]] void fail(const std::string& message) const;

 private:
  template <typename Number>
  Number read_number(const char* what);
  [[noreturn]] void fail_number(const char* what);

  const char* begin_;
  const char* at_;
  const char* end_;
  const char* line_begin_;
  int line_;
  std::string file_;
};

/// Throws InputError with a line (0: none) and a message.
[[noreturn]] void fail_in_file(const std::string& file, int line, int column, const std::string& message);

}  // namespace scabo::files
