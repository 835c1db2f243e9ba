// Edges and points of bodies in space, beside the faces of read_solid_bodies.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scabo/input/space/space_reader.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

namespace {

/// Whether a place is an edge or a point.
bool names_line(const Value& value) {
  if (value.node->kind != Node::Kind::map) return false;
  const auto has = [&](const char* key) { return value.node->find(key) != nullptr; };
  return has("edge") || has("point") || has("at");
}

}  // namespace

/// `{body: block, edge: [top, left]}`, `{body: block, point: [top, left, front]}`, of several the one that is nearest
/// to `near`; or `{body: block, at: [0, 0, 1]}`, the nearest node.
std::optional<SpaceFace> SpaceReader::edge_or_point(const Value& value) {
  const std::size_t before = report_.count();
  const MapReader map(report_, value, {"body", "edge", "point", "at", "near", "face", "normal"},
                      "{body: block, edge: [top, left]}");
  for (const char* key : {"face", "normal"})
    map.refuse(key, "gives a part of the boundary, and not an edge or a point: leave it out");
  const auto name = map.need("body"), edge = map.get("edge"), point = map.get("point"), at = map.get("at"),
             near = map.get("near");
  if (edge.has_value() + point.has_value() + at.has_value() > 1)
    report_.error(value, "has more than one of 'edge', 'point' and 'at': leave all but one out");
  if (at) map.refuse("near", "does not go together with 'at', which gives the nearest node: leave it out");
  SpaceFace place;
  place.source = value.source();
  if (name) place.body = body_named(*name);
  if (at) place.near = vector(*at);
  if (near) place.near = vector(*near);
  if (report_.count() > before || place.body < 0) return {};
  const SpaceBody& of = body_at(place.body);
  if (!of.mesh && !of.shape) return {};  // told with the body
  place.text = of.name;
  if (!at) meeting_faces(edge ? *edge : *point, edge ? 2 : 3, place);
  if (place.near)
    place.text += fmt::format(" near ({:.4g}, {:.4g}, {:.4g})", place.near->x(), place.near->y(), place.near->z());
  if (report_.count() > before) return {};
  return place;
}

/// `[top, left]`: names of `count` faces of the body of a place.
void SpaceReader::meeting_faces(const Value& value, std::size_t count, SpaceFace& place) {
  const char* example = count == 2 ? "[top, left]" : "[top, left, front]";
  const auto items = read_list(report_, value, example);
  if (items && items->size() != count)
    return report_.error(value, fmt::format("must be {} faces of the body that meet there, as in {}, not a list of {}",
                                            count == 2 ? "the two" : "three", example, items->size()));
  std::set<std::string> names;
  for (const Value& item : items.value_or(std::vector<Value>{})) {
    const auto text = read_text(report_, item);
    if (!text) continue;
    if (!names.insert(*text).second)
      report_.error(item, fmt::format("names the face {} twice: name faces that meet", quoted_name(*text)));
    SpaceFace face;
    face.body = place.body;
    face.source = item.source();
    face.text = body_at(place.body).name + "." + *text;
    find_face(item, *text, face);
    if (face.line_set >= 0)
      report_.error(item, fmt::format("is a curve of the mesh file: name it alone, as in {}", face.text));
    place.text += (place.meeting.empty() ? "." : "/") + *text;
    place.meeting.push_back(std::move(face));
  }
}

/// A face, an edge or a point of an elastic body; or what `face` takes.
std::optional<SpaceFace> SpaceReader::place(const Value& value, const char* or_body) {
  const auto found = names_line(value) ? edge_or_point(value) : face_or_curve(value, or_body);
  if (!found || !(found->is_edge() || found->is_point()) || !body_at(found->body).rigid) return found;
  report_.error(value, fmt::format("is {} of the rigid body '{}', on which all acts as a whole: write '{}', with 'at' "
                                   "for the point of a force",
                                   found->is_edge() ? "an edge" : "a point", body_at(found->body).name,
                                   body_at(found->body).name));
  return {};
}

/// A face, or where `or_body` names what may be on a whole one, a body.
std::optional<SpaceFace> SpaceReader::face(const Value& value, const char* or_body) {
  if (names_line(value)) {
    report_.error(value, "is an edge or a point, and a face is wanted here: name one, as in block.top");
    return {};
  }
  const auto found = face_or_curve(value, or_body);
  if (!found || !found->is_edge()) return found;
  report_.error(value, fmt::format("'{}' is a curve of the mesh file: name a face", found->text));
  return {};
}

/// Whether a load has a meaning where it is; else it is reported.
bool SpaceReader::check_place_of_load(const Value& on, const SpaceLoad& load) {
  using Kind = SpaceLoad::Kind;
  const SpaceFace& at = load.on;
  const std::size_t before = report_.count();
  const bool is_line = at.is_edge() || at.is_point();
  const char* what = at.is_edge() ? "an edge" : "a point";
  if (is_line && (load.kind == Kind::pressure || load.kind == Kind::traction || load.kind == Kind::moment))
    report_.error(on, fmt::format("is {}, on which {} may act: give a face to this load", what,
                                  at.is_edge() ? "a 'force' or 'line_load'" : "a 'force'"));
  if (load.kind == Kind::line_load && !at.is_edge() && !at.is_set_of_nodes())
    report_.error(on, fmt::format("is {}: a 'line_load' acts along an edge, as in {{body: {}, edge: [top, left]}}",
                                  at.is_point() ? "a point" : "a face", body_at(at.body).name));
  if (load.kind == Kind::line_load && body_at(at.body).rigid && report_.count() == before)
    report_.error(on, "is a set of nodes of a rigid body, on which a 'force' acts: name the body alone");
  if (is_line && load.at)
    report_.error(on, fmt::format("is {}: 'at' is the point of a force on a face or a rigid body; leave it out", what));
  return report_.count() == before;
}

}  // namespace scabo::input
