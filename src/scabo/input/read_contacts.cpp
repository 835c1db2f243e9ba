// `contacts` and `ties`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <variant>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/touching.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::input {

namespace {

constexpr const char* contact_example = "{between: [lower.top, upper.bottom], friction: 0.2}";
constexpr const char* tie_example = "{between: [wall.bottom, base.top]}";

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

/// What `between` names: two edges, or bodies whose touching edges are all meant.
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

/// Edges with a contact or tie of their own.
class Taken {
 public:
  bool insert(const Place& a, const Place& b) {
    return pairs_
        .insert(a.body < b.body ? std::array{a.body, a.index, b.body, b.index}
                                : std::array{b.body, b.index, a.body, a.index})
        .second;
  }

 private:
  std::set<std::array<int, 4>> pairs_;
};

/// A contact or tie between all touching edges of bodies: each pair that is not taken gets one, named `joint_1`,
/// `joint_2`, ...
struct Touching {
  const Entry* entry = nullptr;
  std::variant<Contact, Tie> law;  ///< with everything but name and places
  Between between;
  double reach = 0.0;
};

/// A point at which one of two bodies lies inside the other, if there is one: of points along the edges of both, or the
/// first corner of two bodies that are in the same place.
std::optional<Vec2> overlap_of(const Body& a, const Body& b) {
  const geometry::Box box_a = geometry::box_of(a.outline), box_b = geometry::box_of(b.outline);
  if ((box_a.low.array() >= box_b.high.array()).any() || (box_b.low.array() >= box_a.high.array()).any()) return {};
  const double rounding = 1e-6 * std::min((box_a.high - box_a.low).norm(), (box_b.high - box_b.low).norm());
  bool same = true;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const Edge& edge : one->outline.edges)
      for (const double t : {0.0, 0.25, 0.5, 0.75}) {
        const Vec2 point = edge.at(t);
        double distance = std::numeric_limits<double>::max();
        for (const Edge& border : other->outline.edges)
          distance = std::min(distance, (geometry::closest_point(border, point) - point).norm());
        if (distance <= rounding) continue;
        same = false;
        if (geometry::encloses(other->outline, point) != other->outside) return point;
      }
  return same ? std::optional(a.outline.edges.front().start) : std::nullopt;
}

/// Why `between: all`, or two bodies, gives no contact or tie at all.
std::string nothing_touches(const Reading& reading, const std::vector<const Outline*>& outlines, bool is_tie) {
  constexpr std::size_t most_bodies = 1000;  // of which all pairs are compared
  std::vector<const Body*> bodies;
  for (std::size_t b = 0; b < outlines.size(); ++b)
    if (outlines[b] != nullptr && bodies.size() < most_bodies) bodies.push_back(&reading.model.bodies[b]);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      if (const auto point = overlap_of(*bodies[i], *bodies[j]))
        return fmt::format(
            "no two edges of these bodies lie on each other, and '{}' and '{}' overlap at ({:.6g}, "
            "{:.6g}): move one of them, or name two edges",
            bodies[i]->name, bodies[j]->name, point->x(), point->y());
  return is_tie
             ? "no two edges of these bodies lie on each other: move a body, or name two edges"
             : "no two edges of these bodies lie on each other: give a 'reach', the distance up to which edges are in "
               "contact, or name two edges";
}

void add_touching(Reading& reading, const Touching& touching, Taken& taken) {
  const Entry& entry = *touching.entry;
  const Between& between = touching.between;
  const bool is_tie = std::holds_alternative<Tie>(touching.law);
  const auto edge_place = [&](int body, int edge) {
    Place place;
    place.kind = Place::Kind::edge;
    place.body = body;
    place.index = edge;
    place.text =
        reading.body(body).name + "." + shown_name(reading.body(body).outline.edges[static_cast<std::size_t>(edge)]);
    place.source = entry.value.source();
    return place;
  };
  std::vector<const Outline*> outlines;
  for (std::size_t b = 0; b < reading.model.bodies.size(); ++b) {
    const bool named =
        !between.bodies || (*between.bodies)[0] == static_cast<int>(b) || (*between.bodies)[1] == static_cast<int>(b);
    outlines.push_back(named && reading.bodies[b].shape ? &reading.model.bodies[b].outline : nullptr);
  }
  int number = 0;
  int rigid_body = -1;  // the first that a tie would join
  for (const geometry::TouchingEdges& pair : geometry::touching_edges(outlines, touching.reach)) {
    const int rigid = reading.body(pair.body_a).rigid + reading.body(pair.body_b).rigid;
    const auto is_straight = [&](int body, int edge) {
      return geometry::runs_straight(reading.body(body).outline.edges[static_cast<std::size_t>(edge)]);
    };
    if (rigid == 2 && (!is_straight(pair.body_a, pair.edge_a) || !is_straight(pair.body_b, pair.edge_b) ||
                       reading.model.analysis.revolved()))
      continue;  // of two rigid bodies only straight lines are in contact
    if (is_tie && rigid > 0) {
      if (rigid_body < 0) rigid_body = reading.body(pair.body_a).rigid ? pair.body_a : pair.body_b;
      continue;
    }
    if (model::is_side_face(reading.body(pair.body_a), pair.edge_a) ||
        model::is_side_face(reading.body(pair.body_b), pair.edge_b))
      continue;
    const bool swapped = between.bodies && (*between.bodies)[0] == pair.body_b;
    const Place a = edge_place(swapped ? pair.body_b : pair.body_a, swapped ? pair.edge_b : pair.edge_a);
    const Place b = edge_place(swapped ? pair.body_a : pair.body_b, swapped ? pair.edge_a : pair.edge_b);
    if (!taken.insert(a, b)) continue;
    const auto named = [&](auto joint) {
      joint.name = fmt::format("{}_{}", entry.key, ++number);
      joint.a = a;
      joint.b = b;
      return joint;
    };
    if (const Contact* contact = std::get_if<Contact>(&touching.law)) {
      reading.contacts_of_entry[entry.key].push_back(static_cast<int>(reading.model.contacts.size()));
      reading.model.contacts.push_back(named(*contact));
    } else
      reading.model.ties.push_back(named(std::get<Tie>(touching.law)));
  }
  if (number == 0 && reading.report.clean())
    reading.report.error(
        entry.value, rigid_body >= 0
                         ? fmt::format("'{}' is rigid, but a tie joins elastic bodies: use a contact with 'bond: true'",
                                       reading.body(rigid_body).name)
                         : nothing_touches(reading, outlines, is_tie));
}

std::optional<Contact> read_contact(Reading& reading, ContactProperties& properties, const Entry& entry,
                                    Between& between_of, double& reach) {
  Report& report = reading.report;
  const std::size_t before = report.count();
  const MapReader map(report, entry.value,
                      {"between", "reach", "property", "friction", "gap", "fit_in", "cohesion", "tension", "bond",
                       "shear_strength", "slip", "about", "modulus"},
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
  if (!read_law_or_property(report, map, properties, contact)) reading.conditions_known = false;
  if (const auto slip = map.get("slip"))
    if (const auto kind = read_text(report, *slip)) {
      contact.large_slip = *kind == "large";
      if (*kind != "large" && *kind != "small")
        report.error(*slip,
                     fmt::format("must be small or large, not '{}'{}", *kind, suggestion(*kind, {"small", "large"})));
    }
  if (const auto about = map.get("about")) contact.about = read_vector(report, *about).value_or(Vec2::Zero());
  if (const auto modulus = map.get("modulus")) contact.modulus = number_or_unread(reading, modulus);
  if (const auto gap = map.get("gap")) contact.gap = read_number(report, *gap).value_or(0.0);
  if (contact.bond && map.has("gap")) map.refuse("gap", no_gap_beside_bond);
  if (const auto fit = map.get("fit_in")) {
    if (contact.bond)
      map.refuse("fit_in", "a bonded contact keeps its initial position: leave 'fit_in' out, or 'bond'");
    else
      reading.fits_of_contacts.emplace_back(entry.key, *fit);
  }
  if (report.count() > before || !between) return {};
  between_of = *between;
  if (between->many) return contact;
  contact.a = between->edges->first;
  contact.b = between->edges->second;
  return contact;
}

/// What is read of contacts and ties: those that name their edges enter the model, the others come after them.
struct Joints {
  Taken taken;
  std::vector<Touching> touching;
};

void read_contact_entry(Reading& reading, ContactProperties& properties, const Entry& entry, Joints& joints) {
  Between between;
  double reach = 0.0;
  auto contact = read_contact(reading, properties, entry, between, reach);
  if (!contact) {
    reading.conditions_known = false;
  } else if (between.many) {
    joints.touching.push_back({&entry, std::move(*contact), between, reach});
  } else {
    joints.taken.insert(contact->a, contact->b);
    reading.contacts_of_entry[entry.key].push_back(static_cast<int>(reading.model.contacts.size()));
    reading.model.contacts.push_back(std::move(*contact));
  }
}

void read_tie_entry(Reading& reading, const Entry& entry, Joints& joints) {
  const MapReader map(reading.report, entry.value, {"between"}, tie_example);
  const auto value = map.need("between");
  if (!value) reading.places_known = false;
  const auto between = value ? read_partners(reading, *value) : std::nullopt;
  if (!between) return;
  Tie tie;
  tie.name = entry.key;
  tie.source = entry.key_source;
  if (between->many) {
    joints.touching.push_back({&entry, tie, *between, 0.0});
    return;
  }
  std::tie(tie.a, tie.b) = *between->edges;
  joints.taken.insert(tie.a, tie.b);
  reading.model.ties.push_back(std::move(tie));
}

}  // namespace

void read_contacts_and_ties(Reading& reading, const std::optional<Value>& properties_section,
                            const std::optional<Value>& contacts, const std::optional<Value>& ties) {
  const std::size_t before = reading.report.count();
  std::vector<Entry> named_contacts, named_ties;
  if (contacts)
    named_contacts = read_named(reading.report, *contacts, "contacts",
                                "{joint: {between: [lower.top, upper.bottom], friction: 0.2}}");
  if (ties) named_ties = read_named(reading.report, *ties, "ties", "{glue: {between: [wall.bottom, base.top]}}");
  if (reading.report.count() > before) reading.places_known = reading.conditions_known = false;
  Joints joints;
  ContactProperties properties = read_properties(reading.report, properties_section);
  for (const Entry& entry : named_contacts) read_contact_entry(reading, properties, entry, joints);
  tell_of_unused(properties, reading.model.warnings);
  for (const Entry& entry : named_ties) read_tie_entry(reading, entry, joints);
  // Contacts and ties that name their edges come first, then those between two bodies, then those between all; ties
  // before contacts.
  const auto rank = [](const Touching& touching) {
    return std::pair(!touching.between.bodies.has_value(), std::holds_alternative<Contact>(touching.law));
  };
  std::stable_sort(joints.touching.begin(), joints.touching.end(),
                   [&](const Touching& a, const Touching& b) { return rank(a) < rank(b); });
  for (const Touching& all : joints.touching) add_touching(reading, all, joints.taken);
}

}  // namespace scabo::input
