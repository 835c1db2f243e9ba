// `loads`.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/geometry/foot_points.hpp"
#include "scabo/input/read_inner_loads.hpp"

namespace scabo::input {

namespace {

constexpr const char* load_example = "{on: upper.top_right, force: [0, -100e3]}";

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
  if (kind == "body_force") return read_body_force(reading, value);
  if (kind == "temperature") return read_temperature(reading, value);
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
  if (kind == "pressure") {
    const auto pressure = read_number(reading.report, value);
    if (!pressure) return {};
    return Pressure{*pressure};
  }
  const auto vector = read_vector(reading.report, value);
  if (!vector) return {};
  if (kind == "force") return Force{*vector};
  if (kind == "traction") return Traction{*vector};
  return Gravity{*vector};
}

std::optional<Load> read_load(Reading& reading, const Entry& entry) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, entry.value,
                      {"on", "force", "traction", "pressure", "water", "gravity", "body_force", "temperature"},
                      load_example, {{"moment", "use two opposite forces"}});
  if (!map.is_map()) return {};
  Load load;
  load.name = entry.key;
  load.source = entry.key_source;
  std::vector<std::string> kinds;
  for (const char* kind : {"force", "traction", "pressure", "water", "gravity", "body_force", "temperature"}) {
    if (map.has(kind)) kinds.emplace_back(kind);
  }
  if (kinds.size() > 1) {
    report.error(entry.key_source, fmt::format("needs exactly one of force, traction, pressure, water, gravity, "
                                               "body_force and temperature, not both {} and "
                                               "{}",
                                               kinds[0], kinds[1]));
    return {};
  }
  if (kinds.empty()) {
    if (report.count() == before)
      report.error(entry.key_source,
                   "needs exactly one of force, traction, pressure, water, gravity, body_force and temperature");
    return {};
  }
  const std::string& kind = kinds.front();
  const auto on = kind == "gravity" || kind == "temperature" ? map.get("on") : map.need("on");
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
      reading.model.loads.push_back(std::move(*load));
    } else {
      reading.conditions_known = false;
    }
  }
  if (reading.report.count() > before) reading.conditions_known = false;
  reading.places_known = places_known;
}

}  // namespace scabo::input
