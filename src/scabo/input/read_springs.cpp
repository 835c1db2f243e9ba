// `springs`.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* spring_example = "{on: beam.bottom, k_n: 50e6}";

/// `k_n` and `k_t` of an edge, or `k_x` and `k_y` of a point; false if a key does not go with the place.
bool read_stiffness(Reading& reading, const MapReader& map, const ReadPlace& place, Spring& spring) {
  const std::size_t before = reading.report.count();
  const bool of_edge = map.has("k_n") || map.has("k_t"), of_point = map.has("k_x") || map.has("k_y");
  if (of_edge && of_point) {
    reading.report.error(map.map(), "needs k_n and k_t, on an edge, or k_x and k_y, on a point, not both");
    return false;
  }
  if (!of_edge && !of_point) {
    if (map.all_known())
      reading.report.error(map.map(), "needs k_n or k_t, on an edge (N/m3), or k_x or k_y, on a point (N/m)");
    return false;
  }
  const char* keys[2] = {of_edge ? "k_n" : "k_x", of_edge ? "k_t" : "k_y"};
  // Springs act on no other places, which model/check_springs.cpp says.
  const bool on_edge =
                 place.place && (place.place->kind == Place::Kind::edge || place.place->kind == Place::Kind::face),
             on_point =
                 place.place && (place.place->kind == Place::Kind::corner || place.place->kind == Place::Kind::near ||
                                 place.place->kind == Place::Kind::mouth);
  for (std::size_t k = 0; k < 2; ++k) {
    if (of_edge ? on_point : on_edge)
      map.refuse(keys[k], of_edge ? "is the stiffness of an edge, which this place is not: give k_x and k_y, in N/m"
                                  : "is the stiffness of a corner or point, and this is none: on an edge give k_n and "
                                    "k_t, in N/m3");
    if (const auto value = map.get(keys[k])) spring.stiffness[k] = number_or_unread(reading, value);
  }
  return reading.report.count() == before;
}

/// `[normal, tangent]` on an edge, `[x, y]` on a point; null: none.
void read_at_rest(Reading& reading, const Value& value, Spring& spring) {
  if (value.node->kind != Node::Kind::sequence || value.node->items.size() != 2) {
    reading.report.error(
        value,
        fmt::format("must be [normal, tangent] on an edge, [x, y] on a point, with null for none, not {}",
                    value.node->kind == Node::Kind::sequence ? fmt::format("a list of {}", value.node->items.size())
                                                             : describe(*value.node)));
    return;
  }
  for (std::size_t k = 0; k < 2; ++k)
    if (value.node->items[k]->kind != Node::Kind::null)
      spring.at_rest[k] = read_number(reading.report, value.item(k)).value_or(unread);
}

/// What springs are at rest at acts as a load, to which steps give a factor.
void add_load_at_rest(Reading& reading, int index) {
  const Spring& spring = reading.model.springs[static_cast<std::size_t>(index)];
  if (spring.at_rest[0] == 0.0 && spring.at_rest[1] == 0.0) return;
  reading.load_names.push_back(spring.name);
  reading.index_of_load[spring.name] = static_cast<int>(reading.model.loads.size());
  reading.model.loads.push_back({spring.name, spring.on, AtRest{index}, spring.source});
}

std::optional<Spring> read_spring(Reading& reading, const Value& value, std::set<std::string>& own_names) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, value, {"on", "k_n", "k_t", "k_x", "k_y", "at_rest", "name"}, spring_example,
                      {{"k", "write k_n, along the normal of an edge, and k_t, along it"},
                       {"stiffness", "write k_n, along the normal of an edge, and k_t, along it"}});
  Spring spring;
  spring.source = value.source();
  if (const auto name = map.get("name")) {
    const auto text = read_text(report, *name);
    if (text && check_name(report, name->source(), *text)) {
      spring.name = *text;
      own_names.insert(*text);
    }
  }
  const auto on = map.need("on");
  if (!on) reading.places_known = false;
  const ReadPlace place = on ? read_place(reading, *on) : ReadPlace{};
  if (place.body >= 0) reading.state(place.body).held = true;
  if (!map.is_map() || !read_stiffness(reading, map, place, spring)) return {};
  if (const auto at_rest = map.get("at_rest")) {
    read_at_rest(reading, *at_rest, spring);
    if (!map.has("name"))
      map.refuse("at_rest", "needs a 'name' beside it, by which steps give it a factor, as in name: jack");
  }
  if (report.count() > before || !place.place) return {};
  spring.on = *place.place;
  return spring;
}

}  // namespace

void read_springs(Reading& reading, const Value& value) {
  const auto items = read_list(reading.report, value, "[{on: beam.bottom, k_n: 50e6}]");
  if (!items) reading.places_known = reading.conditions_known = false;
  std::set<std::string> taken;
  for (const Value& item : items.value_or(std::vector<Value>{})) {
    if (auto spring = read_spring(reading, item, taken))
      reading.model.springs.push_back(std::move(*spring));
    else
      reading.conditions_known = false;
  }
  // Without a name, that of the place, made unique.
  std::map<std::string, int> last;
  for (Spring& spring : reading.model.springs) {
    if (!spring.name.empty()) continue;
    std::string name = spring.on.text;
    int& k = last[name];
    for (k = std::max(k, 1); !taken.insert(name).second;) name = fmt::format("{} ({})", spring.on.text, ++k);
    spring.name = name;
  }
  for (std::size_t i = 0; i < reading.model.springs.size(); ++i) add_load_at_rest(reading, static_cast<int>(i));
}

}  // namespace scabo::input
