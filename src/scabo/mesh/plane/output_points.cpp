#include "scabo/mesh/plane/output_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::mesh {

namespace {

using geometry::Box, geometry::distance_to, geometry::outline_size;

/// Tolerance relative to the size of a body.
constexpr double on_outline = 1e-9;
constexpr double most_points = 1e6;

/// Whether a point of an unbounded body lies in the angle between its side faces; true if it has none.
bool between_side_faces(const model::Body& body, const Vec2& point, double slack) {
  const int corner = body.mesh.centre_corner;
  if (corner < 0) return true;
  const auto count = static_cast<int>(body.outline.edges.size());
  const Vec2& centre = body.mesh.centre;
  const Vec2 x = point - centre,  // the ring is run from the face that arrives at the corner to the one that leaves it
      first = body.outline.edges[static_cast<std::size_t>((corner + count - 1) % count)].start - centre,
             last = body.outline.edges[static_cast<std::size_t>(corner)].end - centre;
  const auto turn_to = [&](const Vec2& to) {
    const double turn = std::atan2(cross(first, to), first.dot(to));
    return turn < 0.0 ? turn + 2.0 * std::numbers::pi : turn;
  };
  const auto on = [&](const Vec2& face) {
    return face.dot(x) >= 0.0 && std::abs(cross(face.normalized(), x)) <= slack;
  };
  return on(first) || on(last) || turn_to(x) <= turn_to(last);
}

/// Whether a point lies between the scaling centre at a corner of an unbounded body and the boundary of its hole: on
/// the outline, but in the hole.
bool before_side_faces(const model::Body& body, const Vec2& point, double slack) {
  const int corner = body.mesh.centre_corner;
  if (!body.outside || corner < 0) return false;
  const auto count = static_cast<int>(body.outline.edges.size());
  const model::Edge &arriving = body.outline.edges[static_cast<std::size_t>((corner + count - 1) % count)],
                    &leaving = body.outline.edges[static_cast<std::size_t>(corner)];
  return (distance_to(arriving, point) <= slack && (point - arriving.start).norm() > slack) ||
         (distance_to(leaving, point) <= slack && (point - leaving.end).norm() > slack);
}

/// Bounding boxes, slightly larger than the bodies: of a million points and thousands of bodies only a few combinations
/// need a closer check.
std::vector<Box> boxes_of(const model::Model& model) {
  std::vector<Box> boxes(model.bodies.size());
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    if (model.bodies[b].outside) {
      boxes[b].high = Vec2::Constant(std::numeric_limits<double>::max());
      boxes[b].low = -boxes[b].high;
      continue;
    }
    boxes[b] = geometry::box_of(model.bodies[b].outline);
    const Vec2 margin = Vec2::Constant(2.0 * on_outline * (boxes[b].high - boxes[b].low).norm());
    boxes[b].low -= margin, boxes[b].high += margin;
  }
  return boxes;
}

std::vector<int> bodies_at(const model::Model& model, const std::vector<Box>& boxes, const Vec2& point, int only) {
  std::vector<int> bodies;
  const int first = only < 0 ? 0 : only, last = only < 0 ? static_cast<int>(model.bodies.size()) : only + 1;
  for (int b = first; b < last; ++b) {
    const Box& box = boxes[static_cast<std::size_t>(b)];
    if (point.x() < box.low.x() || point.x() > box.high.x() || point.y() < box.low.y() || point.y() > box.high.y())
      continue;
    if (holds(model.bodies[static_cast<std::size_t>(b)], point)) bodies.push_back(b);
  }
  return bodies;
}

std::string coordinates_of(const Vec2& point) { return fmt::format("({:.9g}, {:.9g})", point.x(), point.y()); }

/// Reason why a point has no value.
std::string lies_outside(const model::Model& model, const Vec2& point, int only) {
  if (only >= 0) {
    const model::Body& body = model.bodies[static_cast<std::size_t>(only)];
    return fmt::format("{} lies outside body '{}', {:.3g} away from it: move it, or leave out 'body'",
                       coordinates_of(point), body.name, distance_to(body.outline, point));
  }
  const model::Body* nearest = nullptr;
  double least = std::numeric_limits<double>::max();
  for (const model::Body& body : model.bodies) {
    const double distance = distance_to(body.outline, point);
    if (!(distance < least)) continue;
    least = distance;
    nearest = &body;
  }
  if (!nearest)  // so far away that squares of the distance overflow
    return fmt::format("{} lies outside every body: move the point", coordinates_of(point));
  return fmt::format("{} lies outside every body; the nearest is '{}', {:.3g} away: move the point",
                     coordinates_of(point), nearest->name, least);
}

void add_line(const model::Model& model, const std::vector<Box>& boxes, const model::OutputLine& line,
              std::vector<OutputPoint>& points, std::vector<Diagnostic>& mistakes) {
  for (int k = 0; k < line.points; ++k) {
    const double t = static_cast<double>(k) / (line.points - 1);
    const Vec2 at = k + 1 == line.points ? line.to : Vec2(line.from + t * (line.to - line.from));
    const std::vector<int> bodies = bodies_at(model, boxes, at, line.body);
    if (bodies.empty()) {  // one message for a line
      mistakes.push_back(
          {line.source, fmt::format("point {} of '{}', {}", k + 1, line.name, lies_outside(model, at, line.body))});
      return;
    }
    for (const int body : bodies) points.push_back({line.name, body, at, t * (line.to - line.from).norm()});
  }
}

/// Coordinates of a grid along one axis.
std::vector<double> coordinates(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(count == 1 ? low : std::lerp(low, high, i / (count - 1.0)));
  return values;
}

void add_grid(const model::Model& model, const std::vector<Box>& boxes, const model::OutputGrid& grid,
              std::vector<OutputPoint>& points, std::vector<Diagnostic>& mistakes) {
  std::array<std::vector<double>, 2> axes;
  if (grid.spacing) {
    Box box;
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (grid.body < 0 ? !model.bodies[b].rigid : static_cast<int>(b) == grid.body)
        box.add(geometry::box_of(model.bodies[b].outline));
    std::array<double, 2> counts{};
    for (const int k : {0, 1})
      counts[static_cast<std::size_t>(k)] =
          std::floor((box.high[k] - box.low[k]) / *grid.spacing * (1.0 + 1e-12)) + 1.0;
    if (!(counts[0] * counts[1] <= most_points)) {
      mistakes.push_back(
          {grid.source, fmt::format("a spacing of {:.6g} gives {:.3g} points, more than the {:.7g} allowed: "
                                    "use a larger one",
                                    *grid.spacing, counts[0] * counts[1], most_points)});
      return;
    }
    for (const int k : {0, 1})
      for (int i = 0; i < counts[static_cast<std::size_t>(k)]; ++i)
        axes[static_cast<std::size_t>(k)].push_back(box.low[k] + i * *grid.spacing);
  } else {
    for (const int k : {0, 1})
      axes[static_cast<std::size_t>(k)] =
          coordinates(grid.low[k], grid.high[k], grid.counts[static_cast<std::size_t>(k)]);
  }
  for (const double y : axes[1])
    for (const double x : axes[0])
      for (const int body : bodies_at(model, boxes, {x, y}, grid.body)) points.push_back({"grid", body, {x, y}, 0.0});
  if (points.empty()) mistakes.push_back({grid.source, "no point of the grid lies in a body: change its coordinates"});
}

}  // namespace

namespace {

/// Whether the pixel at a point of the outline has a material.
bool shows_material(const model::Body& body, const Vec2& point) {
  const model::ImageShape& shape = *body.image;
  const Vec2 at = (point - shape.corner) / shape.pixel;
  return shape.has_material(std::clamp(static_cast<int>(at.x()), 0, shape.image->width - 1),
                            std::clamp(static_cast<int>(at.y()), 0, shape.image->height - 1));
}

}  // namespace

bool holds(const model::Body& body, const Vec2& point) {
  if (body.image && geometry::encloses(body.outline, point) && !shows_material(body, point)) return false;
  const double slack = on_outline * outline_size(body.outline);
  if (before_side_faces(body, point, slack)) return false;
  if (distance_to(body.outline, point) <= slack) return true;
  if (!body.outside) return geometry::encloses(body.outline, point);
  return !geometry::encloses(body.outline, point) && between_side_faces(body, point, slack);
}

BodyFinder::BodyFinder(const model::Model& model) : model_(model), boxes_(boxes_of(model)) {}

std::vector<int> BodyFinder::at(const Vec2& point, int only) const { return bodies_at(model_, boxes_, point, only); }

std::string BodyFinder::why_outside(const Vec2& point, int only) const { return lies_outside(model_, point, only); }

OutputPoints output_points(const model::Model& model) {
  OutputPoints found;
  std::vector<Diagnostic> mistakes;
  const model::Output& wanted = model.output;
  const bool some = !wanted.points.empty() || !wanted.lines.empty() || wanted.grid;
  const std::vector<Box> boxes = some ? boxes_of(model) : std::vector<Box>();
  for (const model::OutputPoint& point : model.output.points) {
    const std::vector<int> bodies = bodies_at(model, boxes, point.at, point.body);
    if (bodies.empty()) mistakes.push_back({point.source, lies_outside(model, point.at, point.body)});
    for (const int body : bodies) found.points.push_back({point.name, body, point.at, 0.0});
  }
  for (const model::OutputLine& line : model.output.lines) add_line(model, boxes, line, found.lines, mistakes);
  if (model.output.grid) add_grid(model, boxes, *model.output.grid, found.grid, mistakes);
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
  return found;
}

}  // namespace scabo::mesh
