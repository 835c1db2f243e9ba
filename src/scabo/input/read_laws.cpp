// Contact laws: friction, cohesion, tensile strength, bond, prescribed bound.
#include <fmt/format.h>

#include "scabo/input/numbers.hpp"
#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* friction_example =
    "0.3, {static: 0.5, dynamic: 0.3, slip_distance: 1e-4} or {along: [[0, 0.3], [1, 0.5]]}";

constexpr double largest_coefficient = 1e6;  // for larger values the forces in balance are lost in rounding

double read_coefficient(Report& report, const Value& value) {
  const double friction = read_not_negative(report, value).value_or(0.0);
  if (friction <= largest_coefficient) return friction;
  report.error(value,
               fmt::format("a coefficient of friction must be at most 1e6, not {}: 1e6 already prevents slip, and "
                           "'bond: true' prevents both slip and opening",
                           number_text(friction)));
  return 0.0;
}

/// `[[s, mu], ...]`, s from 0 to 1, ascending.
void read_along(Report& report, const Value& value, Contact& contact) {
  const auto items = read_list(report, value, "[[0, 0.3], [1, 0.5]]");
  if (!items) return;
  if (items->empty()) report.error(value, "needs at least one [position, coefficient], as in [[0, 0.3], [1, 0.5]]");
  for (const Value& item : *items) {
    const auto point = read_vector(report, item);
    if (!point) continue;
    if (point->y() > largest_coefficient)
      report.error(item, fmt::format("a coefficient of friction must be at most 1e6, not {}", number_text(point->y())));
    else if (point->x() < 0.0 || point->x() > 1.0)
      report.error(item,
                   fmt::format("a position along the contact must be from 0 to 1, not {}", number_text(point->x())));
    else if (point->y() < 0.0)
      report.error(item, fmt::format("a coefficient of friction must be 0 or more, not {}", number_text(point->y())));
    else if (!contact.friction_along.empty() && point->x() <= contact.friction_along.back().position)
      report.error(item, "positions along the contact must be in ascending order");
    else
      contact.friction_along.push_back({point->x(), point->y()});
  }
}

void read_static_and_dynamic(Report& report, const MapReader& map, Contact& contact) {
  const std::size_t before = report.count();
  const auto most = map.need("static");
  const auto least = map.need("dynamic");
  if (most) contact.friction = read_coefficient(report, *most);
  const double dynamic = least ? read_coefficient(report, *least) : 0.0;
  contact.dynamic_friction = dynamic;
  if (report.count() == before && dynamic > contact.friction)
    report.error(*least, fmt::format("must be at most the static coefficient {}, not {}", number_text(contact.friction),
                                     number_text(dynamic)));
  if (const auto distance = map.get("slip_distance"))
    contact.slip_distance = read_not_negative(report, *distance).value_or(0.0);
}

void read_friction(Report& report, const Value& value, Contact& contact) {
  if (value.node->kind != Node::Kind::map) {
    contact.friction = read_coefficient(report, value);
    return;
  }
  const MapReader map(report, value, {"static", "dynamic", "slip_distance", "along"}, friction_example);
  const auto along = map.get("along");
  if (!along) {
    if (map.all_known()) read_static_and_dynamic(report, map, contact);
    return;
  }
  for (const char* other : {"static", "dynamic", "slip_distance"})
    if (map.has(other)) map.refuse(other, "cannot be combined with 'along': leave one of them out");
  read_along(report, *along, contact);
}

}  // namespace

void read_law(Reading& reading, const MapReader& map, Contact& contact) {
  Report& report = reading.report;
  if (const auto friction = map.get("friction")) read_friction(report, *friction, contact);
  if (const auto cohesion = map.get("cohesion")) contact.cohesion = read_not_negative(report, *cohesion).value_or(0.0);
  if (const auto tension = map.get("tension")) contact.tension = read_not_negative(report, *tension).value_or(0.0);
  if (const auto bond = map.get("bond")) contact.bond = read_flag(report, *bond).value_or(false);
  if (const auto strength = map.get("shear_strength")) contact.shear_strength = read_not_negative(report, *strength);

  if (contact.bond)
    for (const char* other : {"friction", "cohesion", "tension", "shear_strength"})
      if (map.has(other)) map.refuse(other, "has no effect where 'bond' is true: leave one of them out");
  if (!contact.bond && contact.shear_strength)
    for (const char* other : {"friction", "cohesion", "tension"})
      if (map.has(other))
        map.refuse(other, "cannot be combined with 'shear_strength', which replaces friction: leave one of them out");
  if (!contact.bond && contact.tension > 0.0 && contact.cohesion == 0.0)
    map.refuse("tension",
               "a joint that slips loses its tensile strength, and without 'cohesion' nothing prevents this one from "
               "slipping: give both");
}

}  // namespace scabo::input
