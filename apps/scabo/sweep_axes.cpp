#include "sweep_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "scabo/base/error.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::app {

namespace {

constexpr const char* examples =
    "write path=0.1,0.2,0.5 or path=FIRST:LAST:COUNT or path=log:FIRST:LAST:COUNT, as in "
    "contacts.joint.friction=0.1:0.9:9";

[[noreturn]] void refuse_axis(std::string_view text, const std::string& why) {
  throw InputError("--vary", {{{}, fmt::format("'{}' {}", text, why)}});
}

/// Parts between separators that stand outside of brackets and quotes.
std::vector<std::string> split_outside_brackets(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == separator && depth == 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  for (std::string& part : parts) {
    const auto first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
    part = first == std::string::npos ? "" : part.substr(first, last - first + 1);
  }
  return parts;
}

double number_of(std::string_view axis, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (!text.empty() && *end == '\0' && std::isfinite(value) && std::abs(value) > 1e100)
    refuse_axis(axis, fmt::format("has {}, which is larger in size than 1e100: write a smaller number", text));
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    refuse_axis(axis, fmt::format("has '{}' where a number must stand: {}", text, examples));
  return value;
}

/// Fifteen digits: 0.1 + 2 * 0.1 is 0.3.
std::string rounded(double value) { return fmt::format("{:.15g}", value == 0.0 ? 0.0 : value); }

std::vector<std::string> range(std::string_view axis, const std::vector<std::string>& parts, bool logarithmic) {
  if (parts.size() != 3) refuse_axis(axis, fmt::format("is not a range: {}", examples));
  const double first = number_of(axis, parts[0]), last = number_of(axis, parts[1]);
  const double wanted = number_of(axis, parts[2]);
  if (std::floor(wanted) != wanted || wanted < 2.0 || wanted > static_cast<double>(most_sweep_points))
    refuse_axis(axis,
                fmt::format("must have a whole number of values from 2 to {}, not {}", most_sweep_points, parts[2]));
  if (first == last) refuse_axis(axis, "begins and ends with the same value: give that value alone");
  if (logarithmic && !(first * last > 0.0)) refuse_axis(axis, "must have two ends of one sign, other than 0");
  const auto count = static_cast<std::size_t>(wanted);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count - 1);
    const double value = logarithmic ? first * std::pow(last / first, t) : first + t * (last - first);
    values.push_back(rounded(i == 0 ? first : i + 1 == count ? last : value));
  }
  return values;
}

}  // namespace

SweepAxis parse_axis(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos) refuse_axis(text, fmt::format("has no '=': {}", examples));
  SweepAxis axis;
  try {
    axis.path = input::parse_override(text.substr(0, equals + 1)).path;
  } catch (const InputError&) {
    refuse_axis(text, fmt::format("has no path before '=', or an empty key in it: {}", examples));
  }
  if (axis.path.find('.') == std::string::npos) axis.path.insert(0, "parameters.");
  const std::string_view values = text.substr(equals + 1);
  std::vector<std::string> parts = split_outside_brackets(values, ':');
  if (parts.size() > 1 && values.find_first_of("{\"'") == std::string_view::npos) {
    const bool logarithmic = parts.front() == "log";
    if (logarithmic) parts.erase(parts.begin());
    axis.values = range(text, parts, logarithmic);
    return axis;
  }
  axis.values = split_outside_brackets(values, ',');
  if (axis.values.size() > most_sweep_points)
    refuse_axis(text.substr(0, 60), fmt::format("has more than {} values", most_sweep_points));
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    if (axis.values[i].empty()) refuse_axis(text, fmt::format("has an empty value: {}", examples));
    for (std::size_t j = 0; j < i; ++j)
      if (axis.values[i] == axis.values[j]) refuse_axis(text, fmt::format("has the value {} twice", axis.values[i]));
  }
  return axis;
}

std::vector<std::string> values_at(const std::vector<SweepAxis>& axes, std::size_t index) {
  std::vector<std::string> values(axes.size());
  for (std::size_t a = axes.size(); a-- > 0;) {
    values[a] = axes[a].values[index % axes[a].values.size()];
    index /= axes[a].values.size();
  }
  return values;
}

std::size_t count_points(const std::vector<SweepAxis>& axes) {
  std::size_t count = 1;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b)
      if (axes[a].path == axes[b].path) refuse_axis(axes[a].path, "is varied twice: give all its values in one --vary");
    count *= axes[a].values.size();
    if (count > most_sweep_points)
      refuse_axis(axes[a].path,
                  fmt::format("makes more than {} runs of this sweep: use fewer values", most_sweep_points));
  }
  return count;
}

}  // namespace scabo::app
