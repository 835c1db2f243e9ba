#include "scabo/model/wording.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace scabo::model {

namespace {
constexpr std::size_t most_names = 14;
constexpr std::size_t longest_name = 60;
}  // namespace

std::string number_text(double value) { return fmt::format("{}", value); }

std::string point_text(const Vec2& point) { return fmt::format("({:.9g}, {:.9g})", point.x(), point.y()); }

const std::string& shown_name(const geometry::Edge& edge) {
  return edge.names.size() > 1 ? edge.names[1] : edge.names[0];
}

std::string name_list(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == most_names) return list + ", ...";
    if (i > 0) list += ", ";
    list += names[i].substr(0, longest_name);
  }
  return list;
}

std::string named_like_a_support(const std::string& name) {
  return fmt::format("a support is also named '{}', and a step could mean either: rename one of them", name);
}

std::string counted(long number, std::string_view noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

bool is_name(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto is_rest = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; };
  return !text.empty() && is_letter(text[0]) && std::all_of(text.begin(), text.end(), is_rest);
}

}  // namespace scabo::model
