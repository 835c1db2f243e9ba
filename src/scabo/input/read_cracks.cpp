// `cracks` and `sectors` of a body.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr const char* crack_example = "{tip: [0.5, 0], mouth: [0, 0], name: flaw}";

/// Position of a point of the boundary along an edge.
struct OnEdge {
  int edge = -1;
  double at = 0.0;
};

std::optional<OnEdge> find_on_outline(const Outline& outline, const Vec2& x) {
  const double size = outline_size(outline);
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    const double at = closest_position(outline.edges[e], x);
    if ((outline.edges[e].at(at) - x).norm() <= 1e-9 * size) return OnEdge{static_cast<int>(e), at};
  }
  return {};
}

/// The middle of an edge, or a corner, of this body by its name, `left` or `plate.left`.
std::optional<OnEdge> mouth_named(Reading& reading, const Value& value, const Body& body) {
  const auto text = read_text(reading.report, value);
  if (!text) return {};
  const std::string prefix = body.name + ".";
  const std::string name = text->starts_with(prefix) ? text->substr(prefix.size()) : *text;
  std::vector<std::string> known;
  const auto has = [&](const std::vector<std::string>& names) {
    known.insert(known.end(), names.rbegin(), names.rend());
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (std::size_t e = 0; e < body.outline.edges.size(); ++e)
    if (has(body.outline.edges[e].names)) return OnEdge{static_cast<int>(e), 0.5};
  for (std::size_t c = 0; c < body.outline.corners.size(); ++c)  // corner c is the start of edge c
    if (has(body.outline.corners[c].names)) return OnEdge{static_cast<int>(c), 0.0};
  reading.report.error(value, fmt::format("body '{}' has no edge or corner named {}{}", body.name, quoted_name(name),
                                          suggestion(name, known)));
  return {};
}

/// `mouth`: a point of the outline, a corner, or an edge, which stands for its middle.
std::optional<OnEdge> read_mouth(Reading& reading, const Value& value, const Body& body) {
  if (value.node->kind == Node::Kind::scalar) return mouth_named(reading, value, body);
  const auto point = read_vector(reading.report, value);
  if (!point) return {};
  const auto found = find_on_outline(body.outline, *point);
  if (!found) {
    reading.report.error(
        value, fmt::format("{} does not lie on the boundary of '{}': place the mouth of the crack on the boundary",
                           point_text(*point), body.name));
    return {};
  }
  const int count = static_cast<int>(body.outline.edges.size());
  const Edge& edge = body.outline.edges[static_cast<std::size_t>(found->edge)];
  const double size = outline_size(body.outline), from_start = (edge.start - *point).norm(),
               from_end = (edge.end - *point).norm();
  if (from_start <= 1e-9 * size) return OnEdge{found->edge, 0.0};
  if (from_end <= 1e-9 * size) return OnEdge{(found->edge + 1) % count, 0.0};
  return found;
}

/// A crack without tip and mouth, which could not be read.
Crack unread_crack(const Value& value) {
  Crack crack;
  crack.source = value.source();
  crack.name = "crack";
  crack.tip = crack.mouth = Vec2::Constant(unread);
  return crack;
}

/// The points of a set of sides of a mesh file.
std::vector<Vec2> path_named(Reading& reading, const Value& value, const LinesOfFile& lines) {
  const auto name = read_text(reading.report, value);
  if (!name) return std::vector<Vec2>(2, Vec2::Constant(unread));
  const auto found = lines.find(*name);
  if (found != lines.end() && found->second.size() == 1) return found->second.front();
  std::vector<std::string> known;
  for (const auto& [line, chains] : lines) known.push_back(line);
  if (found == lines.end())
    reading.report.error(value, fmt::format("the mesh file has no set of sides inside the body named {}{}",
                                            quoted_name(*name), suggestion(*name, known)));
  else
    reading.report.error(value, fmt::format("the sides of set {} are {} separate lines: a crack is one, with a set of "
                                            "its own, or given by its points",
                                            quoted_name(*name), found->second.size()));
  return std::vector<Vec2>(2, Vec2::Constant(unread));
}

Crack read_crack(Reading& reading, const Value& value, const Body& body, const LinesOfFile* lines) {
  const MapReader map(reading.report, value, {"tip", "mouth", "path", "name"}, crack_example,
                      {{"kink", "give the crack as a path: [[0, 0], [1, 0.2], [2, 0]]"}});
  Crack crack = unread_crack(value);
  if (const auto name = map.get("name")) {
    const auto text = read_text(reading.report, *name);
    if (text && check_name(reading.report, name->source(), *text)) crack.name = *text;
  }
  if (const auto path = map.get("path")) {
    for (const char* key : {"tip", "mouth"})
      if (map.has(key)) map.refuse(key, "does not go with 'path', which has both ends: leave it out");
    if (lines != nullptr && path->node->kind == Node::Kind::scalar) {
      crack.path = path_named(reading, *path, *lines);
      return crack;
    }
    const auto points = read_list(reading.report, *path, "[[0, 0], [1, 0.2]]");
    for (const Value& point : points.value_or(std::vector<Value>{}))
      crack.path.push_back(read_vector(reading.report, point).value_or(Vec2::Constant(unread)));
    if (points && crack.path.size() < 2) reading.report.error(*path, "needs two points or more: the ends of the crack");
    return crack;
  }
  if (const auto tip = map.need("tip")) crack.tip = read_vector(reading.report, *tip).value_or(crack.tip);
  if (const auto mouth = map.need("mouth")) {
    if (const auto at = read_mouth(reading, *mouth, body)) {
      crack.edge = at->edge;
      crack.at = at->at;
      crack.mouth = body.outline.edges[static_cast<std::size_t>(at->edge)].at(at->at);
    }
  }
  return crack;
}

}  // namespace

std::vector<Crack> read_cracks(Reading& reading, const Value& value, const Body& body, const LinesOfFile* lines) {
  const auto items = read_list(reading.report, value, fmt::format("[{}]", crack_example));
  if (!items) return {unread_crack(value)};
  std::vector<Crack> cracks;
  for (const Value& item : *items) cracks.push_back(read_crack(reading, item, body, lines));
  return cracks;
}

std::optional<std::vector<int>> read_sectors(Reading& reading, const Value& value, const Body& body) {
  const std::size_t before = reading.report.count();
  std::vector<int> materials(body.outline.edges.size(), body.material);
  std::set<int> told;
  for (const Entry& entry : read_named(reading.report, value, "sectors", "{edge_1: steel}")) {
    std::vector<std::string> known;
    int found = -1;
    for (std::size_t e = 0; e < body.outline.edges.size(); ++e) {
      const auto& names = body.outline.edges[e].names;
      if (std::find(names.begin(), names.end(), entry.key) != names.end()) found = static_cast<int>(e);
      known.insert(known.end(), names.rbegin(), names.rend());
    }
    if (found < 0) {
      reading.report.error(entry.key_source, fmt::format("body '{}' has no edge named {}{}", body.name,
                                                         quoted_name(entry.key), suggestion(entry.key, known)));
      continue;
    }
    if (!told.insert(found).second) {
      reading.report.error(entry.key_source,
                           fmt::format("the sector over {} already has a material: remove one of the two",
                                       shown_name(body.outline.edges[static_cast<std::size_t>(found)])));
      continue;
    }
    const int count = static_cast<int>(body.outline.edges.size()), corner = body.mesh.centre_corner;
    if (corner >= 0 && (found == corner || found == (corner + count - 1) % count)) {
      reading.report.error(entry.key_source, "this edge is a side face, which has no sector: leave it out");
      continue;
    }
    if (const auto material = read_material_name(reading, entry.value))
      materials[static_cast<std::size_t>(found)] = *material;
  }
  if (reading.report.count() > before) return {};
  return materials;
}

}  // namespace scabo::input
