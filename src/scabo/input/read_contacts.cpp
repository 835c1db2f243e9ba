// `contacts`.
#include <fmt/format.h>

#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* contact_example = "{between: [lower.top, upper.bottom], friction: 0.2}";

/// One side; nothing if it is broken.
std::optional<Place> read_side(Reading& reading, const Value& value) {
  const ReadPlace read = read_place(reading, value);
  if (read.body >= 0) reading.state(read.body).touched = true;
  return read.place;
}

/// Both sides; nothing if one is broken.
std::optional<std::pair<Place, Place>> read_between(Reading& reading, const Value& value) {
  if (value.node->kind != Node::Kind::sequence || value.node->items.size() != 2) {
    reading.places_known = false;
    reading.report.error(value, "must be two edges, as in [lower.top, upper.bottom]");
    return {};
  }
  const auto a = read_side(reading, value.item(0));
  const auto b = read_side(reading, value.item(1));
  if (!a || !b) return {};
  return std::pair(*a, *b);
}

std::optional<Contact> read_contact(Reading& reading, const Entry& entry) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, entry.value,
                      {"between", "friction", "gap", "cohesion", "tension", "bond", "shear_strength"}, contact_example,
                      {{"kind", "leave it out; every contact is node-to-node"},
                       {"penalty", "leave it out; the contact conditions are met without a penalty"}});
  Contact contact;
  contact.name = entry.key;
  contact.source = entry.key_source;
  const auto between_value = map.need("between");
  if (!between_value) reading.places_known = false;
  const auto between = between_value ? read_between(reading, *between_value) : std::nullopt;
  read_law(reading, map, contact);
  if (const auto gap = map.get("gap")) contact.gap = read_number(report, *gap).value_or(0.0);
  if (contact.bond && map.has("gap"))
    map.refuse("gap", no_gap_beside_bond);
  if (report.count() > before || !between) return {};
  contact.a = between->first;
  contact.b = between->second;
  return contact;
}

}  // namespace

void read_contacts(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const auto entries =
      read_named(reading.report, value, "contacts", "{joint: {between: [lower.top, upper.bottom], friction: 0.2}}");
  if (reading.report.count() > before) reading.places_known = reading.conditions_known = false;
  for (const Entry& entry : entries) {
    auto contact = read_contact(reading, entry);
    if (!contact) {
      reading.conditions_known = false;
      continue;
    }
    reading.model.contacts.push_back(std::move(*contact));
  }
}

}  // namespace scabo::input
