// `symmetry` among the supports: lines of symmetry. The edges of all bodies that lie on the line are fixed along their
// normals.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/geometry/box.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/model/side_faces.hpp"

namespace scabo::input {

namespace {

/// Points x with normal . x = offset.
struct Line {
  Vec2 normal = Vec2::Zero();  // of unit length
  double offset = 0.0;
  double distance(const Vec2& x) const { return normal.dot(x) - offset; }
};

std::optional<Line> read_line(Reading& reading, const Value& value) {
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, value, {"x", "y", "from", "to"}, "{x: 0}");
  if (!map.is_map()) return {};
  const int given = int{map.has("x")} + int{map.has("y")} + int{map.has("from") || map.has("to")};
  if (given != 1) {
    if (map.all_known()) reading.report.error(value, "needs one of x, y, and from with to");
    return {};
  }
  Line line;
  if (map.has("x") || map.has("y")) {
    line.normal = map.has("x") ? Vec2(1.0, 0.0) : Vec2(0.0, 1.0);
    line.offset = number_or_unread(reading, map.get(map.has("x") ? "x" : "y"));
  } else {
    const auto from_value = map.need("from"), to_value = map.need("to");
    const auto from = from_value ? read_vector(reading.report, *from_value) : std::nullopt;
    const auto to = to_value ? read_vector(reading.report, *to_value) : std::nullopt;
    if (!from || !to) return {};
    const Vec2 along = *to - *from;
    if (!(along.norm() > 0.0)) {
      reading.report.error(value, "'from' and 'to' are the same point: give two points of the line");
      return {};
    }
    line.normal = Vec2(along.y(), -along.x()).stableNormalized();
    line.offset = line.normal.dot(*from);
  }
  return reading.report.count() > before ? std::nullopt : std::optional(line);
}

/// Largest and smallest distance of an outline, and of one edge, from a line.
struct Extent {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void add(double distance) { least = std::min(least, distance), most = std::max(most, distance); }
  double size() const { return std::max(std::abs(least), std::abs(most)); }
};
Extent extent_of(const Edge& edge, const Line& line) {
  Extent extent;
  for (int i = 0; i <= edge.segments(); ++i) extent.add(line.distance(edge.chain_point(i)));
  if (edge.arc)
    for (const double t : {0.25, 0.5, 0.75}) extent.add(line.distance(edge.at(t)));
  return extent;
}

}  // namespace

std::vector<Support> read_symmetry(Reading& reading, const Value& item) {
  constexpr double on_line = 1e-9;  // of the size of a body
  std::vector<Support> supports;
  const std::size_t before = reading.report.count();
  const MapReader map(reading.report, item, {"symmetry"}, "{symmetry: {x: 0}}");
  const auto value = map.need("symmetry");
  const auto line = value ? read_line(reading, *value) : std::nullopt;
  if (!line || reading.report.count() > before) return supports;
  double nearest = std::numeric_limits<double>::infinity();
  std::string nearest_edge;
  bool all_known = reading.bodies_known;
  for (std::size_t b = 0; b < reading.model.bodies.size(); ++b) {
    const Body& body = reading.model.bodies[b];
    all_known = all_known && reading.bodies[b].shape;
    if (!reading.bodies[b].shape || body.outside) continue;
    const double tolerance = on_line * geometry::outline_size(body.outline);
    Extent whole;
    std::vector<int> found;
    for (std::size_t e = 0; e < body.outline.edges.size(); ++e) {
      const Edge& edge = body.outline.edges[e];
      const Extent extent = extent_of(edge, *line);
      whole.add(extent.least), whole.add(extent.most);
      if (extent.size() <= tolerance) found.push_back(static_cast<int>(e));
      if (extent.size() < nearest) {
        nearest = extent.size();
        nearest_edge = body.name + "." + shown_name(edge);
      }
    }
    if (whole.least < -tolerance && whole.most > tolerance) {
      reading.report.error(*value, fmt::format("body '{}' lies on both sides of this line: give the half on one side, "
                                               "whose edge is on the line",
                                               body.name));
      return {};
    }
    for (const int e : found) {
      const Edge& edge = body.outline.edges[static_cast<std::size_t>(e)];
      Support support;
      support.on.kind = Place::Kind::edge;
      support.on.body = static_cast<int>(b);
      support.on.index = e;
      support.on.text = body.name + "." + shown_name(edge);
      support.source = support.on.source = item.source();
      if (const int face = model::side_face_of(body, e); face >= 0) {
        support.on.kind = Place::Kind::face;
        support.on.index = face;
      }
      support.displacement[0] = 0.0;
      support.axes = SupportAxes::edge;
      reading.bodies[b].held = true;
      supports.push_back(std::move(support));
    }
  }
  if (supports.empty() && all_known)
    reading.report.error(
        *value, fmt::format("no edge lies on this line{}",
                            nearest_edge.empty() ? std::string()
                                                 : fmt::format("; the nearest one, '{}', is up to {:.3g} away from it",
                                                               nearest_edge, nearest)));
  return supports;
}

}  // namespace scabo::input
