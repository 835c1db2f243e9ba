// `loads`.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/input/read_inner_loads.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr const char* load_example = "{on: upper.top_right, force: [0, -100e3]}";

const std::vector<std::string> load_keys = {"on",          "in",    "force",   "moment", "traction",
                                            "pressure",    "water", "gravity", "spin",   "body_force",
                                            "temperature", "field", "moving",  "enters"};

constexpr const char* table_example[2] = {"{at: [[0, 0], [0, 3]], values: [[1e3, 0], [0, 0]]}",
                                          "{at: [[0, 0], [0, 3]], values: [30e3, 0]}"};

/// Place of a point on an edge, as length from its start.
std::optional<double> read_place_on_edge(Reading& reading, const Value& value, const Edge& edge,
                                         const std::string& name) {
  const auto point = read_vector(reading.report, value);
  if (!point) return {};
  const double position = closest_position(edge, *point) * edge.length(), length = edge.length();
  const Vec2 foot = edge.at(std::clamp(position / length, 0.0, 1.0));
  const double distance = (foot - *point).norm();
  if (distance <= 1e-6 * length) return position;
  reading.report.error(
      value, fmt::format("is {:.3g} away from the edge {}: its nearest point is {}", distance, name, point_text(foot)));
  return {};
}

/// `{at, values}` or `{over, at, values}`: a traction or pressure that varies along an edge.
std::optional<EdgeTable> read_table(Reading& reading, const Value& value, const Place& place, bool pressure) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const char* example = table_example[pressure ? 1 : 0];
  const MapReader map(report, value, {"at", "over", "values"}, example,
                      {{"from", "write at: with two points or more"}, {"to", "write at: with two points or more"}});
  EdgeTable table;
  table.pressure = pressure;
  const auto over = map.get("over");
  if (over) {
    const auto choice = read_choice(report, *over, {"x", "y", "length"});
    if (choice)
      table.over = *choice == "x" ? EdgeTable::Over::x : *choice == "y" ? EdgeTable::Over::y : EdgeTable::Over::length;
  }
  const auto at = map.need("at"), values = map.need("values");
  const auto places = at ? read_list(report, *at, over ? "[0, 3]" : "[[0, 0], [0, 3]]") : std::nullopt;
  const auto given = values ? read_list(report, *values, pressure ? "[30e3, 0]" : "[[1e3, 0], [0, 0]]") : std::nullopt;
  if (report.count() > before || !places || !given) return {};
  if (places->size() != given->size()) {
    report.error(*values, fmt::format("has {} value{} for {} place{} of at: give one for each", given->size(),
                                      given->size() == 1 ? "" : "s", places->size(), places->size() == 1 ? "" : "s"));
    return {};
  }
  const Edge* edge = nullptr;
  if (!over) {
    if (place.kind != Place::Kind::edge) {
      report.error(value, fmt::format("points of at lie on an edge, but {} is none: name an edge", place.text));
      return {};
    }
    edge = &reading.body(place.body).outline.edges[static_cast<std::size_t>(place.index)];
  }
  for (std::size_t i = 0; i < places->size(); ++i) {
    const Value& item = (*places)[i];
    if (!over && item.node->kind == Node::Kind::scalar) {
      report.error(item, "must be a point [x, y] of the edge; for a table over numbers, add over: x, y or length");
      return {};
    }
    const auto position = edge ? read_place_on_edge(reading, item, *edge, place.text) : read_number(report, item);
    EdgeTable::Point point;
    if (pressure) {
      const auto number = read_number(report, (*given)[i]);
      point.value.x() = number.value_or(0.0);
    } else {
      point.value = read_vector(report, (*given)[i]).value_or(Vec2::Zero());
    }
    point.at = position.value_or(0.0);
    table.points.push_back(point);
  }
  if (report.count() > before) return {};
  // Points may be given in either direction of the edge.
  if (edge && table.points.size() > 1 && table.points.front().at > table.points.back().at)
    std::reverse(table.points.begin(), table.points.end());
  return table;
}

std::optional<Water> read_water(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"level", "unit_weight", "up"}, "{level: 30, unit_weight: 9.81e3}",
                      {{"density", "give unit_weight, density times the acceleration of gravity"},
                       {"height", "give level, a coordinate"}});
  Water water;
  water.level = number_or_unread(reading, map.need("level"));
  water.unit_weight = number_or_unread(reading, map.need("unit_weight"));
  if (const auto up = map.get("up"))
    if (const auto direction = read_vector(reading.report, *up))
      water.up = direction->norm() > 0.0 ? Vec2(direction->stableNormalized()) : Vec2(Vec2::Zero());
  if (reading.report.count() > before) return {};
  return water;
}

std::optional<decltype(Load::kind)> read_kind(Reading& reading, const Value& value, const std::string& kind,
                                              bool on_face, const std::optional<Place>& on) {
  if (kind == "water") return read_water(reading, value);
  if (kind == "moment") {
    const auto moment = read_number(reading.report, value);
    if (!moment) return {};
    return Moment{*moment};
  }
  if (kind == "body_force") return read_body_force(reading, value);
  if (kind == "temperature") return read_temperature(reading, value);
  if (kind == "field") return read_field(reading, value);
  if (on_face) return read_face_traction(reading, value, kind == "pressure");
  // Powers and points of xi, which only side faces take.
  const bool is_map = value.node->kind == Node::Kind::map;
  const auto names = [&](std::string_view key) {
    return std::any_of(value.node->entries.begin(), value.node->entries.end(),
                       [&](const MapEntry& entry) { return entry.key == key; });
  };
  if ((kind == "traction" || kind == "pressure") && is_map && on && !names("powers") && !names("points"))
    return read_table(reading, value, *on, kind == "pressure");
  if ((kind == "traction" || kind == "pressure") && is_map)
    return read_face_traction(reading, value, kind == "pressure");
  if (kind == "pressure" || kind == "spin") {
    const auto number = read_number(reading.report, value);
    if (!number) return {};
    if (kind == "spin") return Spin{*number};
    return Pressure{*number};
  }
  const auto vector = read_vector(reading.report, value);
  if (!vector) return {};
  if (kind == "force") return Force{*vector};
  if (kind == "traction") return Traction{*vector};
  return Gravity{*vector};
}

/// `{velocity: 20, from: 0}`.
Moving read_moving(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"velocity", "from"}, "{velocity: 20, from: 0}");
  Moving moving;
  moving.velocity = number_or_unread(reading, map.need("velocity"));
  if (const auto from = map.get("from")) moving.from = number_or_unread(reading, from);
  return moving;
}

/// `{in: joint, pressure: p}`, a table over x or y, or water.
std::optional<Load> read_load_in_contact(Reading& reading, const Entry& entry, const MapReader& map) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  for (const char* key :
       {"on", "force", "moment", "traction", "gravity", "spin", "body_force", "temperature", "field", "moving"})
    map.refuse(key, "does not go together with in: in contacts there are pressure and water");
  if (map.has("pressure") == map.has("water")) {
    if (report.count() == before && map.all_known())
      report.error(entry.key_source, "in a contact needs pressure or water, one of the two");
    return {};
  }
  PorePressure pores;
  if (const auto enters = map.get("enters")) pores.enters = read_flag(report, *enters).value_or(false);
  if (map.has("water")) {
    if (const auto water = read_water(reading, *map.get("water"))) pores.value = *water;
  } else if (const Value value = *map.get("pressure"); value.node->kind != Node::Kind::map) {
    pores.value = number_or_unread(reading, value);
  } else if (const auto over = MapReader(report, value, {"at", "over", "values"}, table_example[1]).get("over");
             !over || over->node->text == "length") {
    report.error(value, "in a contact a table is over numbers: add over: x or over: y");
  } else if (const auto table = read_table(reading, value, {}, true)) {
    pores.value = *table;
  }
  if (report.count() > before) return {};
  Load load;
  load.name = entry.key;
  load.source = entry.key_source;
  load.kind = std::move(pores);
  return load;
}

std::optional<Load> read_load(Reading& reading, const Entry& entry) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, entry.value, load_keys, load_example);
  if (!map.is_map()) return {};
  if (map.has("in")) return read_load_in_contact(reading, entry, map);
  map.refuse("enters", "is of a pressure in a contact: give the contact with 'in', or leave it out");
  Load load;
  load.name = entry.key;
  load.source = entry.key_source;
  std::vector<std::string> kinds;
  for (const char* kind :
       {"force", "moment", "traction", "pressure", "water", "gravity", "spin", "body_force", "temperature", "field"}) {
    if (map.has(kind)) kinds.emplace_back(kind);
  }
  if (kinds.size() > 1) {
    report.error(entry.key_source,
                 fmt::format("needs exactly one of force, moment, traction, pressure, water, gravity, "
                             "spin, body_force, temperature and field, not both {} and "
                             "{}",
                             kinds[0], kinds[1]));
    return {};
  }
  if (kinds.empty()) {
    if (report.count() == before)
      report.error(entry.key_source,
                   "needs exactly one of force, moment, traction, pressure, water, gravity, spin, body_force, "
                   "temperature and field");
    return {};
  }
  const std::string& kind = kinds.front();
  const bool of_all = kind == "gravity" || kind == "spin" || kind == "temperature" || kind == "field";
  const auto on = of_all ? map.get("on") : map.need("on");
  if (on) {
    load.on = read_place(reading, *on).place;
  }
  const bool on_face = load.on && load.on->kind == Place::Kind::face && (kind == "traction" || kind == "pressure") &&
                       !has_divided_faces(reading.body(load.on->body));
  // A map cannot be read if the place is not known: it may contain powers of xi or coefficients of x and y.
  const bool value_known = !on || load.on || map.get(kind)->node->kind != Node::Kind::map;
  const auto value = value_known ? read_kind(reading, *map.get(kind), kind, on_face, load.on) : std::nullopt;
  if (on && !load.on) return {};
  if (report.count() > before || !value) return {};
  load.kind = *value;
  if (const auto moving = map.get("moving")) load.moving = read_moving(reading, *moving);
  if (report.count() > before) return {};
  return load;
}

}  // namespace

void read_loads(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  // A load on an unknown body gives no information about which bodies are held.
  const bool places_known = reading.places_known;
  for (const Entry& entry :
       read_named(reading.report, value, "loads", "{tip: {on: upper.top_right, force: [0, -100e3]}}")) {
    reading.load_names.push_back(entry.key);
    int& index = reading.index_of_load[entry.key] = -1;
    if (reading.own_support_names.contains(entry.key)) {
      reading.report.error(entry.key_source, named_like_a_support(entry.key));
    }
    if (auto load = read_load(reading, entry)) {
      index = static_cast<int>(reading.model.loads.size());
      if (std::holds_alternative<PorePressure>(load->kind))
        reading.loads_in_contacts.emplace_back(
            reading.model.loads.size(), *MapReader(reading.report, entry.value, load_keys, load_example).get("in"));
      reading.model.loads.push_back(std::move(*load));
    } else {
      reading.conditions_known = false;
    }
  }
  if (reading.report.count() > before) reading.conditions_known = false;
  reading.places_known = places_known;
}

void find_contacts_of_loads(Reading& reading) {
  for (const auto& [index, value] : reading.loads_in_contacts) {
    const auto name = read_text(reading.report, value);
    if (!name) continue;
    auto& pores = std::get<PorePressure>(reading.model.loads[index].kind);
    if (const auto entry = reading.contacts_of_entry.find(*name); entry != reading.contacts_of_entry.end())
      pores.contacts = entry->second;
    const auto& contacts = reading.model.contacts;
    for (std::size_t c = 0; c < contacts.size() && pores.contacts.empty(); ++c)
      if (contacts[c].name == *name) pores.contacts = {static_cast<int>(c)};
    if (!pores.contacts.empty() || !reading.conditions_known) continue;
    std::vector<std::string> known;
    for (const Contact& contact : contacts) known.push_back(contact.name);
    reading.report.error(value, fmt::format("there is no contact '{}'{}", *name, suggestion(*name, known)));
    reading.conditions_known = false;
  }
}

}  // namespace scabo::input
