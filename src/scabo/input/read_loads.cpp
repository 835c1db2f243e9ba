// `loads`.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scabo/input/read_inner_loads.hpp"

namespace scabo::input {

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
    case Place::Kind::mouth:
      return "a point";
    case Place::Kind::face:
      return "a side face";
  }
  return "";
}

/// Whether a load of this kind can act on a place; otherwise reports an alternative.
bool check_place(Reading& reading, const Value& on, const Place& place, const std::string& kind) {
  const bool rigid = reading.body(place.body).rigid;
  const std::string& body = reading.body(place.body).name;
  const bool outside = reading.body(place.body).outside;
  std::string why;
  if (kind == "gravity" || kind == "body_force" || kind == "temperature") {
    if (place.kind != Place::Kind::body) {
      why = fmt::format("{} acts on a whole body: write on: {}", kind, body);
    } else if (rigid) {
      why = fmt::format(
          "'{}' is rigid: {}", body,
          kind == "temperature" ? "temperature has no effect on it" : "it has no weight; apply a force to it instead");
    } else if (outside) {
      why = fmt::format("'{}' is unbounded: loads can act only on its boundary", body);
    }
  } else if (place.kind == Place::Kind::face && outside) {
    why = fmt::format("'{}' is unbounded: loads can act only on its inner boundary, not on its side faces", body);
  } else if (place.kind == Place::Kind::face && kind == "force") {
    why = "a force cannot act on a side face: use a traction, which is the force divided by length and thickness";
  } else if (place.kind == Place::Kind::face) {
  } else if (kind == "force") {
    if (rigid && place.kind == Place::Kind::edge) {
      why = fmt::format("'{}' is rigid: apply the force to the body or to a corner", body);
    } else if (!rigid && place.kind == Place::Kind::body) {
      why = "a force on an elastic body acts on a corner, a point or an edge: name one of these, or use gravity";
    }
  } else if (rigid) {
    why = fmt::format("'{}' is rigid: apply a force to the body instead", body);
  } else if (place.kind != Place::Kind::edge) {
    why = fmt::format("{} acts on an edge, but this is {}: name an edge", kind, kind_text(place.kind));
  }
  if (why.empty()) return true;
  reading.report.error(on, why);
  return false;
}

std::optional<decltype(Load::kind)> read_kind(Reading& reading, const Value& value, const std::string& kind,
                                              bool on_face) {
  if (kind == "body_force") return read_body_force(reading, value);
  if (kind == "temperature") return read_temperature(reading, value);
  if (on_face) return read_face_traction(reading, value, kind == "pressure");
  if ((kind == "traction" || kind == "pressure") && value.node->kind == Node::Kind::map) {
    reading.report.error(
        value,
        fmt::format("powers and points of xi are available only on side faces: on an edge, give a constant {}", kind));
    return {};
  }
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
    const auto place = read_place(reading, *on).place;
    if (place && check_place(reading, *on, *place, kind)) load.on = place;
  }
  const bool on_face = load.on && load.on->kind == Place::Kind::face;
  // A map cannot be read if the place is not known: it may contain powers of xi or coefficients of x and y.
  const bool value_known = !on || load.on || map.get(kind)->node->kind != Node::Kind::map;
  const auto value = value_known ? read_kind(reading, *map.get(kind), kind, on_face) : std::nullopt;
  if (on && !load.on) return {};
  if (report.count() > before || !value) return {};
  load.kind = *value;
  return load;
}

/// Indices of the materials of a body, without -1 for broken ones.
std::set<int> materials_of(const Body& body) {
  std::set<int> materials(body.sector_materials.begin(), body.sector_materials.end());
  if (materials.empty()) materials.insert(body.material);
  materials.erase(-1);
  return materials;
}

/// First and last + 1 of the bodies on which a load on whole bodies acts.
std::pair<std::size_t, std::size_t> bodies_under(const Reading& reading, const Load& load) {
  if (!load.on) return {0, reading.model.bodies.size()};
  const auto body = static_cast<std::size_t>(load.on->body);
  return {body, body + 1};
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
      reading.report.error(
          entry.key_source,
          fmt::format("a support is also named '{}', and a step could mean either: rename one of them", entry.key));
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

void check_expansion(Reading& reading) {
  std::set<int> told;
  for (const Load& load : reading.model.loads) {
    if (!std::holds_alternative<Temperature>(load.kind)) continue;
    const auto [first, last] = bodies_under(reading, load);
    for (std::size_t i = first; i < last; ++i) {
      const Body& body = reading.model.bodies[i];
      if (body.material < 0 || body.outside) continue;
      for (const int index : materials_of(body)) {
        const Material& material = reading.model.materials[static_cast<std::size_t>(index)];
        if (material.expansion || !told.insert(index).second) continue;
        reading.report.error(
            material.source,
            fmt::format("'expansion' is missing: temperature of load '{}' acts on body '{}'", load.name, body.name));
      }
    }
  }
}

namespace {

/// A body without mass has no frequencies.
void check_density_of_modal_analysis(Reading& reading) {
  std::set<int> told;
  for (const Body& body : reading.model.bodies) {
    if (body.outside)
      reading.report.error(body.source,
                           "an unbounded body has no natural frequencies: leave it out of a modal analysis");
    if (body.material < 0 || body.outside) continue;
    for (const int index : materials_of(body)) {
      const Material& material = reading.model.materials[static_cast<std::size_t>(index)];
      if (material.density.value_or(0.0) > 0.0 || !told.insert(index).second) continue;
      reading.report.error(material.source, fmt::format("'density' {}: a modal analysis needs the mass of body '{}'",
                                                        material.density ? "is 0" : "is missing", body.name));
    }
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
    const auto [first, last] = bodies_under(reading, load);
    for (std::size_t i = first; i < last; ++i) {
      const Body& body = reading.model.bodies[i];
      if (body.material < 0 || body.outside) continue;
      for (const int index : materials_of(body)) {
        const Material& material = reading.model.materials[static_cast<std::size_t>(index)];
        if (material.density || !told.insert(index).second) continue;
        reading.report.error(
            material.source,
            fmt::format("'density' is missing: gravity of load '{}' acts on body '{}'", load.name, body.name));
      }
    }
  }
}

}  // namespace scabo::input
