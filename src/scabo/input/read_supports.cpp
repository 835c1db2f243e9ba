// `supports`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <tuple>

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
  if (!displacement[0] && !displacement[1]) {
    reading.report.error(value, "prescribes no displacement: give a number for x or y");
    return {};
  }
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
      if (!reading.own_support_names.insert(*text).second) {
        report.error(*name, fmt::format("another support is already named '{}': rename one of them", *text));
      }
    }
  }
  const auto on = map.need("on");
  if (!on) reading.places_known = false;
  const ReadPlace place = on ? read_place(reading, *on) : ReadPlace{};
  if (place.body >= 0) reading.state(place.body).held = true;
  if (!map.is_map()) return {};
  if (place.place && place.place->kind == Place::Kind::face) {
    report.error(
        *on,
        fmt::format(
            "'{}' is a side face, which has no nodes between its ends: support an edge, a corner or a point instead",
            place.place->text));
    return {};
  }
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

namespace {

/// Whether a corner belongs to a place of the same body.
bool includes_corner(const Place& place, int corner, int corners) {
  switch (place.kind) {
    case Place::Kind::body:
      return true;
    case Place::Kind::corner:
      return place.index == corner;
    case Place::Kind::edge:
      return place.index == corner || (place.index + 1) % corners == corner;
    case Place::Kind::face:
    case Place::Kind::mouth:
    case Place::Kind::near:
      return false;  // known only after meshing
  }
  return false;
}

/// Whether two places of the same body certainly share a point.
bool share_a_point(const Place& a, const Place& b, const Body& body) {
  const int corners = static_cast<int>(body.outline.corners.size());
  const auto is_point = [](const Place& p) { return p.kind == Place::Kind::near || p.kind == Place::Kind::mouth; };
  if (is_point(a) && is_point(b)) return a.kind == b.kind && a.near == b.near && a.index == b.index;
  if (is_point(a) || is_point(b)) {
    return a.kind == Place::Kind::body || b.kind == Place::Kind::body;
  }
  if (a.kind == Place::Kind::edge && b.kind == Place::Kind::edge && a.index == b.index) return true;
  // A body and an edge share the ends of the edge; a corner shares itself; two edges may share a corner.
  const Place& smaller = a.kind == Place::Kind::body ? b : a;
  const Place& larger = a.kind == Place::Kind::body ? a : b;
  if (smaller.kind == Place::Kind::body) return true;
  // At the mouth of a crack on a corner the two edges have different nodes.
  const auto shared = [&](int corner) {
    const bool mouth = !body.cracks.empty() && body.cracks.front().at == 0.0 && body.cracks.front().edge == corner;
    return !mouth && includes_corner(larger, corner, corners);
  };
  return shared(smaller.index) || (smaller.kind == Place::Kind::edge && shared((smaller.index + 1) % corners));
}

std::string where(const Source& source) { return source.line > 0 ? fmt::format("line {}", source.line) : source.path; }

/// Whether two supports that share a point move it differently in some step.
bool differ(const Reading& reading, std::size_t first, std::size_t second, std::size_t component) {
  const auto& a = reading.model.supports[first].displacement[component];
  const auto& b = reading.model.supports[second].displacement[component];
  return a && b && std::any_of(reading.model.steps.begin(), reading.model.steps.end(), [&](const Step& step) {
           return *a * step.support_factors[first] != *b * step.support_factors[second];
         });
}

/// Equal places have equal keys.
using PlaceKey = std::tuple<Place::Kind, int, double, double>;
PlaceKey key_of(const Place& place) { return {place.kind, place.index, place.near.x(), place.near.y()}; }

/// For the supports of one place: the first that prescribes x and the first that prescribes y. Later ones have the same
/// motion or were reported.
using First = std::array<std::optional<std::size_t>, 2>;
using Places = std::map<PlaceKey, First>;

/// The previous supports of the body that a new one can contradict: those at its own place, and those at places that
/// share a point with it. A `near` place shares a point only with itself and with the whole body, and there may be many
/// of them.
std::vector<const First*> candidates(const Places& places, const Place& place, const Body& body) {
  std::vector<const First*> found;
  const auto add = [&](const Place& other) {
    if (const auto at = places.find(key_of(other)); at != places.end() && share_a_point(other, place, body))
      found.push_back(&at->second);
  };
  Place other;
  add(place);
  other.kind = Place::Kind::body;
  if (place.kind != Place::Kind::body) add(other);
  const int corners = static_cast<int>(body.outline.corners.size());
  if (place.kind == Place::Kind::edge || place.kind == Place::Kind::corner)
    for (const int step : {-1, 0, 1})
      for (const Place::Kind kind : {Place::Kind::edge, Place::Kind::corner}) {
        other.kind = kind;
        other.index = (place.index + step + corners) % corners;
        if (key_of(other) != key_of(place)) add(other);
      }
  if (place.kind == Place::Kind::body)
    for (const auto& [key, first] : places)
      if (std::get<0>(key) != Place::Kind::body) found.push_back(&first);
  return found;
}

void report_conflict(Reading& reading, std::size_t first, std::size_t second, std::size_t component) {
  const Support& a = reading.model.supports[first];
  const Support& b = reading.model.supports[second];
  reading.report.error(b.source, fmt::format("prescribes another {} of {} than the support of {} in {}, although they "
                                             "share a point: remove one, or free the component there",
                                             component == 0 ? "x" : "y", b.on.text, a.on.text, where(a.source)));
}

}  // namespace

void check_conflicting_supports(Reading& reading) {
  std::vector<Places> of_body(reading.model.bodies.size());
  for (std::size_t i = 0; i < reading.model.supports.size(); ++i) {
    const Support& support = reading.model.supports[i];
    Places& places = of_body[static_cast<std::size_t>(support.on.body)];
    const auto at = places.find(key_of(support.on));
    // A whole body shares points with all places; once one was compared, another like it adds nothing.
    const bool known = at != places.end() && (!support.displacement[0] || at->second[0]) &&
                       (!support.displacement[1] || at->second[1]);
    std::optional<std::pair<std::size_t, std::size_t>> conflict;  // the first other support, component
    const auto compare = [&](const First& first) {
      for (std::size_t c = 0; c < 2; ++c)
        if (first[c] && (!conflict || *first[c] < conflict->first) && differ(reading, *first[c], i, c))
          conflict = {*first[c], c};
    };
    if (known && support.on.kind == Place::Kind::body) {
      compare(at->second);
    } else {
      for (const First* first : candidates(places, support.on, reading.body(support.on.body))) compare(*first);
    }
    if (conflict) report_conflict(reading, conflict->first, i, conflict->second);  // one message for each support
    First& own = places[key_of(support.on)];
    for (std::size_t c = 0; c < 2; ++c)
      if (support.displacement[c] && !own[c]) own[c] = i;
  }
}

}  // namespace scabo::input
