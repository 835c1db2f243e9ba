// Contact laws: friction, cohesion, tensile strength, bond, prescribed bound.
#include <fmt/format.h>

#include <array>

#include "scabo/input/laws.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

namespace {

constexpr const char* friction_example =
    "0.3, {forward: 0.3, backward: 0.6}, {static: 0.5, dynamic: 0.3, slip_distance: 1e-4} or {along: [[0, 0.3], [1, "
    "0.5]]}";
constexpr const char* directions_of_each =
    "write {static: {forward: 0.5, backward: 0.8}, dynamic: {forward: 0.3, backward: 0.6}}";

constexpr std::array law_keys{"friction", "cohesion", "tension", "bond", "shear_strength"};

/// `[[s, mu], ...]`.
void read_along(Report& report, const Value& value, Contact& contact) {
  const auto items = read_list(report, value, "[[0, 0.3], [1, 0.5]]");
  if (!items) return;
  if (items->empty()) report.error(value, "needs at least one [position, coefficient], as in [[0, 0.3], [1, 0.5]]");
  for (const Value& item : *items) {
    const auto point = read_vector(report, item);
    if (point) contact.friction_along.push_back({point->x(), point->y()});
  }
}

/// Each a number, or one for each direction of slip.
void read_static_and_dynamic(Report& report, const MapReader& map, Contact& contact) {
  const auto most = map.need("static"), least = map.need("dynamic");
  const auto coefficients = [&](const std::optional<Value>& value) {
    return (value ? read_coefficients(report, *value) : std::nullopt).value_or(std::pair(0.0, 0.0));
  };
  const auto at_rest = coefficients(most), sliding = coefficients(least);
  contact.friction = at_rest.first;
  contact.dynamic_friction = sliding.first;
  const auto is_map = [](const std::optional<Value>& value) { return value && value->node->kind == Node::Kind::map; };
  if (is_map(most) || is_map(least)) {
    contact.backward_friction = at_rest.second;
    contact.backward_dynamic_friction = sliding.second;
  }
  if (const auto distance = map.get("slip_distance"))
    contact.slip_distance = read_number(report, *distance).value_or(0.0);
}

/// `{forward: 0.3, backward: 0.6}`; 0 for what is broken.
std::pair<double, double> read_directions(Report& report, const MapReader& map) {
  const auto number = [&](const char* key) {
    const auto value = map.need(key);
    return value ? read_number(report, *value).value_or(0.0) : 0.0;
  };
  const double forward = number("forward");
  return {forward, number("backward")};
}

void read_friction(Report& report, const Value& value, Contact& contact) {
  if (value.node->kind != Node::Kind::map) {
    contact.friction = read_number(report, value).value_or(0.0);
    return;
  }
  const MapReader map(report, value, {"forward", "backward", "static", "dynamic", "slip_distance", "along"},
                      friction_example);
  const auto along = map.get("along");
  if (map.has("forward") || map.has("backward")) {
    for (const char* other : {"static", "dynamic"})
      if (map.has(other))
        map.refuse(other, fmt::format("cannot stand beside 'forward' and 'backward': {}", directions_of_each));
    for (const char* other : {"slip_distance", "along"})
      if (map.has(other)) map.refuse(other, "cannot be combined with 'forward' and 'backward': leave one of them out");
    const auto [forward, backward] = read_directions(report, map);
    contact.friction = forward;
    contact.backward_friction = backward;
    return;
  }
  if (!along) {
    if (map.all_known()) read_static_and_dynamic(report, map, contact);
    return;
  }
  for (const char* other : {"static", "dynamic", "slip_distance"})
    if (map.has(other)) map.refuse(other, "cannot be combined with 'along': leave one of them out");
  read_along(report, *along, contact);
}

/// One number, until the pair first opens or slips; or `{lasting: 50e3}`, while it is closed.
void read_cohesion(Report& report, const Value& value, Contact& contact) {
  if (value.node->kind == Node::Kind::sequence) {
    report.error(value, fmt::format("must be a number, until the joint first fails, or {{lasting: 50e3}}, while it is "
                                    "closed, not {}",
                                    describe(*value.node)));
    return;
  }
  if (value.node->kind != Node::Kind::map) {
    contact.cohesion = read_number(report, value).value_or(0.0);
    return;
  }
  const MapReader map(report, value, {"lasting"}, "{lasting: 50e3}");
  if (const auto lasting = map.need("lasting")) contact.lasting_cohesion = read_number(report, *lasting).value_or(0.0);
}

}  // namespace

std::optional<std::pair<double, double>> read_coefficients(Report& report, const Value& value) {
  const std::size_t before = report.count();
  std::pair<double, double> coefficients;
  if (value.node->kind == Node::Kind::map) {
    const MapReader map(report, value, {"forward", "backward"}, "{forward: 0.3, backward: 0.6}");
    if (map.all_known()) coefficients = read_directions(report, map);
  } else {
    coefficients.first = coefficients.second = read_number(report, value).value_or(0.0);
  }
  return report.count() > before ? std::nullopt : std::optional(coefficients);
}

void read_law(Report& report, const MapReader& map, Contact& contact) {
  if (const auto friction = map.get("friction")) read_friction(report, *friction, contact);
  if (const auto cohesion = map.get("cohesion")) read_cohesion(report, *cohesion, contact);
  if (const auto tension = map.get("tension")) contact.tension = read_number(report, *tension).value_or(0.0);
  if (const auto bond = map.get("bond")) contact.bond = read_flag(report, *bond).value_or(false);
  if (const auto strength = map.get("shear_strength")) contact.shear_strength = read_number(report, *strength);

  if (contact.bond)
    for (const char* other : {"friction", "cohesion", "tension", "shear_strength"})
      if (map.has(other)) map.refuse(other, no_effect_beside_bond);
  if (!contact.bond && contact.shear_strength)
    for (const char* other : {"friction", "cohesion", "tension"})
      if (map.has(other)) map.refuse(other, replaced_by_shear_strength);
}

ContactProperties read_properties(Report& report, const std::optional<Value>& given) {
  ContactProperties properties;
  if (!given) return properties;
  for (const Entry& entry : read_named(report, *given, "contact properties", "{rough: {friction: 0.6}}")) {
    const std::size_t before = report.count();
    const MapReader map(report, entry.value, {law_keys.begin(), law_keys.end()}, "{friction: 0.6}",
                        {{"gap", "a gap belongs to each contact"}, {"between", "it belongs to each contact"}});
    Contact law;
    if (map.is_map()) read_law(report, map, law);
    ContactProperty& property = properties[entry.key];
    property.source = entry.key_source;
    if (report.count() == before) property.law = law;
  }
  return properties;
}

bool read_law_or_property(Report& report, const MapReader& map, ContactProperties& properties, Contact& contact) {
  const auto value = map.get("property");
  if (!value) {
    read_law(report, map, contact);
    return true;
  }
  for (const char* key : law_keys)
    if (map.has(key)) map.refuse(key, "is given by the 'property' of the contact: remove one of the two");
  const auto name = read_text(report, *value);
  if (!name) return true;
  const auto found = properties.find(*name);
  if (found == properties.end()) {
    std::vector<std::string> known;
    for (const auto& [other, property] : properties) known.push_back(other);
    report.error(*value, fmt::format("there is no contact property named {}{}", quoted_name(*name),
                                     known.empty() ? ": define it in the section contact_properties"
                                                   : suggestion(*name, known)));
    return true;
  }
  found->second.used = true;
  if (!found->second.law) return false;
  const Contact& law = *found->second.law;
  contact.friction = law.friction;
  contact.backward_friction = law.backward_friction;
  contact.dynamic_friction = law.dynamic_friction;
  contact.backward_dynamic_friction = law.backward_dynamic_friction;
  contact.slip_distance = law.slip_distance;
  contact.friction_along = law.friction_along;
  contact.cohesion = law.cohesion;
  contact.lasting_cohesion = law.lasting_cohesion;
  contact.tension = law.tension;
  contact.bond = law.bond;
  contact.shear_strength = law.shear_strength;
  return true;
}

void tell_of_unused(const ContactProperties& properties, std::vector<Warning>& warnings) {
  for (const auto& [name, property] : properties)
    if (!property.used)
      warnings.push_back({WarningKind::input, "contact_properties." + name,
                          fmt::format("contact property '{}' has no effect: no contact uses it", name)});
}

}  // namespace scabo::input
