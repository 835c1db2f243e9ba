// `contacts`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "scabo/geometry/touching.hpp"
#include "scabo/input/reading.hpp"

namespace scabo::input {

namespace {

constexpr const char* contact_example = "{between: [lower.top, upper.bottom], friction: 0.2}";

/// One side; nothing if it is broken.
std::optional<Place> read_side(Reading& reading, const Value& value) {
  const ReadPlace read = read_place(reading, value);
  const bool face = read.place && read.place->kind == Place::Kind::face;  // a crack does not hold its body
  if (read.body >= 0 && !face) reading.state(read.body).touched = true;
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

/// What `between` names: two edges, or bodies whose touching edges are all in contact.
struct Between {
  std::optional<std::pair<Place, Place>> edges;
  bool many = false;                         // all touching edges
  std::optional<std::array<int, 2>> bodies;  // of these two bodies; empty: of all
};

std::optional<Between> read_partners(Reading& reading, const Value& value) {
  Between between;
  if (value.node->kind == Node::Kind::scalar && value.node->text == "all") {
    between.many = true;
    for (BodyState& state : reading.bodies) state.touched = true;
    return between;
  }
  between.edges = read_between(reading, value);
  if (!between.edges) return {};
  const auto& [a, b] = *between.edges;
  if (a.kind != Place::Kind::body && b.kind != Place::Kind::body) return between;
  if (a.kind != b.kind) {
    reading.report.error(value, "must be two edges or two bodies, not one of each");
    return {};
  }
  between.many = true;
  between.bodies = {a.body, b.body};
  return between;
}

/// Contacts of all touching edges, named `joint_1`, `joint_2`, ...
void add_touching(Reading& reading, const Entry& entry, const Contact& law, const Between& between, double reach,
                  std::set<std::array<int, 4>>& taken) {
  const auto edge_place = [&](int body, int edge) {
    Place place;
    place.kind = Place::Kind::edge;
    place.body = body;
    place.index = edge;
    place.text = reading.body(body).name + "." + shown_name(reading.body(body).outline.edges[static_cast<std::size_t>(edge)]);
    place.source = entry.value.source();
    return place;
  };
  std::vector<const Outline*> outlines;
  for (std::size_t b = 0; b < reading.model.bodies.size(); ++b) {
    const bool named = !between.bodies || (*between.bodies)[0] == static_cast<int>(b) ||
                       (*between.bodies)[1] == static_cast<int>(b);
    outlines.push_back(named && reading.bodies[b].shape ? &reading.model.bodies[b].outline : nullptr);
  }
  int number = 0;
  for (const geometry::TouchingEdges& pair : geometry::touching_edges(outlines, reach)) {
    if (reading.body(pair.body_a).rigid && reading.body(pair.body_b).rigid) continue;
    if (!taken.insert({pair.body_a, pair.edge_a, pair.body_b, pair.edge_b}).second) continue;
    Contact contact = law;
    contact.name = fmt::format("{}_{}", entry.key, ++number);
    const bool swapped = between.bodies && (*between.bodies)[0] == pair.body_b;
    contact.a = edge_place(swapped ? pair.body_b : pair.body_a, swapped ? pair.edge_b : pair.edge_a);
    contact.b = edge_place(swapped ? pair.body_a : pair.body_b, swapped ? pair.edge_a : pair.edge_b);
    reading.model.contacts.push_back(std::move(contact));
  }
  if (number == 0 && reading.report.clean())
    reading.report.error(entry.value, "no two edges of these bodies lie on each other: give a 'reach', the distance up to "
                                      "which edges are in contact, or name two edges");
}

std::optional<Contact> read_contact(Reading& reading, const Entry& entry, Between& between_of, double& reach) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, entry.value,
                      {"between", "reach", "friction", "gap", "cohesion", "tension", "bond", "shear_strength"},
                      contact_example,
                      {{"kind", "leave it out; every contact is node-to-node"},
                       {"penalty", "leave it out; the contact conditions are met without a penalty"}});
  Contact contact;
  contact.name = entry.key;
  contact.source = entry.key_source;
  const auto between_value = map.need("between");
  if (!between_value) reading.places_known = false;
  const auto between = between_value ? read_partners(reading, *between_value) : std::nullopt;
  if (const auto distance = map.get("reach")) {
    reach = read_number(report, *distance).value_or(0.0);
    if (reach < 0.0) report.error(*distance, "must be 0 or more: it is a distance");
    if (between && !between->many)
      map.refuse("reach", "applies to between: all or to two bodies: two edges are in contact at any distance");
  }
  read_law(reading, map, contact);
  if (const auto gap = map.get("gap")) contact.gap = read_number(report, *gap).value_or(0.0);
  if (contact.bond && map.has("gap"))
    map.refuse("gap", no_gap_beside_bond);
  if (report.count() > before || !between) return {};
  between_of = *between;
  if (between->many) return contact;
  contact.a = between->edges->first;
  contact.b = between->edges->second;
  return contact;
}

}  // namespace

void read_contacts(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const auto entries =
      read_named(reading.report, value, "contacts", "{joint: {between: [lower.top, upper.bottom], friction: 0.2}}");
  if (reading.report.count() > before) reading.places_known = reading.conditions_known = false;
  struct Touching {
    const Entry* entry = nullptr;
    Contact law;
    Between between;
    double reach = 0.0;
  };
  std::vector<Touching> touching;
  std::set<std::array<int, 4>> taken;  // pairs of edges with a contact of their own
  for (const Entry& entry : entries) {
    Between between;
    double reach = 0.0;
    auto contact = read_contact(reading, entry, between, reach);
    if (!contact) {
      reading.conditions_known = false;
    } else if (between.many) {
      touching.push_back({&entry, std::move(*contact), between, reach});
    } else {
      const Place &a = contact->a, &b = contact->b;
      taken.insert(a.body < b.body ? std::array{a.body, a.index, b.body, b.index}
                                   : std::array{b.body, b.index, a.body, a.index});
      reading.model.contacts.push_back(std::move(*contact));
    }
  }
  // Contacts that name their edges come first, then those between two bodies, then those between all.
  std::stable_sort(touching.begin(), touching.end(), [](const Touching& a, const Touching& b) {
    return a.between.bodies.has_value() && !b.between.bodies.has_value();
  });
  for (const Touching& all : touching) add_touching(reading, *all.entry, all.law, all.between, all.reach, taken);
}

}  // namespace scabo::input
