// Validation of places: bodies, edges, corners, points, side faces and crack mouths.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/geometry/box.hpp"
#include "scabo/model/checking.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::model {

namespace {

bool check_index(Checking& checking, const std::string& path, const Place& place, const char* what, std::size_t count) {
  if (place.index >= 0 && static_cast<std::size_t>(place.index) < count) return true;
  checking.error(path, "",
                 fmt::format("body '{}' has no {} number {}: it has {}, counted from 0", checking.body(place.body).name,
                             what, place.index, count));
  return false;
}

bool check_corner(Checking& checking, const std::string& path, const Place& place) {
  const Body& body = checking.body(place.body);
  if (!check_index(checking, path, place, "corner", body.outline.corners.size())) return false;
  if (place.index == body.mesh.centre_corner) {
    checking.error(path, "",
                   fmt::format("'{}' is the scaling centre, which has no node: no load or support can act "
                               "there",
                               text_of(checking.model, place)));
    return false;
  }
  if (body.image && !corners_with_material(*body.image)[static_cast<std::size_t>(place.index)]) {
    checking.error(path, "",
                   fmt::format("the pixel of the image at '{}' is empty: name an edge, or a point by 'near'",
                               text_of(checking.model, place)));
    return false;
  }
  for (const Crack& crack : body.cracks)
    if (crack.at == 0.0 && crack.edge == place.index) {
      checking.error(path, "",
                     fmt::format("'{0}' is the mouth of crack '{1}', where there are two nodes: write "
                                 "{2}.{1}.mouth_left or {2}.{1}.mouth_right",
                                 text_of(checking.model, place), crack.name, body.name));
      return false;
    }
  return true;
}

bool check_near(Checking& checking, const std::string& path, const Place& place) {
  const Body& body = checking.body(place.body);
  if (!checking.vector(path, "near", place.near)) return false;
  if (body.rigid) {
    checking.error(path, "near", "a rigid body has no nodes, so that 'near' does not apply: name a corner or the body");
    return false;
  }
  double distance = (body.outline.edges.front().start - place.near).norm();
  for (const Edge& edge : body.outline.edges) distance = std::min(distance, (edge.at(0.5) - place.near).norm());
  if (distance <= 2.0 * geometry::outline_size(body.outline)) return true;
  checking.error(path, "near",
                 fmt::format("{} is not near '{}': its distance is {:.3g}, and the size of the body {:.3g}; correct "
                             "the coordinates",
                             point_text(place.near), body.name, distance, geometry::outline_size(body.outline)));
  return false;
}

bool check_face(Checking& checking, const std::string& path, const Place& place) {
  const Body& body = checking.body(place.body);
  const bool mouth = place.kind == Place::Kind::mouth;
  if (mouth ? body.cracks.empty() || has_divided_faces(body) : !body.open() && !has_divided_faces(body)) {
    checking.error(path, "",
                   fmt::format("body '{}' has no {}", body.name,
                               mouth ? "crack, and so no crack mouth"
                                     : "side faces: it has no crack, and its scaling centre is on no corner"));
    return false;
  }
  if (!mouth && has_divided_faces(body))
    return check_index(checking, path, place, "face of a crack", 2 * body.cracks.size());
  return check_index(checking, path, place, mouth ? "crack mouth" : "side face", 2);
}

}  // namespace

bool check_place(Checking& checking, const std::string& path, const Place& place) {
  if (!checking.is_body(place.body)) {
    checking.gaps.places = true;
    checking.error(path, "",
                   fmt::format("there is no body number {}: the model has {}, counted from 0", place.body,
                               checking.model.bodies.size()));
    return false;
  }
  if (!checking.sound_shape(place.body) || !checking.sound_faces(place.body)) return false;
  const Body& body = checking.body(place.body);
  switch (place.kind) {
    case Place::Kind::body:
      return true;
    case Place::Kind::edge:
      if (!check_index(checking, path, place, "edge", body.outline.edges.size())) return false;
      if (!is_side_face(body, place.index)) return true;
      checking.error(path, "",
                     fmt::format("'{}' is a side face, which has no boundary elements: use a place of kind "
                                 "face",
                                 text_of(checking.model, place)));
      return false;
    case Place::Kind::corner:
      return check_corner(checking, path, place);
    case Place::Kind::near:
      return check_near(checking, path, place);
    case Place::Kind::face:
    case Place::Kind::mouth:
      return check_face(checking, path, place);
  }
  checking.error(path, "", "is no place: its kind is not known");
  return false;
}

std::string endless_face(const Model& model, const Place& place) {
  return fmt::format(
      "'{}' is a side face that reaches to infinity and has no nodes: name an edge of the hole, or put a body with a "
      "mesh into the hole, tie the two, and name an edge of that body",
      text_of(model, place));
}

std::string text_of(const Model& model, const Place& place) {
  if (!place.text.empty()) return place.text;
  const Body& body = model.bodies[static_cast<std::size_t>(place.body)];
  const auto part = [&](const std::vector<std::string>& names) {
    return fmt::format("{}.{}", body.name, names.size() > 1 ? names[1] : names[0]);
  };
  const auto index = static_cast<std::size_t>(std::max(place.index, 0));
  const std::size_t number = has_divided_faces(body) ? std::min(index / 2, body.cracks.size() - 1) : 0;
  const std::string crack = body.cracks.empty() ? "" : "." + body.cracks[number].name;
  switch (place.kind) {
    case Place::Kind::edge:
      return part(body.outline.edges[index].names);
    case Place::Kind::corner:
      return part(body.outline.corners[index].names);
    case Place::Kind::near:
      return fmt::format("{} near {}", body.name, point_text(place.near));
    case Place::Kind::face:
      return fmt::format("{}{}.{}", body.name, crack, place.index % 2 == 0 ? "right" : "left");
    case Place::Kind::mouth:
      return fmt::format("{}{}.mouth_{}", body.name, crack, place.index == 0 ? "right" : "left");
    case Place::Kind::body:
      break;
  }
  return body.name;
}

}  // namespace scabo::model
