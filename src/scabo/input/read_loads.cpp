// `loads`.
#include <fmt/format.h>

#include "scabo/input/read_inner_loads.hpp"

namespace scabo::input {

namespace {

constexpr const char* load_example = "{on: upper.top_right, force: [0, -100e3]}";

std::optional<decltype(Load::kind)> read_kind(Reading& reading, const Value& value, const std::string& kind,
                                              bool on_face) {
  if (kind == "body_force") return read_body_force(reading, value);
  if (kind == "temperature") return read_temperature(reading, value);
  if (on_face) return read_face_traction(reading, value, kind == "pressure");
  // Powers and points of xi, which only side faces take.
  if ((kind == "traction" || kind == "pressure") && value.node->kind == Node::Kind::map)
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
                      {"on", "force", "traction", "pressure", "gravity", "body_force", "temperature"}, load_example,
                      {{"moment", "use two opposite forces"}});
  if (!map.is_map()) return {};
  Load load;
  load.name = entry.key;
  load.source = entry.key_source;
  std::vector<std::string> kinds;
  for (const char* kind : {"force", "traction", "pressure", "gravity", "body_force", "temperature"}) {
    if (map.has(kind)) kinds.emplace_back(kind);
  }
  if (kinds.size() > 1) {
    report.error(
        entry.key_source,
        fmt::format(
            "needs exactly one of force, traction, pressure, gravity, body_force and temperature, not both {} and {}",
            kinds[0], kinds[1]));
    return {};
  }
  if (kinds.empty()) {
    if (report.count() == before)
      report.error(entry.key_source,
                   "needs exactly one of force, traction, pressure, gravity, body_force and temperature");
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
  const auto value = value_known ? read_kind(reading, *map.get(kind), kind, on_face) : std::nullopt;
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
