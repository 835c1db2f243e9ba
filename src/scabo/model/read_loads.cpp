// `loads`.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scabo/model/reading.hpp"

namespace scabo::model {

namespace {

constexpr const char* load_example = "{on: upper.top_right, force: [0, -100e3]}";

const char* kind_text(Place::Kind kind) {
  switch (kind) {
    case Place::Kind::body:
      return "a whole body";
    case Place::Kind::edge:
      return "an edge";
    case Place::Kind::corner:
      return "a corner";
    case Place::Kind::near:
      return "a point";
  }
  return "";
}

/// Whether a load of this kind can act on a place; reports what to write instead.
bool check_place(Reading& reading, const Value& on, const Place& place, const std::string& kind) {
  const bool rigid = reading.body(place.body).rigid;
  const std::string& body = reading.body(place.body).name;
  std::string why;
  if (kind == "gravity") {
    if (place.kind != Place::Kind::body) {
      why = fmt::format("gravity acts on a whole body: write on: {}", body);
    } else if (rigid) {
      why = fmt::format("'{}' is rigid and has no weight: use a force on it", body);
    }
  } else if (kind == "force") {
    if (rigid && place.kind == Place::Kind::edge) {
      why = fmt::format("'{}' is rigid: put the force on the body or on a corner", body);
    } else if (!rigid && place.kind == Place::Kind::body) {
      why = "a force acts on a corner, a point or an edge of an elastic body: name one, or use gravity";
    }
  } else if (rigid) {
    why = fmt::format("'{}' is rigid: put a force on the body instead", body);
  } else if (place.kind != Place::Kind::edge) {
    why = fmt::format("{} acts on an edge, and this is {}", kind, kind_text(place.kind));
  }
  if (why.empty()) return true;
  reading.report.error(on, why);
  return false;
}

std::optional<std::variant<Force, Traction, Pressure, Gravity>> read_kind(Reading& reading,
                                                                          const Value& value,
                                                                          const std::string& kind) {
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
  const MapReader map(
      report, entry.value, {"on", "force", "traction", "pressure", "gravity"}, load_example,
      {{"moment", "use two opposite forces"}, {"temperature", "leave it out, loads are mechanical"}});
  if (!map.is_map()) return {};
  Load load;
  load.name = entry.key;
  load.source = entry.key_source;
  std::vector<std::string> kinds;
  for (const char* kind : {"force", "traction", "pressure", "gravity"}) {
    if (map.has(kind)) kinds.emplace_back(kind);
  }
  if (kinds.size() > 1) {
    report.error(entry.key_source,
                 fmt::format("needs one of force, traction, pressure and gravity, not both {} and {}",
                             kinds[0], kinds[1]));
    return {};
  }
  if (kinds.empty()) {
    if (report.count() == before)
      report.error(entry.key_source, "needs one of force, traction, pressure and gravity");
    return {};
  }
  const std::string& kind = kinds.front();
  const auto value = read_kind(reading, *map.get(kind), kind);
  const auto on = kind == "gravity" ? map.get("on") : map.need("on");
  if (on) {
    const auto place = read_place(reading, *on).place;
    if (place && check_place(reading, *on, *place, kind)) load.on = place;
    if (!load.on) return {};
  }
  if (report.count() > before || !value) return {};
  load.kind = *value;
  return load;
}

}  // namespace

void read_loads(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  // A load on an unknown body says nothing about which bodies are held.
  const bool places_known = reading.places_known;
  for (const Entry& entry :
       read_named(reading.report, value, "loads", "{tip: {on: upper.top_right, force: [0, -100e3]}}")) {
    reading.load_names.push_back(entry.key);
    if (reading.own_support_names.contains(entry.key)) {
      reading.report.error(
          entry.key_source,
          fmt::format("a support is named '{}' as well: steps could mean either", entry.key));
    }
    if (auto load = read_load(reading, entry)) {
      reading.model.loads.push_back(std::move(*load));
    } else {
      reading.conditions_known = false;
    }
  }
  if (reading.report.count() > before) reading.conditions_known = false;
  reading.places_known = places_known;
}

namespace {

/// A body without mass has no frequencies.
void check_density_of_modal_analysis(Reading& reading) {
  std::set<int> told;
  for (const Body& body : reading.model.bodies) {
    if (body.material < 0) continue;
    const Material& material = reading.model.materials[static_cast<std::size_t>(body.material)];
    if (material.density.value_or(0.0) > 0.0 || !told.insert(body.material).second) continue;
    reading.report.error(material.source,
                         fmt::format("'density' {}: a modal analysis needs the mass of body '{}'",
                                     material.density ? "is 0" : "is missing", body.name));
  }
}

}  // namespace

void check_density(Reading& reading) {
  if (reading.model.analysis.type == AnalysisType::modal) {
    check_density_of_modal_analysis(reading);
    return;
  }
  for (const Load& load : reading.model.loads) {
    if (!std::holds_alternative<Gravity>(load.kind)) continue;
    std::set<int> told;
    for (std::size_t i = 0; i < reading.model.bodies.size(); ++i) {
      const Body& body = reading.model.bodies[i];
      if (body.material < 0 || (load.on && load.on->body != static_cast<int>(i))) continue;
      const Material& material = reading.model.materials[static_cast<std::size_t>(body.material)];
      if (material.density || !told.insert(body.material).second) continue;
      reading.report.error(
          material.source,
          fmt::format("'density' is missing: gravity of load '{}' acts on body '{}'", load.name, body.name));
    }
  }
}

}  // namespace scabo::model
