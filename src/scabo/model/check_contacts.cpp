// Validation of contacts and ties: their two edges or faces, and the laws of contacts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

constexpr double largest_coefficient = 1e6;  // for larger values the forces in balance are lost in rounding

/// One side of a contact or tie (`what`): an edge without a crack mouth, or the face of a crack between cells.
bool check_side(Checking& checking, const std::string& path, const char* what, const Place& place) {
  if (!check_place(checking, path, place)) return false;
  const std::string text = text_of(checking.model, place);
  if (place.kind == Place::Kind::face) {
    if (has_divided_faces(checking.body(place.body))) return true;
    checking.error(
        path, "",
        checking.body(place.body).cracks.empty()
            ? fmt::format("'{}' is a side face, which has no nodes between its ends: move the scaling centre "
                          "away from its end",
                          text)
            : fmt::format("'{}' is a side face, which has no nodes between its ends: for contact between "
                          "the faces of a crack, write mesh: {{kind: polygons, ...}}, and give the crack as "
                          "a path: [mouth, tip]",
                          text));
    return false;
  }
  if (place.kind != Place::Kind::edge) {
    checking.error(path, "",
                   fmt::format("a {} is between two edges, as in [lower.top, upper.bottom]; '{}' is not "
                               "an edge",
                               what, text));
    return false;
  }
  for (const Crack& crack : checking.body(place.body).cracks)
    if (crack.edge == place.index) {
      checking.error(path, "",
                     fmt::format("the mouth of crack '{}' lies on '{}', but a {} needs an edge without a "
                                 "crack mouth: divide the edge, or name another one",
                                 crack.name, text, what));
      return false;
    }
  return true;
}

/// Sides of elastic bodies are matched as one line each: empty pixels must not interrupt the edge of an image.
bool check_unbroken(Checking& checking, const std::string& path, const char* what, const Place& side,
                    const Place& other) {
  const Body& body = checking.body(side.body);
  if (side.kind != Place::Kind::edge || !body.image || checking.body(other.body).rigid) return true;
  if (is_unbroken(*body.image, side.index)) return true;
  checking.error(
      path, "",
      fmt::format("empty pixels interrupt '{}', but the {} of two elastic bodies needs an unbroken edge: give "
                  "these pixels a material, or draw the body as a polygon",
                  text_of(checking.model, side), what));
  return false;
}

/// A contact with a face of a crack is one between its two faces.
bool check_faces(Checking& checking, const std::string& path, const char* what, const Place& a, const Place& b) {
  if (std::string_view(what) == "tie") {
    checking.error(path, "between", "the faces of a crack cannot be tied: use edges, or leave out the crack");
    return false;
  }
  if (a.kind == b.kind && a.body == b.body && a.index / 2 == b.index / 2 && a.index != b.index) return true;
  const Place& face = a.kind == Place::Kind::face ? a : b;
  const std::string crack = checking.body(face.body).name + "." +
                            checking.body(face.body).cracks[static_cast<std::size_t>(face.index / 2)].name;
  const char* wrong = a.kind != b.kind                         ? "a face of a crack and an edge are not in contact"
                      : a.body == b.body && a.index == b.index ? "both sides are the same face of a crack"
                                                               : "faces of different cracks are not in contact";
  checking.error(path, "between", fmt::format("{}: write [{}.left, {}.right]", wrong, crack, crack));
  return false;
}

bool check_sides(Checking& checking, const std::string& path, const char* what, const Place& side_a,
                 const Place& side_b) {
  const auto is_face = [](const Place& place) { return place.kind == Place::Kind::face; };
  for (const Place* place : {&side_a, &side_b})  // a crack does not hold its body
    if (checking.is_body(place->body) && !is_face(*place)) checking.touched[static_cast<std::size_t>(place->body)] = 1;
  const bool a = check_side(checking, path + ".between.0", what, side_a);
  const bool told = !a && is_face(side_a) && is_face(side_b) && side_a.body == side_b.body;
  const bool b = !told && check_side(checking, path + ".between.1", what, side_b);
  if (!checking.is_body(side_a.body) || !checking.is_body(side_b.body)) return false;
  if (is_face(side_a) || is_face(side_b)) return a && b && check_faces(checking, path, what, side_a, side_b);
  if (side_a.body == side_b.body) {
    checking.error(
        path, "between",
        fmt::format("a body cannot be {} itself: both edges belong to '{}'",
                    std::string_view(what) == "tie" ? "tied to" : "in contact with", checking.body(side_a.body).name));
    return false;
  }
  return a && b && check_unbroken(checking, path + ".between.0", what, side_a, side_b) &&
         check_unbroken(checking, path + ".between.1", what, side_b, side_a);
}

/// Two rigid bodies touch along straight lines, and do not slide far.
bool check_rigid_sides(Checking& checking, const std::string& path, const Contact& contact) {
  const Body& a = checking.body(contact.a.body);
  const Body& b = checking.body(contact.b.body);
  if (!a.rigid || !b.rigid) return true;
  const auto is_curved = [&](const Place& side) {
    const Outline& outline = checking.body(side.body).outline;
    return checking.sound_shape(side.body) &&
           !geometry::runs_straight(outline.edges[static_cast<std::size_t>(side.index)]);
  };
  if (is_curved(contact.a) || is_curved(contact.b))
    checking.error(
        path, "between",
        fmt::format("'{}' and '{}' are both rigid: their edges must be straight, or one of the bodies elastic", a.name,
                    b.name));
  else if (contact.large_slip)
    checking.error_of_key(path, "slip",
                          fmt::format("cannot be 'large' between '{}' and '{}', which are both rigid", a.name, b.name));
  else
    return true;
  return false;
}

/// What cannot be combined with large slip, whose pairs do not stay.
void check_large_slip(Checking& checking, const std::string& path, const Contact& contact) {
  if (!contact.large_slip) return;
  const Model& model = checking.model;
  const auto refuse = [&](bool given, const char* why) {
    if (given) checking.error_of_key(path, "slip", fmt::format("cannot be 'large' {}", why));
  };
  refuse(contact.bond, "beside 'bond: true', which prevents slip: leave out one of the two");
  refuse(contact.cohesion > 0.0 || contact.tension > 0.0,
         "beside a strength that is lost, because the pairs change: leave out 'cohesion' and 'tension'");
  refuse(contact.lasting_cohesion > 0.0,
         "beside a cohesion that pairs have while they are closed, because the pairs change: leave out 'cohesion'");
  refuse(contact.dynamic_friction.has_value(),
         "beside a coefficient of friction that falls with slip, because the pairs change: give one coefficient");
  refuse(!contact.friction_along.empty(),
         "beside a coefficient of friction that varies along the contact, because its sides move: give one "
         "coefficient, or divide the edge");
  refuse(has_stages(model.bodies),
         "in a model whose bodies are added or removed in steps: leave 'added' and 'removed' out");
  if (contact.a.kind != Place::Kind::edge || contact.b.kind != Place::Kind::edge)
    return refuse(true, "between the faces of a crack, which do not pass each other");
  const bool sound = checking.sound_shape(contact.a.body) && checking.sound_shape(contact.b.body);
  const auto straight = [&](const Place& place) {
    return geometry::runs_straight(checking.body(place.body).outline.edges[static_cast<std::size_t>(place.index)]);
  };
  refuse(sound && !straight(contact.a) && !straight(contact.b),
         "where both edges are curved: one of them must be straight, and the other one is moved along it");
  const auto has_tolerance = [](const Body& body) { return !body.rigid && body.mesh.tolerance.has_value(); };
  refuse(model.output.error || !model.output.error_of.empty() || model.tolerance ||
             std::any_of(model.bodies.begin(), model.bodies.end(), has_tolerance),
         "in an analysis with a tolerance or an estimated error, which needs meshes that stay: leave these out");
}

/// The bodies of a tie are elastic.
bool check_both_elastic(Checking& checking, const std::string& path, const Tie& tie) {
  for (const Place* side : {&tie.a, &tie.b})
    if (const Body& body = checking.body(side->body); body.rigid) {
      checking.error(
          path, "between",
          fmt::format("'{}' is rigid, but a tie joins elastic bodies: use a contact with 'bond: true'", body.name));
      return false;
    }
  return true;
}

/// Pairs of edges that are joined already, and by what.
class Joined {
 public:
  /// Reports a pair that is joined twice; `what`: `contact 'joint'`.
  void add(Checking& checking, const std::string& path, const Place& a, const Place& b, std::string what) {
    std::array<int, 4> pair{a.body, a.index, b.body, b.index};
    if (pair[0] > pair[2] || (pair[0] == pair[2] && pair[1] > pair[3])) pair = {pair[2], pair[3], pair[0], pair[1]};
    const auto [first, is_new] = pairs_.emplace(pair, std::move(what));
    if (!is_new)
      checking.error_of_key(
          path, "", fmt::format("{} already connects the same two edges: remove one of the two", first->second));
  }

 private:
  std::map<std::array<int, 4>, std::string> pairs_;
};

bool check_coefficient(Checking& checking, const std::string& path, std::string_view key, double friction) {
  if (!checking.not_negative(path, key, friction)) return false;
  if (friction <= largest_coefficient) return true;
  checking.error(path, key,
                 fmt::format("a coefficient of friction must be at most 1e6, not {}: 1e6 already prevents "
                             "slip, and 'bond: true' prevents both slip and opening",
                             number_text(friction)));
  return false;
}

bool check_along(Checking& checking, const std::string& path, const Contact& contact) {
  if (contact.dynamic_friction)
    checking.error_of_key(path, "friction.dynamic", "cannot be combined with 'along': leave one of them out");
  bool good = true;
  const FrictionPoint* before = nullptr;
  for (std::size_t i = 0; i < contact.friction_along.size(); ++i) {
    const FrictionPoint& point = contact.friction_along[i];
    const std::string key = fmt::format("friction.along.{}", i);
    const auto refuse = [&](std::string message) { checking.error(path, key, std::move(message)), good = false; };
    if (!checking.number(path, key, point.position) || !checking.number(path, key, point.friction))
      good = false;
    else if (point.friction > largest_coefficient)
      refuse(fmt::format("a coefficient of friction must be at most 1e6, not {}", number_text(point.friction)));
    else if (point.position < 0.0 || point.position > 1.0)
      refuse(fmt::format("a position along the contact must be from 0 to 1, not {}", number_text(point.position)));
    else if (point.friction < 0.0)
      refuse(fmt::format("a coefficient of friction must be 0 or more, not {}", number_text(point.friction)));
    else if (before != nullptr && point.position <= before->position)
      refuse("positions along the contact must be in ascending order");
    else
      before = &point;
  }
  return good;
}

/// `direction`: `.forward`, or nothing where there is one coefficient.
bool check_fall(Checking& checking, const std::string& path, const std::string& direction, double at_rest,
                double sliding) {
  const bool good = check_coefficient(checking, path, "friction.static" + direction, at_rest);
  if (!check_coefficient(checking, path, "friction.dynamic" + direction, sliding) || !good) return false;
  if (sliding <= at_rest) return true;
  checking.error(
      path, "friction.dynamic" + direction,
      fmt::format("must be at most the static coefficient {}, not {}", number_text(at_rest), number_text(sliding)),
      number_text(sliding));
  return false;
}

bool check_static_and_dynamic(Checking& checking, const std::string& path, const Contact& contact) {
  const double sliding = *contact.dynamic_friction;
  bool good = check_fall(checking, path, contact.backward_friction ? ".forward" : "", contact.friction, sliding);
  if (contact.backward_friction)
    good =
        check_fall(checking, path, ".backward", *contact.backward_friction, *contact.backward_dynamic_friction) && good;
  return checking.not_negative(path, "friction.slip_distance", contact.slip_distance) && good;
}

bool check_friction(Checking& checking, const std::string& path, const Contact& contact) {
  if (contact.backward_friction && !contact.friction_along.empty()) {
    checking.error_of_key(path, "friction.backward",
                          "cannot be combined with coefficients that vary along the contact: leave one of them out");
    return false;
  }
  if (contact.backward_dynamic_friction.has_value() != (contact.backward_friction && contact.dynamic_friction)) {
    checking.error_of_key(path, "friction.dynamic", "needs a coefficient against backward slip, as the static one has");
    return false;
  }
  if (!contact.friction_along.empty()) return check_along(checking, path, contact);
  if (contact.dynamic_friction) return check_static_and_dynamic(checking, path, contact);
  if (contact.backward_friction) {
    const bool forward = check_coefficient(checking, path, "friction.forward", contact.friction);
    return check_coefficient(checking, path, "friction.backward", *contact.backward_friction) && forward;
  }
  return check_coefficient(checking, path, "friction", contact.friction);
}

}  // namespace

void check_law(Checking& checking, const std::string& path, const Contact& contact) {
  bool good = check_friction(checking, path, contact);
  good = checking.not_negative(path, "cohesion", contact.cohesion) && good;
  good = checking.not_negative(path, "cohesion.lasting", contact.lasting_cohesion) && good;
  good = checking.not_negative(path, "tension", contact.tension) && good;
  if (contact.shear_strength) good = checking.not_negative(path, "shear_strength", *contact.shear_strength) && good;
  good = checking.number(path, "gap", contact.gap) && good;
  checking.vector(path, "about", contact.about);
  if (contact.modulus) good = checking.positive(path, "modulus", *contact.modulus) && good;
  if (!good) return;
  const auto refuse = [&](const char* key, bool given, const char* why) {
    if (given) checking.error_of_key(path, key, why);
  };
  const bool friction = contact.friction > 0.0 || contact.backward_friction || contact.dynamic_friction ||
                        !contact.friction_along.empty();
  refuse("modulus", contact.modulus && (contact.bond || contact.cohesion > 0.0),
         "is that of a bed of springs that only presses, which neither a bond nor a cohesion that is lost goes with: "
         "leave one of them out");
  if (contact.bond || contact.shear_strength) {
    const char* why = contact.bond ? no_effect_beside_bond : replaced_by_shear_strength;
    refuse("friction", friction, why);
    refuse("cohesion", contact.cohesion > 0.0 || contact.lasting_cohesion > 0.0, why);
    refuse("tension", contact.tension > 0.0, why);
    if (!contact.bond) return;
    refuse("shear_strength", contact.shear_strength.has_value(), why);
    refuse("gap", contact.gap != 0.0, no_gap_beside_bond);
    return;
  }
  if (contact.lasting_cohesion > 0.0)
    return refuse("tension", contact.tension > 0.0,
                  "is lost when a joint first opens or slips, and a lasting cohesion is not: leave out one of the two");
  refuse("tension", contact.tension > 0.0 && contact.cohesion == 0.0,
         "a joint that slips loses its tensile strength, and without 'cohesion' nothing prevents this one from "
         "slipping: give both");
}

void check_contacts_and_ties(Checking& checking) {
  const Model& model = checking.model;
  Joined joined;
  std::unordered_set<std::string> names, tie_names;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const Contact& contact = model.contacts[i];
    const std::string path = path_of_joint("contacts", contact.source, contact.name, i);
    checking.enter(contact.source);
    check_name(checking, path, contact.name, "contact", names);
    check_law(checking, path, contact);
    if (!check_sides(checking, path, "contact", contact.a, contact.b) || !check_rigid_sides(checking, path, contact)) {
      checking.gaps.conditions = true;
      continue;
    }
    check_large_slip(checking, path, contact);
    if (contact.modulus && checking.body(contact.a.body).rigid && checking.body(contact.b.body).rigid)
      checking.error(
          path, "modulus",
          "two rigid edges meet in two pairs, which are no bed: give one of the bodies a material and a mesh");
    joined.add(checking, path, contact.a, contact.b, fmt::format("contact '{}'", contact.name));
  }
  for (std::size_t i = 0; i < model.ties.size(); ++i) {
    const Tie& tie = model.ties[i];
    const std::string path = path_of_joint("ties", tie.source, tie.name, i);
    checking.enter(tie.source);
    check_name(checking, path, tie.name, "tie", tie_names);
    if (check_sides(checking, path, "tie", tie.a, tie.b) && check_both_elastic(checking, path, tie))
      joined.add(checking, path, tie.a, tie.b, fmt::format("tie '{}'", tie.name));
  }
}

}  // namespace scabo::model
