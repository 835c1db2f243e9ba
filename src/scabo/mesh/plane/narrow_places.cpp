#include "scabo/mesh/plane/narrow_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/geometry/box_tree.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::mesh {

namespace {

/// A line lies opposite another one where the way to it leaves at less than 60 degrees from the normal.
constexpr double opposite = 0.5;
/// Lengths are relative to the body here (unit_free.hpp); places below this are rounding.
constexpr double least_width = 1e-8;
/// Cells next to a narrow place are about as many again in each of the layers in which sizes grow.
constexpr double cells_per_size = 4.0;

std::vector<geometry::Box> boxes_of(const std::vector<NetLine>& lines) {
  std::vector<geometry::Box> boxes;
  for (const NetLine& line : lines) boxes.push_back(geometry::box_of(line.edge));
  return boxes;
}

class Finder {
 public:
  Finder(const std::vector<NetLine>& lines, const std::function<double(const Vec2&)>& size, double largest,
         const NarrowOptions& options)
      : lines_(lines), size_(size), largest_(largest), options_(options), tree_(boxes_of(lines)) {}

  NarrowPlaces run(const std::vector<Vec2>& tips) {
    for (const Vec2& tip : tips) look_at_tip(tip);
    for (const NetLine& line : lines_) {
      look_along(line, 0.0, 1.0, line.edge.length());
      if (options_.arcs && line.edge.arc) look_at_arc(line);
    }
    return std::move(found_);
  }

 private:
  void add(const Vec2& at, double size, double along) {
    if (size >= size_(at)) return;
    found_.samples.push_back({at, size});
    found_.cells += cells_per_size * along / size;
  }

  void look_at_tip(const Vec2& tip) {
    double least = std::numeric_limits<double>::infinity();
    tree_.within(tip, largest_ / options_.sizes_per_tip, [&](std::size_t i) {
      const geometry::Edge& edge = lines_[i].edge;
      if (edge.start != tip && edge.end != tip) least = std::min(least, geometry::distance_to(edge, tip));
    });
    add(tip, options_.sizes_per_tip * std::max(least, least_width), 0.0);
  }

  void look_at_arc(const NetLine& line) {
    const double turn = std::abs(line.edge.arc->sweep), radius = line.edge.arc->radius;
    const int count = static_cast<int>(std::ceil(2.0 * turn));
    for (int k = 0; k < count; ++k) add(line.edge.at((k + 0.5) / count), radius, radius * turn / count);
  }

  /// Whether a straight line lies wholly on that side of a straight line through `middle` where there is no material,
  /// so that its distance matters to no part of this one: the other face of a slit, which may be as thin as one likes.
  bool across_a_gap(const NetLine& line, const NetLine& other, const Vec2& middle, const Vec2& normal) const {
    if (options_.gaps || line.edge.arc || other.edge.arc) return false;
    const double start = normal.dot(other.edge.start - middle), end = normal.dot(other.edge.end - middle);
    return (line.right < 0 && start >= 0.0 && end >= 0.0) || (line.left < 0 && start <= 0.0 && end <= 0.0);
  }

  /// The part of a line from position `from` to position `to`, of the given length.
  void look_along(const NetLine& line, double from, double to, double length) {
    if (found_.cells > options_.most) return;
    const Vec2 middle = line.edge.at(0.5 * (from + to));
    // Sizes grow by less than half of the distance, so that nothing beyond this matters to any point of the part.
    const double reach = (size_(middle) + 0.25 * length) / options_.sizes_per_width + 0.5 * length;
    double nearest = reach, width = std::numeric_limits<double>::infinity();
    const auto foot = geometry::foot_on(line.edge, middle);
    if (!foot) return;
    tree_.within(middle, reach, [&](std::size_t i) {
      const NetLine& other = lines_[i];
      if (other.start == line.start || other.start == line.end || other.end == line.start || other.end == line.end)
        return;
      if (across_a_gap(line, other, middle, foot->normal)) return;
      const Vec2 way = geometry::closest_point(other.edge, middle) - middle;
      const double distance = way.norm(), right = foot->normal.dot(way);
      nearest = std::min(nearest, distance);
      const bool material = (right > 0.0 ? line.right : line.left) >= 0;
      if ((material || options_.gaps) && std::abs(right) > opposite * distance) width = std::min(width, distance);
    });
    if (nearest >= reach) return;
    if (length > std::max(nearest, least_width)) {
      const double half = 0.5 * (from + to);
      look_along(line, from, half, 0.5 * length);
      look_along(line, half, to, 0.5 * length);
      return;
    }
    if (width > reach) return;
    width = std::max(width, least_width);
    if (found_.width == 0.0 || width < found_.width) {
      found_.width = width;
      found_.narrowest = middle;
    }
    add(middle, options_.sizes_per_width * width, length);
  }

  const std::vector<NetLine>& lines_;
  const std::function<double(const Vec2&)>& size_;
  const double largest_;
  const NarrowOptions options_;
  geometry::BoxTree tree_;
  NarrowPlaces found_;
};

}  // namespace

NarrowPlaces narrow_places(const std::vector<NetLine>& lines, const std::vector<Vec2>& tips,
                           const std::function<double(const Vec2&)>& size, double largest,
                           const NarrowOptions& options) {
  return Finder(lines, size, largest, options).run(tips);
}

}  // namespace scabo::mesh
