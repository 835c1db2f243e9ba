#include "scabo/mesh/plane/interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/mesh/plane/contact_side.hpp"
#include "scabo/mesh/plane/crack_faces.hpp"
#include "scabo/mesh/plane/edge_ends.hpp"
#include "scabo/mesh/plane/node_matching.hpp"
#include "scabo/mesh/plane/shared_points.hpp"

namespace scabo::mesh {

namespace {

/// Distance beyond the end of a rigid edge, relative to its length, up to which a foot still counts as on it.
constexpr double end_tolerance = 1e-9;

using Partners = std::vector<std::array<int, 2>>;  // positions in side A, side B; -1 on a rigid side

double largest_coordinate(const std::vector<ContactPair>& pairs) {
  double largest = 0.0;
  for (const ContactPair& pair : pairs) {
    largest = std::max({largest, pair.point_a.cwiseAbs().maxCoeff(), pair.point_b.cwiseAbs().maxCoeff()});
  }
  return largest;
}

std::string text_of(const Vec2& point) { return fmt::format("({:.6g}, {:.6g})", point.x(), point.y()); }

/// The midpoint of the pair, which does not change if A and B are swapped.
Vec2 middle_of(const ContactPair& pair) { return 0.5 * (pair.point_a + pair.point_b); }

/// Matches one contact, with the data common to all steps.
class Matching {
 public:
  Matching(const model::Model& model, const Joint& joint, const std::vector<BodyMesh>& bodies)
      : model_(model),
        contact_(joint),
        body_a_(model.bodies[contact_.a.body]),
        body_b_(model.bodies[contact_.b.body]),
        edge_a_(geometry::translated(body_a_.outline.edges[contact_.a.index], contact_.moved[0])),
        edge_b_(geometry::translated(body_b_.outline.edges[contact_.b.index], contact_.moved[1])) {
    if (!body_a_.rigid) side_a_ = side_of(contact_.a, edge_a_, bodies, contact_.moved[0]);
    if (!body_b_.rigid) side_b_ = side_of(contact_.b, edge_b_, bodies, contact_.moved[1]);
  }

  std::variant<Interface, Diagnostic> run() {
    const std::optional<Diagnostic> wrong = side_a_ && side_b_   ? pair_nodes()
                                            : side_a_ || side_b_ ? pair_with_rigid()
                                                                 : pair_rigid();
    if (wrong) return *wrong;
    if (interface_.pairs.empty()) return std::move(interface_);  // the sides have left each other
    if (const std::optional<Diagnostic> back = back_to_back()) return *back;
    order_pairs();
    set_gaps(interface_.pairs, contact_.gap);
    return std::move(interface_);
  }

  /// Whether an element of one side has no equal one on the other side, or is longer than the rigid side.
  bool is_unlike() const { return unlike_; }

 private:
  static bool holds(const model::Body& body, const Vec2& point) {
    return geometry::encloses(body.outline, point) != body.outside;
  }

  static ContactSide side_of(const model::Place& place, const model::Edge& edge, const std::vector<BodyMesh>& bodies,
                             const Vec2& moved) {
    const BodyMesh& mesh = bodies[place.body];
    if (moved.isZero(0.0)) return {edge, mesh.edges[place.index], mesh.nodes};
    std::vector<Vec2> nodes = mesh.nodes;
    for (Vec2& node : nodes) node += moved;
    return {edge, mesh.edges[place.index], nodes};
  }

  Diagnostic mistake(std::string message) const { return {contact_.source, std::move(message)}; }

  Diagnostic not_facing() const {
    return mistake(fmt::format("{} and {} do not face each other: name the two edges that touch", contact_.a.text,
                               contact_.b.text));
  }

  Diagnostic not_overlapping() const {
    return mistake(fmt::format("{} and {} are nowhere opposite each other: move a body, or name other edges",
                               contact_.a.text, contact_.b.text));
  }

  std::optional<Diagnostic> pair_nodes() {
    const ContactSide& a = *side_a_;
    const ContactSide& b = *side_b_;
    NodeMatching matching = match_nodes(a, b);
    const auto some = [&](Lie lie) {
      return std::count(matching.lies_a.begin(), matching.lies_a.end(), lie) +
                 std::count(matching.lies_b.begin(), matching.lies_b.end(), lie) >
             0;
    };
    if (matching.lone) return not_matching(*matching.lone);
    // Bodies with one linear element per edge meet only at the ends of their edges; two single corners are not an edge.
    const bool overlap = matching.partners.size() > 1 || (some(Lie::face_to_face) && !matching.partners.empty());
    if (!overlap && contact_.has_moved()) return std::nullopt;
    if (!overlap) return some(Lie::averted) ? not_facing() : not_overlapping();

    partners_ = std::move(matching.partners);
    unlike_ = matching.unlike;
    const bool alike = touch_everywhere(), arcs = alike && edge_a_.arc && edge_b_.arc;
    const bool chords = arcs && has_chords(), close = !arcs || touches();
    const auto is_end = [](const ContactSide& side, int node) {
      return !side.closed && (node == 0 || node + 1 == side.size());
    };
    for (const auto& [i, j] : partners_) {
      const bool weighted = alike && close && (!chords || is_end(a, i) || is_end(b, j));
      interface_.pairs.push_back({.node_a = a.nodes[i],
                                  .node_b = b.nodes[j],
                                  .point_a = a.points[i],
                                  .point_b = b.points[j],
                                  .normal = weighted ? common_normal(a.normals[i], b.normals[j])
                                                     : common_normal(a.true_normals[i], b.true_normals[j])});
    }
    return std::nullopt;
  }

  /// Whether the two edges have, but for a gap, the same shape; chains count as such.
  bool touch_everywhere() const {
    if (edge_a_.is_chain() || edge_b_.is_chain()) return true;
    if (!edge_a_.arc || !edge_b_.arc) return !edge_a_.arc && !edge_b_.arc;
    const double radius = std::max(edge_a_.arc->radius, edge_b_.arc->radius);
    return (edge_a_.arc->centre - edge_b_.arc->centre).norm() <= 1e-6 * radius;
  }

  /// Whether one of two arcs consists of chords. Normals weighted like the forces of a pressure turn to and fro between
  /// chords of different lengths l by up to l / (4 R). A gap or a slip d along them moves the nodes to and fro by d l /
  /// (4 R), and the stress of that, about E d / (4 R), may be as large as the pressure, however short the chords are. A
  /// uniform pressure along the normals of the arcs differs from that on the chords by less, the shorter they are.
  bool has_chords() const {
    const auto of_chords = [](const ContactSide& side) {
      return std::any_of(side.elements.begin(), side.elements.end(),
                         [](const LineElement& element) { return element.nodes.size() == 2; });
    };
    return of_chords(*side_a_) || of_chords(*side_b_);
  }

  /// Whether two arcs are not apart and not joined to other bodies. A third body may meet them in a point, with a
  /// contact of its own. Normals there that are weighted share its forces between the two contacts exactly. Where the
  /// sides are apart or overlap by d, however, two normals at an angle a in one point make slips of d a, in opposite
  /// directions, with their friction; and where the third body is joined to one of the two, only this angle decides
  /// which contact carries how much, and what resists a ring that turns about its shaft. Such arcs have the normals of
  /// the arc.
  bool touches() const {
    return std::abs(edge_a_.arc->radius - edge_b_.arc->radius) <= 1e-9 * edge_a_.arc->radius && !feels_two_normals();
  }

  /// Whether this contact or another one on the circles of these two arcs has a gap, an overlap or a joined body: if
  /// only some pieces of a ring have, the weighted normals of the others alone resist that it turns.
  bool feels_two_normals() const {
    const std::vector<bool> joined = joined_to_others(model_);
    const auto feels = [&](const auto& joint) { return mesh::feels_two_normals(joined, joint, joint.gap); };
    const auto circle_of = [&](const model::Place& side) {
      return model_.bodies[side.body].outline.edges[side.index].arc;
    };
    const auto is_on = [&](const model::Place& arc, const model::Contact& contact) {
      const auto is_beside = [&](const model::Place& side) {
        if (side.kind != arc.kind || side.body != arc.body) return false;
        const auto one = circle_of(side), other = circle_of(arc);
        return one && other && (one->centre - other->centre).norm() <= 1e-6 * other->radius &&
               std::abs(one->radius - other->radius) <= 1e-6 * other->radius;
      };
      return is_beside(contact.a) || is_beside(contact.b);
    };
    return feels(contact_) ||
           std::any_of(model_.contacts.begin(), model_.contacts.end(), [&](const model::Contact& other) {
             return (is_on(contact_.a, other) || is_on(contact_.b, other)) && feels(other);
           });
  }

  Diagnostic not_matching(const LoneNode& lone) const {
    std::string remedy = "give both bodies the same mesh size and order along the contact";
    const double length = edge_a_.length();
    if (std::abs(edge_b_.length() - length) > 1e-6 * length) {
      remedy += ", and let the ends of the shorter edge fall on nodes of the longer one";
    }
    const std::string& here = lone.on_a ? contact_.a.text : contact_.b.text;
    const std::string& there = lone.on_a ? contact_.b.text : contact_.a.text;
    const ContactSide& side = lone.on_a ? *side_a_ : *side_b_;
    const ContactSide& other = lone.on_a ? *side_b_ : *side_a_;
    return mistake(
        fmt::format("the nodes of {} and {} do not match: first at {} on {}, whose nearest node on {} is {}, "
                    "{:.3g} away along the edge; {}",
                    contact_.a.text, contact_.b.text, text_of(side.points[lone.node]), here, there,
                    text_of(other.points[lone.nearest]), lone.along, remedy));
  }

  /// Whether what lies on the rigid edge is more than a corner at one of its ends.
  static bool share_length(const model::Edge& rigid, const std::vector<std::optional<geometry::Foot>>& feet,
                           double tolerance) {
    if ((rigid.at(0.0) - rigid.at(1.0)).norm() <= tolerance * rigid.length()) return true;  // closed: it has no ends
    double first = 1.0, last = 0.0;
    for (const std::optional<geometry::Foot>& foot : feet) {
      if (!foot) continue;
      first = std::min(first, foot->t);
      last = std::max(last, foot->t);
    }
    return first < 1.0 - tolerance && last > tolerance;
  }

  std::optional<Diagnostic> pair_with_rigid() {
    const bool a_is_rigid = !side_a_;
    const ContactSide& side = a_is_rigid ? *side_b_ : *side_a_;
    const model::Edge& edge = a_is_rigid ? edge_a_ : edge_b_;
    unlike_ = are_within_elements(ends_of_rigid(edge, *side.edge), side);
    const double tolerance = std::max(end_tolerance, matching_tolerance * side.element_length / edge.length());
    std::vector<std::optional<geometry::Foot>> feet(side.size());
    bool over = false;
    bool facing = false;
    for (int i = 0; i < side.size(); ++i) {
      const std::optional<geometry::Foot> foot = geometry::foot_on(edge, side.points[i]);
      if (!foot || foot->t < -tolerance || foot->t > 1.0 + tolerance) continue;
      over = true;
      const double cosine = side.normals[i].dot(foot->normal);
      facing |= cosine <= facing_cosine;
      if (cosine <= pairing_cosine) feet[i] = foot;
    }
    if (!over && contact_.has_moved()) return std::nullopt;
    if (!over && !unlike_) return not_overlapping();
    if (!over) {
      const auto& [elastic, rigid] = a_is_rigid ? std::tie(contact_.b, contact_.a) : std::tie(contact_.a, contact_.b);
      return mistake(fmt::format(
          "no node of {} lies opposite the rigid {}: move a body, name other edges, or use a smaller mesh size",
          elastic.text, rigid.text));
    }
    if (!facing) return not_facing();
    if (!share_length(edge, feet, tolerance)) {
      if (contact_.has_moved()) return std::nullopt;
      return not_overlapping();
    }

    // A closed edge may be paired across its first node: start after a node without a partner.
    int first = 0;
    while (side.closed && feet[first] && first + 1 < side.size()) ++first;
    for (int k = 0; k < side.size(); ++k) {
      const int i = (first + k) % side.size();
      if (!feet[i]) continue;
      partners_.push_back(a_is_rigid ? std::array{-1, i} : std::array{i, -1});
      ContactPair pair;
      (a_is_rigid ? pair.node_b : pair.node_a) = side.nodes[i];
      pair.point_a = a_is_rigid ? feet[i]->point : side.points[i];
      pair.point_b = a_is_rigid ? side.points[i] : feet[i]->point;
      pair.normal = a_is_rigid ? feet[i]->normal : Vec2(-feet[i]->normal);
      interface_.pairs.push_back(pair);
    }
    return std::nullopt;
  }

  /// The two straight edges of rigid bodies face each other in a stretch, whose ends are the pairs.
  std::optional<Diagnostic> pair_rigid() {
    const auto along = [](const model::Edge& edge) { return Vec2((edge.end - edge.start).normalized()); };
    const Vec2 of_a = along(edge_a_), of_b = along(edge_b_), t = (of_a - of_b).normalized();
    if (of_a.dot(of_b) > facing_cosine) return not_facing();
    const auto stretch = [&](const model::Edge& edge) { return std::minmax({edge.start.dot(t), edge.end.dot(t)}); };
    const auto [first_a, last_a] = stretch(edge_a_);
    const auto [first_b, last_b] = stretch(edge_b_);
    const double first = std::max(first_a, first_b), last = std::min(last_a, last_b);
    if (last - first <= end_tolerance * std::min(edge_a_.length(), edge_b_.length())) return not_overlapping();
    const auto point_at = [&](const model::Edge& edge, const Vec2& direction, double s) {
      return Vec2(edge.start + direction * ((s - edge.start.dot(t)) / direction.dot(t)));
    };
    for (const double s : {first, last}) {
      ContactPair pair;
      pair.point_a = point_at(edge_a_, of_a, s);
      pair.point_b = point_at(edge_b_, of_b, s);
      pair.normal = Vec2(t.y(), -t.x());  // out of A, whose boundary runs counter-clockwise
      partners_.push_back({-1, -1});
      interface_.pairs.push_back(pair);
    }
    return std::nullopt;
  }

  /// Whether the overlap can be judged at a pair: not at an end, where x_B - x_A may lie along other edges.
  std::vector<ContactPair> inner_pairs() const {
    const std::vector<ContactPair>& pairs = interface_.pairs;
    if (pairs.size() > 2) return {pairs.begin() + 1, pairs.end() - 1};
    if (pairs.size() < 2 || edge_a_.arc || edge_b_.arc) return {};
    ContactPair middle = pairs[0];
    middle.point_a = 0.5 * (pairs[0].point_a + pairs[1].point_a);
    middle.point_b = 0.5 * (pairs[0].point_b + pairs[1].point_b);
    return {middle};
  }

  /// An overlap is an interference only if both bodies have material between the two points. Otherwise the edges are
  /// the far sides of the bodies (the bottom of the lower one, the top of the upper one).
  std::optional<Diagnostic> back_to_back() const {
    std::optional<ContactPair> deepest;
    double depth = matching_tolerance * std::min(edge_a_.length(), edge_b_.length());
    for (const ContactPair& pair : inner_pairs()) {
      const double overlap = (pair.point_a - pair.point_b).dot(pair.normal);
      if (overlap <= depth) continue;
      depth = overlap;
      deepest = pair;
    }
    if (!deepest) return std::nullopt;
    for (const double s : {0.25, 0.75}) {
      const Vec2 point = deepest->point_a + s * (deepest->point_b - deepest->point_a);
      if (holds(body_a_, point - contact_.moved[0]) && holds(body_b_, point - contact_.moved[1])) return std::nullopt;
    }
    return mistake(
        fmt::format("{} and {} face away from each other at a distance of {:.3g}: name the two edges that touch",
                    contact_.a.text, contact_.b.text, depth));
  }

  bool is_closed() const {
    if (!side_a_ && !side_b_) return false;
    const ContactSide& side = side_a_ ? *side_a_ : *side_b_;
    return side.closed && (!side_a_ || !side_b_ || side_b_->closed) && partners_.size() >= side.nodes.size();
  }

  void order_pairs() {
    std::vector<ContactPair>& pairs = interface_.pairs;
    bool reverse = runs_backwards(middle_of(pairs.front()), middle_of(pairs.back()));
    if (is_closed()) {  // counter-clockwise, from the pair with the smallest x
      double area = 0.0;
      std::size_t first = 0;
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const Vec2 middle = middle_of(pairs[k]);
        area += cross(middle, middle_of(pairs[(k + 1) % pairs.size()]));
        if (middle.x() < middle_of(pairs[first]).x()) first = k;
      }
      reverse = area < 0.0;
      first += reverse ? 1 : 0;
      std::rotate(pairs.begin(), pairs.begin() + first, pairs.end());
      std::rotate(partners_.begin(), partners_.begin() + first, partners_.end());
    }
    if (!reverse) return;
    std::reverse(pairs.begin(), pairs.end());
    std::reverse(partners_.begin(), partners_.end());
  }

  const model::Model& model_;
  Joint contact_;
  const model::Body& body_a_;
  const model::Body& body_b_;
  const model::Edge edge_a_;  // where they have moved
  const model::Edge edge_b_;
  std::optional<ContactSide> side_a_;  // nothing when A is rigid
  std::optional<ContactSide> side_b_;
  Partners partners_;  // of interface_.pairs
  Interface interface_;
  bool unlike_ = false;
};

}  // namespace

void set_gaps(std::vector<ContactPair>& pairs, double added) {
  // Coordinates have rounding errors; an interface that touches gets gaps of exactly 0, also if it is rotated.
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * largest_coordinate(pairs);
  for (ContactPair& pair : pairs) {
    const double gap = (pair.point_b - pair.point_a).dot(pair.normal);
    pair.gap = (std::abs(gap) <= rounding ? 0.0 : gap) + added;
  }
}

std::vector<Joint> joints_of(const model::Model& model, const Placement& placement) {
  std::vector<Joint> joints;
  for (const model::Contact& contact : model.contacts) {
    joints.push_back(joint_of(contact));
    if (!placement.empty()) joints.back().moved = placement[joints.size() - 1];
  }
  for (const model::Tie& tie : model.ties) joints.push_back(joint_of(tie));
  return joints;
}

std::variant<Interface, Diagnostic> match_interface(const model::Model& model, const Joint& joint,
                                                    const std::vector<BodyMesh>& bodies) {
  return Matching(model, joint, bodies).run();
}

std::variant<Interface, Diagnostic> match_interface(const model::Model& model, int contact,
                                                    const std::vector<BodyMesh>& bodies, const Placement& placement) {
  const auto c = static_cast<std::size_t>(contact);
  if (model.contacts[c].a.kind == model::Place::Kind::face) return crack_interface(model, contact, bodies);
  Joint joint = joint_of(model.contacts[c]);
  if (!placement.empty()) joint.moved = placement[c];
  auto matched = match_interface(model, joint, bodies);
  if (Interface* interface = std::get_if<Interface>(&matched)) interface->contact = contact;
  return matched;
}

namespace {

/// The sides of a tie may be this far apart, relative to the length of the shorter one.
constexpr double tie_tolerance = 1e-6;

std::optional<Diagnostic> apart(const model::Model& model, const model::Tie& tie, const Interface& interface) {
  const auto length = [&](const model::Place& place) {
    return model.bodies[static_cast<std::size_t>(place.body)]
        .outline.edges[static_cast<std::size_t>(place.index)]
        .length();
  };
  const ContactPair* worst = nullptr;
  double distance = tie_tolerance * std::min(length(tie.a), length(tie.b));
  for (const ContactPair& pair : interface.pairs) {
    if ((pair.point_b - pair.point_a).norm() <= distance) continue;
    distance = (pair.point_b - pair.point_a).norm();
    worst = &pair;
  }
  if (worst == nullptr) return std::nullopt;
  return Diagnostic{tie.source, fmt::format("{} and {} are {:.3g} apart at {}: the two edges of a tie must lie on each "
                                            "other; move a body, or use a contact with 'bond: true'",
                                            tie.a.text, tie.b.text, distance, text_of(worst->point_a))};
}

}  // namespace

PairingFaults add_interfaces(const model::Model& model, Mesh& mesh) {
  mesh.interfaces.clear();
  mesh.ties.clear();
  PairingFaults faults;
  std::vector<Diagnostic>& mistakes = faults.mistakes;
  const std::vector<Joint> joints = joints_of(model, mesh.placement);
  const auto match = [&](std::size_t j) {
    Matching matching(model, joints[j], mesh.bodies);
    auto matched = matching.run();
    if (matching.is_unlike()) faults.unlike.push_back(j);
    return matched;
  };
  const auto has_mesh = [&](const model::Place& place) {  // otherwise its mistake has been reported
    const auto b = static_cast<std::size_t>(place.body);
    return model.bodies[b].rigid || !mesh.bodies[b].nodes.empty();
  };
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const model::Contact& contact = model.contacts[c];
    const auto is = [&](model::Place::Kind kind) { return contact.a.kind == kind && contact.b.kind == kind; };
    ensure(is(model::Place::Kind::edge) || is(model::Place::Kind::face), "a contact is between two edges or two faces");
    if (!has_mesh(contact.a) || !has_mesh(contact.b)) continue;
    auto matched = contact.a.kind == model::Place::Kind::face ? crack_interface(model, static_cast<int>(c), mesh.bodies)
                                                              : match(c);
    if (const Diagnostic* wrong = std::get_if<Diagnostic>(&matched)) {
      mistakes.push_back(*wrong);
      continue;
    }
    mesh.interfaces.push_back(std::get<Interface>(std::move(matched)));
    mesh.interfaces.back().contact = static_cast<int>(c);
  }
  share_normals(model, mesh);
  for (std::size_t t = 0; t < model.ties.size(); ++t) {
    const model::Tie& tie = model.ties[t];
    if (!has_mesh(tie.a) || !has_mesh(tie.b)) continue;
    auto matched = match(model.contacts.size() + t);
    if (const Diagnostic* wrong = std::get_if<Diagnostic>(&matched)) {
      mistakes.push_back(*wrong);
    } else if (const auto gap = apart(model, tie, std::get<Interface>(matched))) {
      mistakes.push_back(*gap);
    } else {
      mesh.ties.push_back(std::get<Interface>(std::move(matched)));
    }
  }
  return faults;
}

}  // namespace scabo::mesh
