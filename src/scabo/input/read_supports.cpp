// `supports`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>

#include "scabo/input/formula.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

using Displacement = std::array<std::optional<double>, 2>;

constexpr const char* support_example = "{on: lower.left, fix: [x, y]}";

}  // namespace

/// `{symmetry: {x: 0}}` (read_symmetry.cpp): a support for every edge on the line; none if it is broken.
std::vector<Support> read_symmetry(Reading& reading, const Value& item);

namespace {

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
  if (is_one_of({"n", "un", "perpendicular", "symmetry"})) return "normal";
  if (is_one_of({"t", "ut", "tangential"})) return "tangent";
  if (is_one_of({"y", "uy", "u2", "2", "v", "vertical"})) return "y";
  return "";
}

/// What a support prescribes: its axes and the displacement along them.
struct Prescribed {
  Displacement displacement;
  SupportAxes axes = SupportAxes::xy;
  Vec2 along = Vec2(1.0, 0.0);
  std::array<PointFormula, 2> shape = {};
};

constexpr const char* fix_forms = "x, y, [x, y], normal, tangent or {along: [1, 2]}";

/// `along: [1, 2]`, of any length; false if it is broken.
bool read_along(Reading& reading, const std::optional<Value>& value, Prescribed& prescribed) {
  const auto direction = value ? read_vector(reading.report, *value) : std::nullopt;
  if (!direction) return false;
  prescribed.axes = SupportAxes::direction;
  prescribed.along = direction->norm() > 0.0 ? Vec2(direction->stableNormalized()) : Vec2(Vec2::Zero());
  return true;
}

std::optional<Prescribed> read_fix(Reading& reading, const Value& value) {
  Prescribed prescribed;
  if (value.node->kind == Node::Kind::map) {
    const MapReader map(reading.report, value, {"along"}, "{along: [1, 2]}");
    if (!read_along(reading, map.need("along"), prescribed)) return {};
    prescribed.displacement[0] = 0.0;
    return prescribed;
  }
  std::vector<Value> items{value};
  if (value.node->kind == Node::Kind::sequence) {
    items = *read_list(reading.report, value, "[x, y]");
  }
  if (items.empty()) {
    reading.report.error(value, fmt::format("must be {}, not an empty list", fix_forms));
    return {};
  }
  for (const Value& item : items) {
    const Node& node = *item.node;
    constexpr std::array<const char*, 4> names = {"x", "y", "normal", "tangent"};
    const auto name = node.kind == Node::Kind::scalar ? std::find(names.begin(), names.end(), node.text) : names.end();
    if (name == names.end()) {
      const std::string meant = node.kind == Node::Kind::scalar ? meant_components(node.text) : "";
      reading.report.error(item, fmt::format("must be {}, not {}{}", fix_forms, describe(node),
                                             meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant)));
      return {};
    }
    const auto number = static_cast<std::size_t>(name - names.begin());
    const SupportAxes axes = number < 2 ? SupportAxes::xy : SupportAxes::edge;
    if (&item != &items.front() && axes != prescribed.axes) {
      reading.report.error(item,
                           "x and y do not go together with normal and tangent: use two supports, or [x, y] to "
                           "fix both components");
      return {};
    }
    prescribed.axes = axes;
    auto& component = prescribed.displacement[number % 2];
    if (component) {
      reading.report.error(item, fmt::format("{} is given twice: remove one of the two", node.text));
      return {};
    }
    component = 0.0;
  }
  return prescribed;
}

/// A formula of x and y; none if it is broken.
PointFormula read_point_formula(Report& report, const Value& value) {
  const auto text = read_text(report, value);
  if (!text) return {};
  for (const std::string& name : names_in_formula(*text))
    if (name != "x" && name != "y") {
      report.error(value, fmt::format("the formula {} has the name {}: besides parameters in ${{}} there are x and y, "
                                      "the coordinates",
                                      quoted_name(*text), quoted_name(name)));
      return {};
    }
  return [text = *text](const Vec2& at) { return value_of_formula(text, {{"x", at.x()}, {"y", at.y()}}); };
}

/// `formula: [ux, uy]`: numbers, formulas of x and y, or null; false if it is broken.
bool read_formulas(Reading& reading, const Value& value, Prescribed& prescribed) {
  const Node& node = *value.node;
  if (node.kind != Node::Kind::sequence || node.items.size() != 2) {
    reading.report.error(value, R"(must be two formulas, as in ["0.1 * x", null], with null for a free component)");
    return false;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (node.items[i]->kind == Node::Kind::null) continue;
    prescribed.shape[i] = read_point_formula(reading.report, value.item(i));
    if (!prescribed.shape[i]) return false;
    prescribed.displacement[i] = 1.0;
  }
  return true;
}

std::optional<Prescribed> read_displacement(Reading& reading, const Value& value) {
  const Node& node = *value.node;
  Prescribed prescribed;
  if (node.kind == Node::Kind::map) {
    const std::size_t before = reading.report.count();
    const MapReader map(reading.report, value, {"normal", "tangent", "along", "value", "formula"},
                        "{normal: -1e-3} or {along: [1, 2], value: 1e-3}");
    if (map.has("formula")) {
      for (const char* key : {"normal", "tangent", "along", "value"})
        if (map.has(key)) map.refuse(key, "does not go together with formula, which is along x and y: leave it out");
      read_formulas(reading, *map.get("formula"), prescribed);
    } else if (map.has("along")) {
      for (const char* key : {"normal", "tangent"})
        if (map.has(key)) map.refuse(key, "does not go together with along: use two supports");
      read_along(reading, map.get("along"), prescribed);
      prescribed.displacement[0] = number_or_unread(reading, map.need("value"));
    } else {
      prescribed.axes = SupportAxes::edge;
      if (map.has("value")) map.refuse("value", "needs along: [1, 2], its direction");
      if (const auto normal = map.get("normal")) prescribed.displacement[0] = number_or_unread(reading, normal);
      if (const auto tangent = map.get("tangent")) prescribed.displacement[1] = number_or_unread(reading, tangent);
      if (map.all_known() && reading.report.count() == before && !prescribed.displacement[0] &&
          !prescribed.displacement[1])
        reading.report.error(value, "needs normal or tangent, or along and value");
    }
    if (reading.report.count() > before) return {};
    return prescribed;
  }
  if (node.kind != Node::Kind::sequence || node.items.size() != 2) {
    reading.report.error(value,
                         fmt::format("must be [ux, uy], with null for a free component, not {}",
                                     node.kind == Node::Kind::sequence ? fmt::format("a list of {}", node.items.size())
                                                                       : describe(node)));
    return {};
  }
  bool good = true;
  for (std::size_t i = 0; i < 2; ++i) {
    if (node.items[i]->kind == Node::Kind::null) continue;
    prescribed.displacement[i] = read_number(reading.report, value.item(i));
    good = good && prescribed.displacement[i].has_value();
  }
  if (!good) return {};
  return prescribed;
}

/// One support; nothing if it is broken. A name given by the user is recorded in any case.
std::optional<Support> read_support(Reading& reading, const Value& value, Reading::Stages& stages) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"on", "fix", "displacement", "rotation", "at", "name", "added", "removed"},
                      support_example);
  Support support;
  support.source = value.source();
  if (const auto name = map.get("name")) {
    const auto text = read_text(report, *name);
    if (text && check_name(report, name->source(), *text)) {
      support.name = *text;
      reading.own_support_names.insert(*text);
    }
  }
  stages = {map.get("added"), map.get("removed")};
  const auto on = map.need("on");
  if (!on) reading.places_known = false;
  const ReadPlace place = on ? read_place(reading, *on) : ReadPlace{};
  if (place.body >= 0) reading.state(place.body).held = true;
  if (!map.is_map()) return {};
  std::optional<Prescribed> prescribed;
  const auto rotation = map.get("rotation");
  if (rotation) support.rotation = number_or_unread(reading, rotation);
  if (const auto at = map.get("at")) {
    if (!rotation) map.refuse("at", "is the point that a rotation is about: give a rotation too, 0 to prevent it");
    support.at = read_vector(report, *at);
  }
  if (rotation && map.has("fix"))
    map.refuse("rotation", "does not go together with fix: write displacement: [0, 0] beside it");
  if (rotation && !map.has("fix") && !map.has("displacement")) {
    prescribed = Prescribed{};
  } else if (map.has("fix") == map.has("displacement")) {
    if (map.has("fix") || report.count() == before) {
      report.error(value, map.has("fix") ? "needs one of fix and displacement, not both" : "needs fix or displacement");
    }
  } else if (const auto fix = map.get("fix")) {
    prescribed = read_fix(reading, *fix);
  } else {
    prescribed = read_displacement(reading, *map.get("displacement"));
  }
  if (report.count() > before || !place.place || !prescribed) return {};
  support.on = *place.place;
  support.displacement = prescribed->displacement;
  support.axes = prescribed->axes;
  support.along = prescribed->along;
  support.shape = prescribed->shape;
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
    if (item.node->kind == Node::Kind::map && item.node->find("symmetry")) {
      const std::size_t before = reading.report.count();
      for (Support& support : read_symmetry(reading, item)) {
        reading.support_is_named.push_back(false);
        reading.stages_of_supports.emplace_back();
        reading.model.supports.push_back(std::move(support));
      }
      if (reading.report.count() > before) reading.conditions_known = reading.places_known = false;
      continue;
    }
    Reading::Stages stages;
    if (auto support = read_support(reading, item, stages)) {
      reading.stages_of_supports.push_back(std::move(stages));
      reading.support_is_named.push_back(!support->name.empty());
      reading.model.supports.push_back(std::move(*support));
    } else {
      reading.conditions_known = false;
    }
  }
  name_supports(reading);
}

}  // namespace scabo::input
