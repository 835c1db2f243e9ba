// `supports`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>

#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

using Displacement = std::array<std::optional<double>, 2>;

constexpr const char* support_example = "{on: lower.left, fix: [x, y]}";

/// Component names of other programs: a remedy for `fix`, or nothing.
std::string meant_components(std::string_view text) {
  std::string plain;
  for (const char c : text)
    if (c != ' ' && c != ',' && c != '_') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), plain) != names.end();
  };
  if (is_one_of(
          {"all", "both", "xy", "yx", "uxuy", "12", "u1u2", "true", "yes", "fixed", "clamped", "encastre", "pinned"}))
    return "[x, y]";
  if (is_one_of({"x", "ux", "u1", "1", "u", "horizontal"})) return "x";
  if (is_one_of({"y", "uy", "u2", "2", "v", "vertical"})) return "y";
  return "";
}

std::optional<Displacement> read_fix(Reading& reading, const Value& value) {
  std::vector<Value> items{value};
  if (value.node->kind == Node::Kind::sequence) {
    items = *read_list(reading.report, value, "[x, y]");
  }
  Displacement displacement;
  bool good = !items.empty();
  for (const Value& item : items) {
    const Node& node = *item.node;
    const bool x = node.kind == Node::Kind::scalar && node.text == "x";
    const bool y = node.kind == Node::Kind::scalar && node.text == "y";
    if (!x && !y) {
      const std::string meant = node.kind == Node::Kind::scalar ? meant_components(node.text) : "";
      reading.report.error(item, fmt::format("must be x, y or [x, y], not {}{}", describe(node),
                                             meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant)));
      return {};
    }
    auto& component = displacement[x ? 0 : 1];
    if (component) {
      reading.report.error(item, fmt::format("{} is given twice: remove one of the two", node.text));
      return {};
    }
    component = 0.0;
  }
  if (!good) reading.report.error(value, "must be x, y or [x, y], not an empty list");
  return good ? std::optional(displacement) : std::nullopt;
}

std::optional<Displacement> read_displacement(Reading& reading, const Value& value) {
  const Node& node = *value.node;
  if (node.kind != Node::Kind::sequence || node.items.size() != 2) {
    reading.report.error(value,
                         fmt::format("must be [ux, uy], with null for a free component, not {}",
                                     node.kind == Node::Kind::sequence ? fmt::format("a list of {}", node.items.size())
                                                                       : describe(node)));
    return {};
  }
  Displacement displacement;
  bool good = true;
  for (std::size_t i = 0; i < 2; ++i) {
    if (node.items[i]->kind == Node::Kind::null) continue;
    displacement[i] = read_number(reading.report, value.item(i));
    good = good && displacement[i].has_value();
  }
  if (!good) return {};
  return displacement;
}

/// One support; nothing if it is broken. A name given by the user is recorded in any case.
std::optional<Support> read_support(Reading& reading, const Value& value) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"on", "fix", "displacement", "name"}, support_example);
  Support support;
  support.source = value.source();
  if (const auto name = map.get("name")) {
    const auto text = read_text(report, *name);
    if (text && check_name(report, name->source(), *text)) {
      support.name = *text;
      reading.own_support_names.insert(*text);
    }
  }
  const auto on = map.need("on");
  if (!on) reading.places_known = false;
  const ReadPlace place = on ? read_place(reading, *on) : ReadPlace{};
  if (place.body >= 0) reading.state(place.body).held = true;
  if (!map.is_map()) return {};
  std::optional<Displacement> displacement;
  if (map.has("fix") == map.has("displacement")) {
    if (map.has("fix") || report.count() == before) {
      report.error(value, map.has("fix") ? "needs one of fix and displacement, not both" : "needs fix or displacement");
    }
  } else if (const auto fix = map.get("fix")) {
    displacement = read_fix(reading, *fix);
  } else {
    displacement = read_displacement(reading, *map.get("displacement"));
  }
  if (report.count() > before || !place.place || !displacement) return {};
  support.on = *place.place;
  support.displacement = *displacement;
  return support;
}

/// Names of supports without a given name: the place, made unique.
void name_supports(Reading& reading) {
  std::set<std::string> taken = reading.own_support_names;
  std::map<std::string, int> last;
  for (Support& support : reading.model.supports) {
    if (!support.name.empty()) continue;
    std::string name = support.on.text;
    int& k = last[name];  // smaller numbers are in use
    for (k = std::max(k, 1); !taken.insert(name).second;) name = fmt::format("{} ({})", support.on.text, ++k);
    support.name = name;
  }
}

}  // namespace

void read_supports(Reading& reading, const Value& value) {
  const auto items = read_list(reading.report, value, "[{on: lower.left, fix: [x, y]}]");
  if (!items) reading.places_known = reading.conditions_known = false;
  for (const Value& item : items.value_or(std::vector<Value>{})) {
    if (auto support = read_support(reading, item)) {
      reading.support_is_named.push_back(!support->name.empty());
      reading.model.supports.push_back(std::move(*support));
    } else {
      reading.conditions_known = false;
    }
  }
  name_supports(reading);
}

}  // namespace scabo::input
