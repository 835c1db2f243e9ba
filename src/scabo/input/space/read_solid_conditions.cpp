// `supports`, `loads`, `contacts` and `ties` of models in space.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scabo/input/space/space_reader.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/checking.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

namespace {

constexpr std::array<const char*, 3> names_of_axes{"x", "y", "z"};

constexpr const char* fix_forms = "x, y, z or a list of them, normal or {along: [1, 2, 2]}";

}  // namespace

SpaceReader::Components SpaceReader::fixed(const Value& value) {
  Components fixed;
  const bool is_list = value.node->kind == Node::Kind::sequence;
  std::vector<Value> items{value};
  if (is_list) items = *read_list(report_, value, "[x, y, z]");
  if (items.empty()) report_.error(value, fmt::format("must be {}, not an empty list", fix_forms));
  for (const Value& item : items) {
    const auto name = std::find(names_of_axes.begin(), names_of_axes.end(), item.node->text);
    if (item.node->kind != Node::Kind::scalar || name == names_of_axes.end())
      report_.error(item, fmt::format("must be {}, not {}", is_list ? "x, y or z" : fix_forms, describe(*item.node)));
    else if (auto& component = fixed[static_cast<std::size_t>(name - names_of_axes.begin())]; component)
      report_.error(item, fmt::format("{} is given twice: remove one of the two", *name));
    else
      component = 0.0;
  }
  return fixed;
}

SpaceReader::Components SpaceReader::components(const Value& value, const char* names) {
  Components read;
  const Node& node = *value.node;
  if (node.kind != Node::Kind::sequence || node.items.size() != 3) {
    report_.error(value, fmt::format("must be {}, with null for a free component, not {}", names,
                                     node.kind == Node::Kind::sequence ? fmt::format("a list of {}", node.items.size())
                                                                       : describe(node)));
    return read;
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (node.items[k]->kind != Node::Kind::null) read[k] = read_number(report_, value.item(k));
  return read;
}

/// `[f, g, h]`, each a formula of x, y and z, a number or null.
SpaceReader::Formulas SpaceReader::formulas(const Value& value) {
  Formulas formulas;
  const Node& node = *value.node;
  if (node.kind != Node::Kind::sequence || node.items.size() != 3) {
    report_.error(value, R"(must be three formulas, as in ["0.1 * x", null, "2 * z"], with null for none)");
    return formulas;
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (node.items[k]->kind != Node::Kind::null) formulas[k] = read_formula_in_space(report_, value.item(k));
  return formulas;
}

/// `along: [1, 2, 2]`, of any length.
void SpaceReader::direction_of(const Value& value, SpaceSupport& support) {
  const std::size_t before = report_.count();
  support.axes = SpaceSupport::Axes::direction;
  support.along = vector(value);
  if (report_.count() == before && support.along.isZero(0.0))
    report_.error(value, "has no direction: not all of it may be 0");
  support.along.stableNormalize();
  if (support.on.body >= 0 && support.on.is_body())
    report_.error(value, "is that of a face or a set of nodes: a rigid body is held along x, y and z");
}

/// `normal`, `{along: [1, 2, 2]}`, `x`, or `[x, y, z]`.
void SpaceReader::fix(const Value& value, SpaceSupport& support) {
  if (value.node->kind == Node::Kind::map) {
    const MapReader map(report_, value, {"along"}, "{along: [1, 2, 2]}");
    if (const auto along = map.need("along")) direction_of(*along, support);
    support.displacement[0] = 0.0;
  } else if (value.node->kind == Node::Kind::scalar && value.node->text == "normal") {
    along_normal(value, support);
    support.displacement[0] = 0.0;
  } else {
    support.displacement = fixed(value);
  }
}

void SpaceReader::along_normal(const Value& value, SpaceSupport& support) {
  support.axes = SpaceSupport::Axes::normal;
  if (support.on.body >= 0 && support.on.is_body())
    report_.error(value, "is that of a face: a rigid body is held along x, y and z");
}

/// `[ux, uy, uz]`, or of a face `{formula: [ux, uy, uz]}`, `{normal: un}` or `{along: [1, 2, 2], value: u}`.
void SpaceReader::displacement(const Value& value, SpaceSupport& support) {
  if (value.node->kind != Node::Kind::map) {
    support.displacement = components(value, "[ux, uy, uz]");
    return;
  }
  const MapReader map(report_, value, {"formula", "normal", "along", "value"},
                      "{normal: -1e-3} or {along: [1, 2, 2], value: 1e-3}",
                      {{"tangent", "a face in space has many of them: give one by 'along' and 'value'"}});
  if (!map.is_map()) return;
  const auto normal = map.get("normal"), along = map.get("along"), given = map.get("formula");
  if (normal || along) {
    for (const char* other : {"formula", "along", "value"})
      if (normal || std::string_view(other) == "formula")
        map.refuse(other, fmt::format("does not go together with '{}': make two supports of them",
                                      normal ? "normal" : "along"));
    if (normal) along_normal(*normal, support);
    if (along && !normal) direction_of(*along, support);
    support.displacement[0] = number(normal ? normal : map.need("value"));
    return;
  }
  map.refuse("value", "needs 'along', its direction");
  if (!given) {
    if (map.all_known() && !map.has("value")) report_.error(value, "needs 'normal', 'formula', or 'along' and 'value'");
    return;
  }
  if (support.on.body >= 0 && support.on.is_body())
    map.refuse("formula", "is that of a face: a rigid body has one displacement");
  support.shape = formulas(*given);
  for (std::size_t k = 0; k < 3; ++k)
    if (support.shape[k]) support.displacement[k] = 1.0;
}

/// Without `rotation` all points of the body are held: what would move them along a held axis is 0.
void SpaceReader::rigid_support(const MapReader& map, SpaceSupport& support) {
  if (const auto at = map.get("at")) support.at = vector(*at);
  if (const auto rotation = map.get("rotation")) {
    support.rotation = components(*rotation, "[rx, ry, rz]");
    constexpr double most = 0.1;
    for (const auto& angle : support.rotation)
      if (angle && std::abs(*angle) > most)
        report_.error(*rotation, fmt::format("must be from -{0} to {0} rad, since rotations are small", most));
    return;
  }
  map.refuse("at", "needs 'rotation' beside it");
  for (std::size_t k = 0; k < 3; ++k)
    if (support.displacement[(k + 1) % 3] || support.displacement[(k + 2) % 3]) support.rotation[k] = 0.0;
}

void SpaceReader::support(const Value& value) {
  const MapReader map(
      report_, value, {"on", "fix", "displacement", "rotation", "at", "name", "added", "removed"},
      "{on: block.bottom, fix: [x, y, z]}",
      {{"symmetry",
        "in space, hold the faces on a plane of symmetry along its normal, as in {on: block.left, fix: normal}"}});
  if (!map.is_map()) return;
  stages_of_supports_.push_back({model_.supports.size(), map.get("added"), map.get("removed")});
  SpaceSupport support;
  support.name = fmt::format("support_{}", model_.supports.size() + 1);
  if (const auto name = map.get("name")) {
    const auto text = read_text(report_, *name);
    if (text && check_name(report_, name->source(), *text)) {
      support.named = true;
      support.name = *text;
      for (const SpaceSupport& other : model_.supports)
        if (other.name == *text) report_.error(*name, fmt::format("two supports are called '{}'", *text));
    }
  }
  const auto on = map.need("on");
  const auto found = on ? place(*on, "a support") : std::nullopt;
  if (found) support.on = *found;
  const auto fixed_along = map.get("fix"), given = map.get("displacement");
  if (fixed_along && given)
    map.refuse("displacement", "does not go together with 'fix': write 0 for the components that are fixed");
  else if (fixed_along)
    fix(*fixed_along, support);
  else if (given)
    displacement(*given, support);
  else if (!map.has("rotation") && map.all_known())
    report_.error(value, "needs 'fix' or 'displacement'");
  if (fixed_along)
    map.refuse("rotation", "does not go together with 'fix': write 'displacement', with null for free components");
  if (found && body_at(found->body).rigid && found->is_body()) {
    rigid_support(map, support);
  } else if (found) {
    for (const char* key : {"rotation", "at"})
      map.refuse(key, "is that of a rigid body as a whole: name the body alone");
    if (body_at(found->body).rigid)
      report_.error(*on, fmt::format("is a face of a rigid body, which is held as a whole: write '{}'",
                                     body_at(found->body).name));
  }
  model_.supports.push_back(support);
}

void SpaceReader::check_gravity(const Entry& entry, const SpaceLoad& load) {
  const bool by_temperature = load.kind == SpaceLoad::Kind::temperature;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const SpaceBody& body = model_.bodies[b];
    if (load.on.body >= 0 && load.on.body != static_cast<int>(b)) continue;
    if (body.rigid) {
      if (load.on.body >= 0 && (by_temperature || body.density == 0.0))
        report_.error(
            entry.value,
            by_temperature
                ? fmt::format("body '{}' is rigid, so that no temperature changes it: leave the load out", body.name)
                : fmt::format("the rigid body '{}' has no 'density', so that gravity has no effect on it: give it one",
                              body.name));
      continue;
    }
    if (body.material < 0) continue;
    const SpaceMaterial& material = model_.materials[static_cast<std::size_t>(body.material)];
    if (by_temperature && material.expansion == 0.0)
      report_.error(entry.value, fmt::format("the material of body '{}' has no 'expansion', so that a temperature has "
                                             "no effect on it: give it one",
                                             body.name));
    if (!by_temperature && material.density == 0.0)
      report_.error(entry.value, fmt::format("the material of body '{}' has no 'density', so that gravity has no "
                                             "effect on it: give it one",
                                             body.name));
  }
}

void SpaceReader::load_value(const std::string& kind, const Value& value, SpaceLoad& load) {
  using Kind = SpaceLoad::Kind;
  const bool is_map = value.node->kind == Node::Kind::map;
  if (kind == "temperature") {
    load.kind = Kind::temperature;
    if (!is_map) return void(load.constant = number(value));
    const MapReader map(report_, value, {"constant", "x", "y", "z"}, "{constant: 20, z: -2.5}",
                        only_in_the_plane({"over", "at", "values"}));
    if (map.is_map() && value.node->entries.empty()) report_.error(value, "needs constant, x, y or z");
    load.constant = number(map.get("constant"));
    for (int k = 0; k < 3; ++k) load.vector[k] = number(map.get(names_of_axes[static_cast<std::size_t>(k)]));
    return;
  }
  load.kind = kind == "pressure"      ? Kind::pressure
              : kind == "traction"    ? Kind::traction
              : kind == "force"       ? Kind::force
              : kind == "nodal_force" ? Kind::nodal_force
              : kind == "line_load"   ? Kind::line_load
              : kind == "moment"      ? Kind::moment
                                      : Kind::gravity;
  const bool has_formula = load.kind == Kind::pressure || load.kind == Kind::traction || load.kind == Kind::line_load;
  if (is_map && has_formula) {
    const MapReader map(report_, value, {"formula"},
                        load.kind == Kind::pressure ? R"text({formula: "10e3 * (4 - z)"})text"
                                                    : R"text({formula: ["1e3 * z", 0, 0]})text",
                        only_in_the_plane({"over", "at", "values", "powers", "points"}));
    const auto formula = map.need("formula");
    if (formula && load.kind == Kind::pressure) load.formula[0] = read_formula_in_space(report_, *formula);
    if (formula && load.kind != Kind::pressure) load.formula = formulas(*formula);
  } else if (load.kind == Kind::pressure) {
    load.pressure = number(value);
  } else {
    load.vector = vector(value);
  }
}

void SpaceReader::place_of_load(const MapReader& map, const Entry& entry, SpaceLoad& load) {
  using Kind = SpaceLoad::Kind;
  if (load.kind != Kind::gravity && load.kind != Kind::temperature) {
    const auto on = map.need("on");
    const bool of_bodies = load.kind == Kind::force || load.kind == Kind::moment;
    if (const auto found = on ? place(*on, of_bodies ? "a force or moment" : nullptr) : std::nullopt) load.on = *found;
    if (load.on.body >= 0 && !check_place_of_load(*on, load)) return;
    if (load.kind == Kind::nodal_force && load.on.body >= 0 && (load.on.node_set < 0 || load.on.normal))
      report_.error(*on, "must be a set of nodes of a mesh file: give a face a 'force' or 'traction'");
    if (load.kind == Kind::nodal_force && load.on.body >= 0 && body_at(load.on.body).rigid)
      report_.error(*on, "is a set of nodes of a rigid body, on which a 'force' acts: name the body alone");
    return;
  }
  if (const auto on = map.get("on")) {
    const auto name = read_text(report_, *on);
    load.on.source = on->source();
    for (std::size_t b = 0; name && b < model_.bodies.size(); ++b)
      if (model_.bodies[b].name == *name) load.on.body = static_cast<int>(b);
    if (name && load.on.body < 0)
      report_.error(*on, fmt::format("must be a body, on all of which {} acts, not {}",
                                     load.kind == Kind::gravity ? "gravity" : "a temperature", quoted_name(*name)));
    if (load.on.body < 0) return;
  }
  check_gravity(entry, load);
}

void SpaceReader::load(const Entry& entry) {
  const std::vector<std::string> kinds{"pressure",    "traction", "force",   "line_load",
                                       "nodal_force", "moment",   "gravity", "temperature"};
  std::vector<std::string> known = kinds;
  known.insert(known.end(), {"on", "at"});
  const MapReader map(
      report_, entry.value, known, "{on: block.top, pressure: 1e6}",
      only_in_the_plane({"water", "in", "enters", "field", "body_force", "rotation", "spin", "level", "weight"}));
  if (!map.is_map()) return;
  SpaceLoad load;
  load.name = entry.key;
  for (const SpaceLoad& other : model_.loads)
    if (other.name == entry.key)
      report_.error(entry.key_source,
                    fmt::format("springs are called '{}' already: give the load another name", entry.key));
  std::vector<std::string> given;
  for (const std::string& kind : kinds)
    if (map.has(kind)) given.push_back(kind);
  if (given.size() == 1) {
    load_value(given.front(), *map.get(given.front()), load);
    if (const auto at = map.get("at"); at && load.kind == SpaceLoad::Kind::force) load.at = vector(*at);
    place_of_load(map, entry, load);
    if (load.kind != SpaceLoad::Kind::force)
      map.refuse("at", "is the point through which a 'force' acts: leave it out");
  } else if (given.size() > 1) {
    report_.error(entry.value, fmt::format("has '{}' and '{}': make two loads of them", given[0], given[1]));
  } else if (map.all_known()) {
    report_.error(entry.value,
                  "needs one of 'pressure', 'traction', 'force', 'line_load', 'nodal_force', 'moment', 'gravity' and "
                  "'temperature'");
  }
  for (const SpaceSupport& support : model_.supports)
    if (support.named && support.name == load.name)
      report_.error(
          entry.key_source,
          fmt::format("a support is also named '{}', and a step could mean either: rename one of them", load.name));
  model_.loads.push_back(load);
}

/// Two faces are joined once.
void SpaceReader::refuse_joined_faces(const Entry& entry, const SpaceContact& contact) {
  for (const SpaceContact& other : model_.contacts)
    if ((contact.a.is_same(other.a) && contact.b.is_same(other.b)) ||
        (contact.a.is_same(other.b) && contact.b.is_same(other.a)))
      report_.error(entry.key_source, fmt::format("{} '{}' already connects the same two faces: remove one of the two",
                                                  other.tied ? "tie" : "contact", other.name));
}

/// `friction: {direction: [1, 0, 0], along: 0.2, across: 0.5}`; false: the friction is another one.
bool SpaceReader::friction_axes(const MapReader& map, SpaceContact& contact) {
  const auto friction = map.get("friction");
  if (!friction || friction->node->kind != Node::Kind::map || friction->node->find("direction") == nullptr)
    return false;
  for (const char* other : {"property", "cohesion", "tension", "bond", "shear_strength"})
    map.refuse(other, "does not go together with a friction that differs along two directions: leave one of them out");
  const std::size_t before = report_.count();
  const MapReader keys(report_, *friction, {"direction", "along", "across"},
                       "{direction: [1, 0, 0], along: 0.2, across: 0.5}");
  SpaceFrictionAxes axes;
  const Value direction = *keys.need("direction");
  axes.direction = vector(direction);
  if (report_.count() == before && axes.direction.isZero(0.0))
    report_.error(direction, "has no direction: not all of it may be 0");
  axes.direction.stableNormalize();
  contact.law.friction = number_from(keys.need("along"), 0.0, false);
  axes.across = number_from(keys.need("across"), 0.0, false);
  constexpr double most = 100.0;  // scaled by more, motions along the faces lose their digits
  if (report_.count() == before &&
      std::max(axes.across, contact.law.friction) > most * std::min(axes.across, contact.law.friction))
    report_.error(*friction, fmt::format("must have coefficients that differ by a factor of at most {:g}", most));
  contact.friction_axes = axes;
  return true;
}

/// As in the plane, but for what has no meaning in space.
void SpaceReader::law(const MapReader& map, SpaceContact& contact) {
  const std::size_t before = report_.count();
  contact.law.name = contact.name;
  if (!friction_axes(map, contact)) read_law_or_property(report_, map, properties_, contact.law);
  if (const auto modulus = map.get("modulus")) contact.law.modulus = read_number(report_, *modulus);
  if (contact.law.bond) {
    map.refuse("gap", no_gap_beside_bond);
    map.refuse("fit_in", "a bonded contact keeps its initial position: leave 'fit_in' out, or 'bond'");
  }
  if (report_.count() > before) return;
  if (contact.law.backward_friction || !contact.law.friction_along.empty())
    return report_.error(map.get("friction").value_or(map.map()),
                         "must not depend on the sense of slip or on the place in a model in space: give a number, "
                         "{static: 0.5, dynamic: 0.3, slip_distance: 1e-4}, or {direction: [1, 0, 0], along: 0.2, "
                         "across: 0.5}");
  const Model nothing;
  Checking checking(nothing, Gaps());
  contact.law.source = map.map().source();
  check_law(checking, map.map().path, contact.law);
  report_.add(root_, checking.found);
}

void SpaceReader::pair_of_faces(const Entry& entry, bool tied) {
  std::vector<std::string> known{"between"};
  if (!tied)
    known = {"between",        "property", "friction", "cohesion", "tension", "bond",
             "shear_strength", "modulus",  "gap",      "fit_in",   "about"};
  const MapReader map(
      report_, entry.value, known,
      tied ? "{between: [base.top, block.bottom]}" : "{between: [base.top, block.bottom], friction: 0.3}",
      only_in_the_plane({"slip", "reach"}));
  if (!map.is_map()) return;
  SpaceContact contact;
  contact.name = entry.key;
  contact.tied = contact.law.bond = tied;
  if (!tied) {
    law(map, contact);
    contact.gap = number(map.get("gap"));
    if (const auto fit = map.get("fit_in")) fits_.emplace_back(model_.contacts.size(), *fit);
  }
  if (const auto about = map.get("about")) contact.about = vector(*about);
  for (const SpaceContact& other : model_.contacts)
    if (other.name == entry.key)
      report_.error(entry.key_source,
                    fmt::format("a contact is called '{}' already: give the tie another name", entry.key));
  if (const auto between = map.need("between")) {
    const auto items = read_list(report_, *between, "[base.top, block.bottom]");
    if (items && items->size() != 2)
      report_.error(*between,
                    fmt::format("must be two faces, as in [base.top, block.bottom], not a list of {}", items->size()));
    else if (items) {
      const auto a = face((*items)[0]), b = face((*items)[1]);
      if (a && b && a->body == b->body)
        report_.error(*between, "both faces belong to the same body: name faces of two bodies");
      else if (a && b && !contact.law.bond && !contact.law.modulus && body_at(a->body).rigid && body_at(b->body).rigid)
        model_.warnings.push_back(
            {WarningKind::input, "contacts." + entry.key,
             fmt::format(
                 "contact '{}' is one of two rigid bodies: which of its pairs carry a force does not follow from "
                 "equilibrium, and its pressures are some that are in balance; a 'modulus' gives those of a bed",
                 entry.key)});
      if (a && b) contact.a = *a, contact.b = *b;
      if (a && b) refuse_joined_faces(entry, contact);
    }
  }
  model_.contacts.push_back(contact);
}

}  // namespace scabo::input
