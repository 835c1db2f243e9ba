// `contacts`.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* contact_example = "{between: [lower.top, upper.bottom], friction: 0.2}";

/// One side; nothing if it is broken or not an edge.
std::optional<Place> read_side(Reading& reading, const Value& value, int& body) {
  const ReadPlace read = read_place(reading, value);
  body = read.body;
  if (read.body >= 0) reading.state(read.body).touched = true;
  if (!read.place) return {};
  if (read.place->kind == Place::Kind::face) {
    reading.report.error(value, fmt::format("'{}' is a side face, which has no nodes between its ends: for contact "
                                            "between the faces of a crack, divide the body along the crack",
                                            read.place->text));
    return {};
  }
  for (const Crack& crack : reading.body(read.place->body).cracks)
    if (crack.edge == read.place->index && read.place->kind == Place::Kind::edge) {
      reading.report.error(value, fmt::format("the mouth of crack '{}' lies on '{}', but a contact needs an edge "
                                              "without a crack mouth: divide the edge, or name another one",
                                              crack.name, read.place->text));
      return {};
    }
  if (read.place->kind != Place::Kind::edge) {
    reading.report.error(
        value, fmt::format("a contact is between two edges, as in [lower.top, upper.bottom]; '{}' is not an edge",
                           read.place->text));
    return {};
  }
  return read.place;
}

/// Both sides; nothing if one is broken or they cannot touch each other.
std::optional<std::pair<Place, Place>> read_between(Reading& reading, const Value& value) {
  if (value.node->kind != Node::Kind::sequence || value.node->items.size() != 2) {
    reading.places_known = false;
    reading.report.error(value, "must be two edges, as in [lower.top, upper.bottom]");
    return {};
  }
  int body_a = -1;
  int body_b = -1;
  const auto a = read_side(reading, value.item(0), body_a);
  const auto b = read_side(reading, value.item(1), body_b);
  if (body_a >= 0 && body_a == body_b) {
    reading.report.error(value, fmt::format("a body cannot be in contact with itself: both edges belong to '{}'",
                                            reading.body(body_a).name));
    return {};
  }
  if (body_a >= 0 && body_b >= 0 && reading.body(body_a).rigid && reading.body(body_b).rigid) {
    reading.report.error(value, fmt::format("'{}' and '{}' are both rigid: one of them must be elastic",
                                            reading.body(body_a).name, reading.body(body_b).name));
    return {};
  }
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
    map.refuse("gap", "a bonded contact keeps the initial distance of its sides: leave 'gap' out");
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
  std::map<std::array<int, 4>, std::string> pairs;
  for (const Entry& entry : entries) {
    auto contact = read_contact(reading, entry);
    if (!contact) {
      reading.conditions_known = false;
      continue;
    }
    std::array<int, 4> pair{contact->a.body, contact->a.index, contact->b.body, contact->b.index};
    if (pair[0] > pair[2]) pair = {pair[2], pair[3], pair[0], pair[1]};
    const auto [first, is_new] = pairs.emplace(pair, contact->name);
    if (!is_new) {
      reading.report.error(
          entry.key_source,
          fmt::format("contact '{}' already connects the same two edges: remove one of the two", first->second));
    }
    reading.model.contacts.push_back(std::move(*contact));
  }
}

}  // namespace scabo::input
