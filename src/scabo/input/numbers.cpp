#include "scabo/input/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Length of the longest decimal number at the start of `text`; 0 if there is none.
std::size_t number_length(std::string_view text) {
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t first = i;
    while (i < text.size() && is_digit(text[i])) ++i;
    return i - first;
  };
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
  std::size_t count = digits();
  if (i < text.size() && text[i] == '.') {
    ++i;
    count += digits();
  }
  if (count == 0) return 0;
  const std::size_t mantissa = i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
    if (digits() == 0) return mantissa;
  }
  return i;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Message for `text`, which is not a number, according to what was probably meant.
std::string why_no_number(std::string_view text, std::size_t length) {
  std::string bare = lower(text);
  bare.erase(std::remove_if(bare.begin(), bare.end(), [](char c) { return c == '.' || c == '+' || c == '-'; }),
             bare.end());
  if (bare == "nan" || bare == "inf" || bare == "infinity") {
    return fmt::format("must be a finite number, not '{}'", text);
  }
  const std::string_view rest = text.substr(length);
  if (length == 0 || rest.empty()) return fmt::format("must be a number, not '{}'", text);
  const bool all_digits = std::all_of(text.begin(), text.end(), [](char c) { return is_digit(c) || c == '_'; });
  if (rest[0] == '_' && all_digits) return fmt::format("'{}' is not a number: write it without '_'", text);
  const auto after = rest.find_first_not_of(' ');
  if (after == std::string_view::npos) return fmt::format("must be a number, not '{}'", text);
  if (rest.size() > 1 && rest[0] == ',' && number_length(rest.substr(1)) == rest.size() - 1 && is_digit(rest[1])) {
    return fmt::format("'{}' is not a number: write {}.{}, with a decimal point", text, text.substr(0, length),
                       rest.substr(1));
  }
  const std::string prefix = lower(text.substr(0, 3));
  if (prefix.substr(0, 2) == "0x" || prefix.substr(0, 2) == "0o" || prefix.substr(0, 2) == "0b") {
    return fmt::format("'{}' is not a decimal number: write it in decimal notation", text);
  }
  const auto unit = static_cast<unsigned char>(rest[after]);
  if (std::isalpha(unit) != 0 || unit == '%' || unit >= 0x80) {
    return fmt::format("'{}' is not a number: leave out the unit, and use consistent units throughout", text);
  }
  if (rest[after] == '*' || rest[after] == '/' || rest[after] == '+' || rest[after] == '-' || rest[after] == '^') {
    return fmt::format("'{0}' is a formula, not a number: write its value, or \"${{{0}}}\"", text);
  }
  return fmt::format("must be a number, not '{}'", text);
}

}  // namespace

std::variant<double, std::string> parse_number(std::string_view text) {
  const std::size_t length = number_length(text);
  // A text of kilobytes in a message would not be helpful.
  if (length != text.size() || text.empty()) {
    if (text.size() > 60) return std::string("must be a number, not a long text");
    return why_no_number(one_line(text), length);
  }
  std::string_view digits = text;
  if (digits[0] == '+') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const std::string shown(text.substr(0, 60));
  if (code == std::errc::result_out_of_range) {
    // from_chars does not report which end of the range was exceeded.
    const auto exponent = lower(digits).find("e-");
    if (exponent != std::string::npos)
      return fmt::format("'{}' is smaller in size than 1e-100: write 0 or a larger number", shown);
    return fmt::format("'{}' is larger in size than 1e100: write a smaller number", shown);
  }
  if (code != std::errc() || end != digits.data() + digits.size()) {
    return fmt::format("must be a number, not '{}'", shown);
  }
  if (std::abs(value) > 1e100) return fmt::format("'{}' is larger in size than 1e100: write a smaller number", shown);
  if (value != 0.0 && std::abs(value) < 1e-100)
    return fmt::format("'{}' is smaller in size than 1e-100: write 0 or a larger number", shown);
  return value == 0.0 ? 0.0 : value;  // no -0
}

}  // namespace scabo::input
