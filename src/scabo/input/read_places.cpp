// Places: `upper`, `upper.top`, `upper.top_right`, `{body: upper, near: [6, 3]}`.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::input {

namespace {

std::optional<int> read_body_name(Reading& reading, const Value& at, std::string_view name) {
  const int body = reading.body_index(name);
  if (body >= 0) return body;
  reading.places_known = false;
  if (!reading.bodies_known) return {};
  std::vector<std::string> known;
  if (!reading.report.full())
    for (const Body& candidate : reading.model.bodies) known.push_back(candidate.name);
  reading.report.error(at, fmt::format("there is no body named {}{}", quoted_name(name), suggestion(name, known)));
  return {};
}

bool has_name(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Faces of crack number `number`, and its mouths if it ends at the scaling centre: looking from the mouth towards the
/// tip, `left` is the end of the boundary.
void add_crack_places(const Crack& crack, int number, std::vector<std::pair<std::string, Place>>& places) {
  const auto add = [&](const char* part, Place::Kind kind, int index) {
    Place place;
    place.kind = kind;
    place.index = index;
    places.emplace_back(crack.name + part, place);
  };
  add(".left", Place::Kind::face, 2 * number + 1);
  add(".right", Place::Kind::face, 2 * number);
  if (!crack.path.empty()) return;
  add(".mouth_left", Place::Kind::mouth, 1);
  add(".mouth_right", Place::Kind::mouth, 0);
}

ReadPlace read_part(Reading& reading, const Value& value, int body, std::string_view part, const std::string& text) {
  ReadPlace result{{}, body};
  if (!reading.state(body).shape) return result;
  const Outline& outline = reading.body(body).outline;
  std::vector<std::string> known;
  const std::vector<Crack>& cracks = reading.body(body).cracks;
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    std::vector<std::pair<std::string, Place>> places;
    add_crack_places(cracks[c], static_cast<int>(c), places);
    for (auto& [name, place] : places) {
      known.push_back(name);
      if (name != part) continue;
      place.body = body;
      place.text = text;
      place.source = value.source();
      result.place = place;
      return result;
    }
  }
  for (std::size_t i = 0; i < outline.edges.size(); ++i) {
    if (has_name(outline.edges[i].names, part)) {
      if (BodyState& state = reading.state(body); !state.pieces.empty()) {
        state.edge_names_used.emplace(part);
        state.edges_used.insert(static_cast<int>(i));
      }
      const int face = model::side_face_of(reading.body(body), static_cast<int>(i));
      result.place = Place{face >= 0 ? Place::Kind::face : Place::Kind::edge,
                           body,
                           face >= 0 ? face : static_cast<int>(i),
                           Vec2::Zero(),
                           text,
                           value.source()};
      return result;
    }
    known.insert(known.end(), outline.edges[i].names.rbegin(), outline.edges[i].names.rend());
  }
  for (std::size_t i = 0; i < outline.corners.size(); ++i) {
    if (has_name(outline.corners[i].names, part)) {
      result.place = Place{Place::Kind::corner, body, static_cast<int>(i), Vec2::Zero(), text, value.source()};
      return result;
    }
    known.insert(known.end(), outline.corners[i].names.rbegin(), outline.corners[i].names.rend());
  }
  if (const auto lost = reading.state(body).lost_points.find(std::string(part));
      lost != reading.state(body).lost_points.end()) {
    const Vec2& x = lost->second;
    reading.report.error(value, fmt::format("'{0}' is a node within an edge of body '{1}' that has a name, and so no "
                                            "corner: write {{body: {1}, near: [{2:.9g}, {3:.9g}]}}",
                                            part, reading.body(body).name, x.x(), x.y()));
    return result;
  }
  reading.report.error(value, fmt::format("body '{}' has no edge or corner named {}{}", reading.body(body).name,
                                          quoted_name(part), reading.report.full() ? "" : suggestion(part, known)));
  return result;
}

ReadPlace read_near(Reading& reading, const Value& value) {
  const MapReader map(reading.report, value, {"body", "near"}, place_example);
  const auto body_value = map.need("body");
  const auto near_value = map.need("near");
  const auto name = body_value ? read_text(reading.report, *body_value) : std::nullopt;
  const auto near = near_value ? read_vector(reading.report, *near_value) : std::nullopt;
  if (!name) reading.places_known = false;
  const auto body = name ? read_body_name(reading, *body_value, *name) : std::nullopt;
  if (!body) return {};
  ReadPlace result{{}, *body};
  if (!near || !reading.state(*body).shape) return result;
  const std::string text = fmt::format("{} near {}", *name, point_text(*near));
  result.place = Place{Place::Kind::near, *body, -1, *near, text, value.source()};
  return result;
}

}  // namespace

ReadPlace read_place(Reading& reading, const Value& value) {
  if (value.node->kind == Node::Kind::map) return read_near(reading, value);
  if (value.node->kind != Node::Kind::scalar) {
    reading.places_known = false;
    reading.report.error(value, fmt::format("must be a place, as in {}, not {}", place_example, describe(*value.node)));
    return {};
  }
  const std::string& text = value.node->text;
  const auto dot = text.find('.');
  const auto body = read_body_name(reading, value, std::string_view(text).substr(0, dot));
  if (!body) return {};
  if (dot != std::string::npos) return read_part(reading, value, *body, std::string_view(text).substr(dot + 1), text);
  return {Place{Place::Kind::body, *body, -1, Vec2::Zero(), text, value.source()}, *body};
}

void tell_of_pieces(Reading& reading) {
  for (std::size_t b = 0; b < reading.bodies.size(); ++b) {
    const BodyState& state = reading.bodies[b];
    const Body& body = reading.body(static_cast<int>(b));
    const auto is_used = [&](const std::string& name) {  // an edge may have several names
      return std::any_of(state.edges_used.begin(), state.edges_used.end(), [&](int edge) {
        return has_name(body.outline.edges[static_cast<std::size_t>(edge)].names, name);
      });
    };
    for (const auto& [first, others] : state.pieces) {
      if (!state.edge_names_used.contains(first) || std::any_of(others.begin(), others.end(), is_used)) continue;
      reading.model.warnings.push_back(
          {WarningKind::input, body.name + "." + first,
           fmt::format("the set '{0}' of the mesh file is not one edge of body '{1}': {1}.{0} is its first piece, and "
                       "{1}.{2} the next",
                       first, body.name, others.front())});
    }
  }
}

}  // namespace scabo::input
