// Validation of loads: finite values, and places on which loads of their kind can act.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "scabo/geometry/box.hpp"
#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

constexpr double highest_power = 100.0;

template <typename... Functions>
struct Cases : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Cases(Functions...) -> Cases<Functions...>;

/// The key of a load in a model file.
const char* key_of(const Load& load) {
  return std::visit(Cases{[](const Force&) { return "force"; }, [](const Traction&) { return "traction"; },
                          [](const Pressure&) { return "pressure"; }, [](const Gravity&) { return "gravity"; },
                          [](const Spin&) { return "spin"; }, [](const BodyForce&) { return "body_force"; },
                          [](const Temperature&) { return "temperature"; },
                          [](const FaceTraction& face) { return face.pressure ? "pressure" : "traction"; },
                          [](const EdgeTable& table) { return table.pressure ? "pressure" : "traction"; },
                          [](const Water&) { return "water"; }, [](const UniformStress&) { return "field"; },
                          [](const GroundStress&) { return "field"; }, [](const Moment&) { return "moment"; },
                          [](const AtRest&) { return "at_rest"; },
                          [](const PorePressure& pores) {
                            return std::holds_alternative<Water>(pores.value) ? "water" : "pressure";
                          }},
                    load.kind);
}

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
      return "a face of a crack";
  }
  return "";
}

bool is_straight(const Edge& edge) {
  const Vec2 along = (edge.end - edge.start).normalized();
  if (edge.arc || (edge.end - edge.start).norm() == 0.0) return false;
  for (int i = 1; i < edge.segments(); ++i)
    if (std::abs(cross(along, edge.chain_point(i) - edge.start)) > 1e-9 * edge.length()) return false;
  return true;
}

/// Why a load of this kind cannot act on a place, and an alternative; empty if it can.
std::string why_not_on(const Body& of, const Place& place, const std::string& kind) {
  const std::string& body = of.name;
  if (kind == "field") {
    if (place.kind != Place::Kind::body) return fmt::format("a field acts on a whole body: write on: {}", body);
    return of.rigid ? fmt::format("'{}' is rigid: it has no stress", body) : "";
  }
  if (kind == "moment") {
    if (of.rigid) return place.kind == Place::Kind::body ? "" : fmt::format("'{0}' is rigid: write on: {0}", body);
    const auto takes_moment = [](const Edge& edge) { return edge.arc || is_straight(edge); };
    return place.kind == Place::Kind::edge && takes_moment(of.outline.edges[static_cast<std::size_t>(place.index)])
               ? ""
               : "a moment on an elastic body acts on a straight edge, as a linear traction along its normal, or on an "
                 "arc, as a torque: name one, or give two opposite forces";
  }
  if (kind == "gravity" || kind == "spin" || kind == "body_force" || kind == "temperature") {
    if (place.kind != Place::Kind::body) return fmt::format("{} acts on a whole body: write on: {}", kind, body);
    if (of.rigid && kind == "temperature") return fmt::format("'{}' is rigid: temperature has no effect on it", body);
    if (of.rigid && kind == "body_force") return fmt::format("'{}' is rigid: apply a force to it instead", body);
    if (of.rigid && !of.density) return fmt::format("'{}' has no weight: give it a 'density'", body);
    if (of.outside) return fmt::format("'{}' is unbounded: loads can act only on its boundary", body);
    return "";
  }
  if (place.kind == Place::Kind::face) {
    if (of.outside)
      return fmt::format("'{}' is unbounded: loads can act only on its inner boundary, not on its side faces", body);
    if (kind == "force")
      return fmt::format(
          "a force cannot act on a {}: use a traction, which is the force divided by length and thickness",
          has_divided_faces(of) ? "face of a crack" : "side face");
    return "";
  }
  if (kind == "force") {
    if (of.rigid && place.kind == Place::Kind::edge)
      return fmt::format("'{}' is rigid: apply the force to the body or to a corner", body);
    if (!of.rigid && place.kind == Place::Kind::body)
      return "a force on an elastic body acts on a corner, a point or an edge: name one of these, or use gravity";
    return "";
  }
  if (place.kind != Place::Kind::edge)
    return fmt::format("{} acts on an edge, but this is {}: name an edge", kind, kind_text(place.kind));
  return "";
}

bool check_terms(Checking& checking, const std::string& path, const std::string& kind, const FaceTraction& face) {
  if (face.terms.empty()) {
    checking.error(
        path, kind,
        fmt::format("must be powers of xi, as in {{0: {0}, 1: {0}}}, not none", face.pressure ? "1e3" : "[0, -1e3]"));
    return false;
  }
  for (std::size_t i = 0; i < face.terms.size(); ++i) {
    const FaceTraction::Term& term = face.terms[i];
    const std::string key = fmt::format("{}.powers.{}", kind, number_text(term.power));
    if (!(term.power > -1.0 && term.power <= highest_power)) {
      checking.error_of_key(path, key,
                            fmt::format("a power of xi must be greater than -1 (otherwise the total force is infinite) "
                                        "and at most {}, not {}",
                                        highest_power, number_text(term.power)));
      checking.found.back().given = number_text(term.power);
      return false;
    }
    const auto same = [&](const FaceTraction::Term& other) { return other.power == term.power; };
    if (std::any_of(face.terms.begin(), face.terms.begin() + static_cast<std::ptrdiff_t>(i), same)) {
      checking.error_of_key(path, key,
                            fmt::format("the power {} is given twice: remove one of the two", number_text(term.power)));
      return false;
    }
    if (!checking.vector(path, key, term.value)) return false;
  }
  return true;
}

bool check_linear(Checking& checking, const std::string& path, const std::string& kind, const Linear& linear) {
  return checking.number(path, kind + ".constant", linear.constant) &&
         checking.number(path, kind + ".x", linear.per_x) && checking.number(path, kind + ".y", linear.per_y);
}

bool check_temperatures(Checking& checking, const std::string& path, const TemperatureTable& table) {
  constexpr std::size_t most_points = 10000;
  const std::size_t count = table.points.size();
  if (count < 2 || count > most_points) {
    checking.error(path, "temperature.at",
                   count < 2 ? fmt::format("needs two or more places, not {}", count)
                             : fmt::format("must have at most {} places, not {}: leave out those between which the "
                                           "temperature is nearly linear",
                                           most_points, count));
    return false;
  }
  if (table.centre && !checking.vector(path, "temperature.centre", *table.centre)) return false;
  if (table.centre && table.points.front().at < 0.0) {
    checking.error(path, "temperature.at.0", "must be 0 or more: it is a distance from 'centre'");
    return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!checking.number(path, fmt::format("temperature.at.{}", i), table.points[i].at) ||
        !checking.number(path, fmt::format("temperature.values.{}", i), table.points[i].change))
      return false;
    if (i == 0 || table.points[i].at > table.points[i - 1].at) continue;
    checking.error(
        path, fmt::format("temperature.at.{}", i),
        fmt::format("must be greater than the place before it, {}: give places in ascending order, each once",
                    number_text(table.points[i - 1].at)));
    return false;
  }
  if (std::abs(table.along.norm() - 1.0) <= 1e-9) return true;
  checking.error(path, "temperature", "has a direction that is no unit vector");
  return false;
}

/// One super-element takes a table inside if it has one material and no side faces
/// (element/facet/temperature_table.hpp); of
/// a cell among others, the nearest linear field is good enough.
void check_linear_in_bodies(Checking& checking, const std::string& path, const Load& load,
                            const TemperatureTable& table) {
  for (std::size_t b = 0; b < checking.model.bodies.size(); ++b) {
    const Body& body = checking.model.bodies[b];
    if (body.rigid || body.outside || (load.on && load.on->body != static_cast<int>(b))) continue;
    if (!checking.sound_shape(static_cast<int>(b))) continue;
    const bool one = body.mesh.kind == MeshKind::superelement,
               large = one || (body.mesh.kind == MeshKind::parts && !body.cracks.empty());
    if (table.centre && (one || body.mesh.kind == MeshKind::parts) && !table.is_constant()) {
      checking.error(path, "temperature",
                     fmt::format("changes with the radius inside body '{}', which consists of too few super-elements "
                                 "for that: give the body a mesh of kind polygons, quadtree or fem",
                                 body.name));
      return;
    }
    const bool several = std::any_of(body.sector_materials.begin(), body.sector_materials.end(),
                                     [&](int material) { return material != body.sector_materials.front(); });
    if (!large || !(body.open() || several || !body.cracks.empty() || (one && !body.regions.empty())) ||
        is_linear_over(table, body.outline))
      continue;
    checking.error(path, "temperature",
                   fmt::format("changes its slope inside body '{}', a super-element with {}, which takes only a linear "
                               "temperature: give the body a mesh of kind polygons, quadtree or fem",
                               body.name, several || !body.regions.empty() ? "several materials" : "side faces"));
    return;
  }
}

bool check_table(Checking& checking, const std::string& path, const std::string& kind, const EdgeTable& table) {
  if (table.points.size() < 2) {
    checking.error(path, kind + ".at", fmt::format("needs two or more places, not {}", table.points.size()));
    return false;
  }
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const EdgeTable::Point& point = table.points[i];
    if (!checking.number(path, fmt::format("{}.at.{}", kind, i), point.at) ||
        !checking.vector(path, fmt::format("{}.values.{}", kind, i), point.value))
      return false;
    if (i > 0 && point.at < table.points[i - 1].at) {
      checking.error(path, fmt::format("{}.at.{}", kind, i),
                     fmt::format("is smaller than the place before it, {}: give places in ascending order",
                                 number_text(table.points[i - 1].at)));
      return false;
    }
    if (i > 1 && point.at == table.points[i - 2].at) {
      checking.error(path, fmt::format("{}.at.{}", kind, i),
                     "is the third value at one place: two make a jump, leave out the others");
      return false;
    }
  }
  if (table.points.front().at == table.points.back().at) {
    checking.error(path, kind + ".at", "has all its places at one point, where no load can act: spread them");
    return false;
  }
  return true;
}

bool check_water(Checking& checking, const std::string& path, const Water& water) {
  if (!checking.number(path, "water.level", water.level) ||
      !checking.positive(path, "water.unit_weight", water.unit_weight))
    return false;
  if (std::abs(water.up.norm() - 1.0) <= 1e-9) return true;
  checking.error(path, "water.up",
                 "must not be [0, 0]: it is the direction in which the depth decreases, as in [0, 1]");
  return false;
}

bool check_uniform(Checking& checking, const std::string& path, const UniformStress& stress) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!checking.number(path, fmt::format("field.stress.{}", i), stress.value[i])) return false;
  if (!stress.zz) return true;
  if (!checking.number(path, "field.szz", *stress.zz)) return false;
  if (checking.model.analysis.plane == Plane::strain) return true;
  checking.error(path, "field.szz", "there is no stress out of the plane in plane stress: leave it out");
  return false;
}

bool check_ground(Checking& checking, const std::string& path, const GroundStress& ground,
                  const std::optional<Place>& on) {
  if (!checking.positive(path, "field.vertical.unit_weight", ground.unit_weight) ||
      !checking.number(path, "field.vertical.surface", ground.surface) ||
      !checking.not_negative(path, "field.vertical.surcharge", ground.surcharge) ||
      !checking.not_negative(path, "field.K0", ground.K0))
    return false;
  if (std::abs(ground.up.norm() - 1.0) > 1e-9) {
    checking.error(path, "field.vertical.up",
                   "must not be [0, 0]: it is the direction in which the depth decreases, as in [0, 1]");
    return false;
  }
  for (std::size_t b = 0; b < checking.model.bodies.size(); ++b) {
    const Body& body = checking.model.bodies[b];
    if (on ? on->body != static_cast<int>(b) : body.rigid) continue;
    if (!checking.sound_shape(static_cast<int>(b))) continue;
    double highest = -HUGE_VAL;
    for (const Edge& edge : body.outline.edges)
      for (const double t : {0.0, 0.25, 0.5, 0.75}) highest = std::max(highest, ground.up.dot(edge.at(t)));
    if (highest <= ground.surface + 1e-6 * geometry::outline_size(body.outline)) continue;
    checking.error(path, "field.vertical.surface",
                   fmt::format("body '{}' reaches to {:.6g}, above the surface at {}: raise the surface, or name the "
                               "bodies below it by 'on'",
                               body.name, highest, number_text(ground.surface)));
    return false;
  }
  return true;
}

bool check_values(Checking& checking, const std::string& path, const Load& load) {
  const std::string kind = key_of(load);
  const auto of_vector = [&](const auto& with) { return checking.vector(path, kind, with.value); };
  return std::visit(Cases{[&](const Force& force) { return of_vector(force); },
                          [&](const Traction& traction) { return of_vector(traction); },
                          [&](const Gravity& gravity) { return of_vector(gravity); },
                          [&](const Spin& spin) { return checking.number(path, kind, spin.value); },
                          [&](const Pressure& pressure) { return checking.number(path, kind, pressure.value); },
                          [&](const FaceTraction& face) { return check_terms(checking, path, kind, face); },
                          [&](const BodyForce& force) {
                            return check_linear(checking, path, kind, force.x) &&
                                   check_linear(checking, path, kind, force.y);
                          },
                          [&](const Temperature& temperature) {
                            return temperature.table ? check_temperatures(checking, path, *temperature.table)
                                                     : check_linear(checking, path, kind, temperature.change);
                          },
                          [&](const EdgeTable& table) { return check_table(checking, path, kind, table); },
                          [&](const Water& water) { return check_water(checking, path, water); },
                          [&](const UniformStress& stress) { return check_uniform(checking, path, stress); },
                          [&](const Moment& moment) { return checking.number(path, kind, moment.value); },
                          [](const AtRest&) { return true; },  // with its springs
                          [&](const PorePressure& pores) {
                            if (const auto* table = std::get_if<EdgeTable>(&pores.value))
                              return check_table(checking, path, kind, *table);
                            if (const auto* water = std::get_if<Water>(&pores.value))
                              return check_water(checking, path, *water);
                            return checking.number(path, kind, std::get<double>(pores.value));
                          },
                          [&](const GroundStress& ground) { return check_ground(checking, path, ground, load.on); }},
                    load.kind);
}

/// Whether a load acts where loads of its kind can.
bool check_on(Checking& checking, const std::string& path, const Load& load) {
  const std::string kind = key_of(load);
  if (const auto* at_rest = std::get_if<AtRest>(&load.kind)) {
    const auto count = static_cast<int>(checking.model.springs.size());
    if (at_rest->spring >= 0 && at_rest->spring < count && load.on &&
        load.on->body == checking.model.springs[static_cast<std::size_t>(at_rest->spring)].on.body)
      return true;
    if (!checking.gaps.conditions) checking.error(path, kind, "is of no springs of the model, or of another body");
    return false;
  }
  if (const auto* pores = std::get_if<PorePressure>(&load.kind)) {
    const auto count = static_cast<int>(checking.model.contacts.size());
    const bool known = std::all_of(pores->contacts.begin(), pores->contacts.end(),
                                   [&](int contact) { return contact >= 0 && contact < count; });
    if (known && !pores->contacts.empty()) return true;
    if (!checking.gaps.conditions) checking.error(path, "in", "names no contact of the model");
    return false;
  }
  if (!load.on) {
    if (kind == "gravity" || kind == "spin" || kind == "temperature" || kind == "field") return true;
    checking.error(path, "", "'on' is missing");
    return false;
  }
  const Place& place = *load.on;
  if (!check_place(checking, path + ".on", place)) return false;
  const bool at_a_point = load.moving && kind == "force";  // which moves where a traction may act
  if (const std::string why = why_not_on(checking.body(place.body), place, at_a_point ? "traction" : kind);
      !why.empty()) {
    checking.error(path, "on", why);
    return false;
  }
  const bool in_powers = std::holds_alternative<FaceTraction>(load.kind);
  const bool divided = place.kind == Place::Kind::face && has_divided_faces(checking.body(place.body));
  if (in_powers && (place.kind == Place::Kind::edge || divided)) {
    checking.error(path, kind,
                   fmt::format("powers and points of xi are available only on side faces{}: on {}, give a constant {}",
                               divided ? " of a body that is one super-element" : "",
                               divided ? "the face of a crack between cells" : "an edge", kind));
    return false;
  }
  const bool on_edges = std::holds_alternative<EdgeTable>(load.kind) || std::holds_alternative<Water>(load.kind);
  if (on_edges && place.kind == Place::Kind::face) {
    checking.error(
        path, kind,
        fmt::format("{} acts on edges: on {}", kind == "water" ? "water" : fmt::format("a {} at places", kind),
                    divided ? "the face of a crack, give a constant pressure or traction"
                            : "a side face, give a pressure or traction in powers of xi"));
    return false;
  }
  if (!in_powers && place.kind == Place::Kind::face && !divided) {
    checking.error(path, kind, fmt::format("on a side face, {} is given as powers of xi", kind));
    return false;
  }
  return true;
}

/// A load that moves does so along an edge, in time.
bool check_moving(Checking& checking, const std::string& path, const Load& load) {
  if (!load.moving) return true;
  const auto* table = std::get_if<EdgeTable>(&load.kind);
  const bool on_edge = load.on && load.on->kind == Place::Kind::edge;
  if (!on_edge || !(std::holds_alternative<Force>(load.kind) || (table && table->over == EdgeTable::Over::length))) {
    checking.error(path, "moving",
                   "is of a force on an edge, which then acts at one point of it, or of a traction or pressure on an "
                   "edge by a table over its length, {over: length, at: [0, 2], values: [...]}");
    return false;
  }
  if (!checking.number(path, "moving.velocity", load.moving->velocity) ||
      !checking.number(path, "moving.from", load.moving->from))
    return false;
  if (load.moving->velocity == 0.0)
    checking.error(path, "moving.velocity", "must not be 0: leave 'moving' out for a load that stays where it is");
  else if (!checking.gaps.steps && !is_dynamic(checking.model))
    checking.error(path, "moving", "needs a step in time: steps: [{dynamic: {duration: ...}}]");
  else
    return true;
  return false;
}

}  // namespace

void check_loads(Checking& checking) {
  const Model& model = checking.model;
  // A load on an unknown body gives no information about which bodies are held.
  const bool places = checking.gaps.places;
  std::unordered_set<std::string> names, supports;
  for (const Support& support : model.supports)
    if (support.name != support.on.text) supports.insert(support.name);
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const std::string path = path_of_load(load, i);
    checking.enter(load.source);
    check_name(checking, path, load.name, "load", names);
    if (supports.contains(load.name)) checking.error_of_key(path, "", named_like_a_support(load.name));
    const bool on = check_on(checking, path, load);
    checking.load[i] = check_values(checking, path, load) && on && check_moving(checking, path, load);
    if (const auto* temperature = std::get_if<Temperature>(&load.kind); temperature && temperature->table)
      if (checking.load[i]) check_linear_in_bodies(checking, path, load, *temperature->table);
    if (!checking.load[i]) checking.gaps.conditions = true;
  }
  checking.gaps.places = places;
}

}  // namespace scabo::model
