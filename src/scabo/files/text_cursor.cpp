#include "scabo/files/text_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "scabo/base/error.hpp"

namespace scabo::files {

bool parse_number(std::string_view text, double& value) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc() && result.ptr == text.data() + text.size()) return true;
  if (text.empty() || text.size() > 100) return false;
  std::string copy(text);  // an exponent with D, an overflow or an underflow
  if (copy.find_first_of("xX") != std::string::npos) return false;
  std::replace(copy.begin(), copy.end(), 'D', 'E');
  std::replace(copy.begin(), copy.end(), 'd', 'e');
  char* end = nullptr;
  value = std::strtod(copy.c_str(), &end);
  return end == copy.c_str() + copy.size();
}

bool parse_number(std::string_view text, std::int64_t& value) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

std::string_view TextCursor::rest_of_line() {
  const void* found = remaining() == 0 ? nullptr : std::memchr(at_, '\n', remaining());
  const char* stop = found == nullptr ? end_ : static_cast<const char*>(found);
  std::string_view text(at_, static_cast<std::size_t>(stop - at_));
  at_ = stop;
  if (stop != end_) {
    ++at_;
    ++line_;
    line_begin_ = at_;
  }
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

std::string printable(std::string_view text) {
  std::string shown(text.substr(0, 40));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return shown;
}

void TextCursor::fail_number(const char* what) {
  const std::string_view text = word();
  at_ -= text.size();
  if (text.empty()) fail(fmt::format("the file ends where {} is expected: it is truncated; write it again", what));
  fail(fmt::format("'{}' is not {}", printable(text), what));
}

template <typename Number>
Number TextCursor::read_number(const char* what) {
  skip_white();
  Number value{};
  const auto result = std::from_chars(at_, end_, value);
  if (result.ec == std::errc() && (result.ptr == end_ || static_cast<unsigned char>(*result.ptr) <= ' ')) {
    at_ = result.ptr;
    return value;
  }
  const std::string_view text = word();
  if (!parse_number(text, value)) {
    at_ -= text.size();
    fail_number(what);
  }
  return value;
}

std::int64_t TextCursor::integer(const char* what) { return read_number<std::int64_t>(what); }

double TextCursor::number(const char* what) { return read_number<double>(what); }

void TextCursor::advance_to(std::size_t position) {
  const char* target = begin_ + position;
  for (; at_ < target; ++at_) {
    if (*at_ == '\n') {
      ++line_;
      line_begin_ = at_ + 1;
    }
  }
}

void TextCursor::fail(const std::string& message) const {
  fail_in_file(file_, line_, static_cast<int>(std::min<std::ptrdiff_t>(at_ - line_begin_, 1'000'000)) + 1, message);
}

void fail_in_file(const std::string& file, int line, int column, const std::string& message) {
  throw InputError(file, {{{line, column, {}}, message}});
}

}  // namespace scabo::files
