#include "scabo/mesh/plane/interior_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>

#include "scabo/base/error.hpp"
#include "scabo/geometry/box_tree.hpp"

namespace scabo::mesh {
namespace {

constexpr double from_points = 0.72;   // least distance of a new point from others, per spacing
constexpr double from_lines = 0.55;    // the same from lines
constexpr double from_segments = 0.3;  // and per length of the segment: long facets have no crowd of points before them
constexpr double beside_new = 2.0;     // points that stay are so many spacings from new segments
/// Spacings by which points take their turn differ by more than rounding, which has no say in the mesh.
double rounded(double spacing) { return static_cast<double>(static_cast<float>(spacing)); }

constexpr double infinity = std::numeric_limits<double>::infinity();

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

bool segments_cross(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b) {
  const double a_side = cross(q - p, a - p), b_side = cross(q - p, b - p);
  const double p_side = cross(b - a, p - a), q_side = cross(b - a, q - a);
  return (a_side <= 0.0) != (b_side <= 0.0) && (p_side <= 0.0) != (q_side <= 0.0);
}

// What the segments ask of a point. All three change slowly with the point, so that most points need no search.
struct Surroundings {
  double distance = infinity;   // least distance
  double clearance = infinity;  // least distance - from_segments * length
  double spacing = infinity;    // least spacing_per_facet * facet + growth_of_spacing * distance
};

std::vector<geometry::Box> boxes_of_segments(const std::vector<BorderSegment>& segments) {
  std::vector<geometry::Box> boxes(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) boxes[i].add(segments[i].start), boxes[i].add(segments[i].end);
  return boxes;
}

// The segments in a tree, with the longest one and the finest facet below every node of it.
class SegmentTree {
 public:
  explicit SegmentTree(const std::vector<BorderSegment>& segments)
      : segments_(segments), tree_(boxes_of_segments(segments)) {
    for (const geometry::BoxTree::Node& node : tree_.nodes()) {
      Extremes of_node;
      for (std::size_t i = node.begin; i < node.end; ++i) {
        const BorderSegment& segment = segments_[tree_.item(i)];
        of_node.longest = std::max(of_node.longest, (segment.end - segment.start).norm());
        of_node.finest = std::min(of_node.finest, segment.facet);
      }
      extremes_.push_back(of_node);
    }
  }

  // Whether p lies in the box around all segments; beyond, it is outside of every region.
  bool box_contains(const Vec2& p) const {
    return !tree_.empty() && geometry::distance_to(tree_.nodes().front().box, p) == 0.0;
  }

  Surroundings around(const Vec2& p) const {
    Surroundings found;
    const auto matters = [&](std::size_t node) {
      const double least = geometry::distance_to(tree_.nodes()[node].box, p);
      return least < found.distance || least - from_segments * extremes_[node].longest < found.clearance ||
             spacing_per_facet * extremes_[node].finest + growth_of_spacing * least < found.spacing;
    };
    tree_.visit_from(p, matters, [&](std::size_t i) {
      const BorderSegment& segment = segments_[i];
      const double distance = distance_to_segment(p, segment.start, segment.end);
      const double length = (segment.end - segment.start).norm();
      found.distance = std::min(found.distance, distance);
      found.clearance = std::min(found.clearance, distance - from_segments * length);
      found.spacing = std::min(found.spacing, spacing_per_facet * segment.facet + growth_of_spacing * distance);
    });
    return found;
  }

  // Whether a segment crosses the one from p to q.
  bool crosses(const Vec2& p, const Vec2& q) const {
    const Vec2 low = p.cwiseMin(q), high = p.cwiseMax(q);
    bool found = false;
    const auto overlaps = [&](std::size_t node) {
      const geometry::Box& box = tree_.nodes()[node].box;
      return !found && (low.array() <= box.high.array()).all() && (high.array() >= box.low.array()).all();
    };
    tree_.visit(overlaps,
                [&](std::size_t i) { found = found || segments_cross(p, q, segments_[i].start, segments_[i].end); });
    return found;
  }

 private:
  struct Extremes {
    double longest = 0.0, finest = infinity;
  };
  const std::vector<BorderSegment>& segments_;
  geometry::BoxTree tree_;
  std::vector<Extremes> extremes_;  // of each node
};

// Points in square boxes whose width goes with their spacing: 2^k <= spacing < 2^(k+1), width 2^(k+1).
class PointBoxes {
 public:
  explicit PointBoxes(const Vec2& origin) : origin_(origin), slots_(1 << 12, Slot{}) {}

  // Whether a point of about this spacing (a factor of two to four less or more) is nearer to p than radius.
  bool any_within(const std::vector<Vec2>& points, const Vec2& p, double spacing, double radius) const {
    const int level = std::ilogb(spacing);
    for (int k = level - 1; k <= level + 1; ++k) {
      if (!holds(k)) continue;
      const double width = std::ldexp(2.0, k);
      const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / width)); };
      const Vec2 low = p - origin_ - Vec2::Constant(radius), high = p - origin_ + Vec2::Constant(radius);
      for (std::int64_t j = index(low.y()); j <= index(high.y()); ++j)
        for (std::int64_t i = index(low.x()); i <= index(high.x()); ++i)
          for (int n = first(k, i, j); n >= 0; n = next_[static_cast<std::size_t>(n)])
            if ((points[static_cast<std::size_t>(n)] - p).squaredNorm() < radius * radius) return true;
    }
    return false;
  }

  // The next point, numbered from 0.
  void add(const Vec2& p, double spacing) {
    if (2 * used_ >= slots_.size()) grow();
    const int level = std::ilogb(spacing);
    lowest_ = std::min(lowest_, level);
    highest_ = std::max(highest_, level);
    const double width = std::ldexp(2.0, level);
    const Vec2 place = (p - origin_) / width;
    Slot& slot = slots_[find(level, static_cast<std::int64_t>(std::floor(place.x())),
                             static_cast<std::int64_t>(std::floor(place.y())))];
    if (slot.first < 0) {
      ++used_;
      slot.level = level;
      slot.i = static_cast<std::int64_t>(std::floor(place.x()));
      slot.j = static_cast<std::int64_t>(std::floor(place.y()));
    }
    next_.push_back(slot.first);
    slot.first = static_cast<int>(next_.size()) - 1;
  }

 private:
  struct Slot {
    std::int64_t i = 0, j = 0;
    int level = 0;
    int first = -1;  // point; -1: the slot is empty
  };

  bool holds(int level) const { return level >= lowest_ && level <= highest_; }

  std::size_t find(int level, std::int64_t i, std::int64_t j) const {
    std::uint64_t hash = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15u;
    hash ^= (static_cast<std::uint64_t>(j) + (hash >> 29)) * 0xBF58476D1CE4E5B9u;
    hash += static_cast<std::uint64_t>(level + 4096) * 0x94D049BB133111EBu;
    hash ^= hash >> 32;
    std::size_t at = hash & (slots_.size() - 1);
    while (slots_[at].first >= 0 && (slots_[at].i != i || slots_[at].j != j || slots_[at].level != level))
      at = (at + 1) & (slots_.size() - 1);
    return at;
  }

  int first(int level, std::int64_t i, std::int64_t j) const { return slots_[find(level, i, j)].first; }

  void grow() {
    std::vector<Slot> old(4 * slots_.size(), Slot{});
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.first >= 0) slots_[find(slot.level, slot.i, slot.j)] = slot;
  }

  Vec2 origin_;
  std::vector<Slot> slots_;
  std::vector<int> next_;  // point of the same box; -1: none
  std::size_t used_ = 0;
  int lowest_ = std::numeric_limits<int>::max(), highest_ = std::numeric_limits<int>::min();
};

// The room of points that are no longer there: all that is nearer to them than to those that stay.
class Room {
 public:
  explicit Room(const InteriorPoints& former) : points_(former.points), tree_(boxes_of(former.points)) {
    stays_.assign(points_.size(), false);
  }

  void stay(std::size_t point) { stays_[point] = true; }

  // Whether a point may lie there; anywhere, if there were none before.
  bool has(const Vec2& p) const {
    if (points_.empty()) return true;
    double least = infinity;
    std::size_t nearest = 0;
    const auto matters = [&](std::size_t node) { return geometry::distance_to(tree_.nodes()[node].box, p) < least; };
    tree_.visit_from(p, matters, [&](std::size_t i) {
      if (const double distance = (points_[i] - p).norm(); distance < least) least = distance, nearest = i;
    });
    return !stays_[nearest];
  }

 private:
  static std::vector<geometry::Box> boxes_of(const std::vector<Vec2>& points) {
    std::vector<geometry::Box> boxes(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) boxes[i].add(points[i]);
    return boxes;
  }

  const std::vector<Vec2>& points_;
  geometry::BoxTree tree_;
  std::vector<bool> stays_;
};

std::vector<BorderSegment> new_ones_of(const std::vector<BorderSegment>& segments) {
  std::vector<BorderSegment> found;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(found),
               [](const BorderSegment& segment) { return segment.is_new; });
  return found;
}

class Growth {
 public:
  Growth(const std::vector<BorderSegment>& segments, const std::function<double(const Vec2&)>& spacing,
         const InteriorPoints& former)
      : segments_(segments),
        spacing_(spacing),
        tree_(segments),
        boxes_(origin_of(segments)),
        former_(former),
        room_(former) {}

  InteriorPoints run() {
    keep();
    struct Seed {
      std::size_t segment;
      double spacing;
      bool left;
    };
    std::vector<Seed> seeds;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const BorderSegment& segment = segments_[i];
      const double wanted = std::min(wanted_at(0.5 * (segment.start + segment.end)), spacing_per_facet * segment.facet);
      if (segment.left_inside) seeds.push_back({i, wanted, true});
      if (segment.right_inside) seeds.push_back({i, wanted, false});
    }
    std::stable_sort(seeds.begin(), seeds.end(),
                     [](const Seed& a, const Seed& b) { return rounded(a.spacing) < rounded(b.spacing); });
    for (const Seed& seed : seeds)
      for (const double height : {0.87, 0.55}) {
        const BorderSegment& segment = segments_[seed.segment];
        const Vec2 along = (segment.end - segment.start).normalized();
        const Vec2 inwards = seed.left ? Vec2(-along.y(), along.x()) : Vec2(along.y(), -along.x());
        const Vec2 foot = 0.5 * (segment.start + segment.end);
        const double room = std::max(seed.spacing, 0.5 * (segment.end - segment.start).norm());
        const Surroundings on_line{0.0, -infinity, 0.0};
        propose(foot + 0.01 * seed.spacing * inwards, seed.spacing, on_line, inwards, height * room,
                std::atan2(along.y(), along.x()), false);
        grow();
      }
    return std::move(result_);
  }

 private:
  struct Waiting {
    double spacing;
    int point;
    bool operator>(const Waiting& other) const {
      return spacing != other.spacing ? spacing > other.spacing : point > other.point;
    }
  };

  static Vec2 origin_of(const std::vector<BorderSegment>& segments) {
    Vec2 origin = segments.empty() ? Vec2(0.0, 0.0) : segments.front().start;
    for (const BorderSegment& segment : segments) origin = origin.cwiseMin(segment.start).cwiseMin(segment.end);
    return origin;
  }

  double wanted_at(const Vec2& p) const {
    const double wanted = spacing_(p);
    ensure(wanted > 0.0 && std::isfinite(wanted), "the size of cells is positive everywhere");
    return wanted;
  }

  // Takes over what stays of the points before.
  void keep() {
    const std::vector<BorderSegment> new_ones = new_ones_of(segments_);
    const SegmentTree near(new_ones);
    for (std::size_t i = 0; i < former_.points.size(); ++i) {
      const Vec2& point = former_.points[i];
      const Surroundings around = tree_.around(point);
      const double wanted = std::min(wanted_at(point), around.spacing);
      if (!is_near(former_.spacing[i], wanted) || near.around(point).distance < beside_new * wanted) continue;
      room_.stay(i);
      add(point, former_.spacing[i], wanted, around, former_.angles[i]);
    }
    result_.kept = result_.points.size();
  }

  // `wanted`: of new points there.
  void add(const Vec2& point, double spacing, double wanted, const Surroundings& around, double angle) {
    boxes_.add(point, wanted);
    result_.points.push_back(point);
    result_.spacing.push_back(spacing);
    result_.angles.push_back(angle);
    surroundings_.push_back(around);
    waiting_.push({rounded(wanted), static_cast<int>(result_.points.size()) - 1});
  }

  // Adds the point at `distance` from `from` if there is room for it; a little nearer or farther, if it adapts and the
  // wanted spacing changes on the way.
  void propose(const Vec2& from, double spacing, const Surroundings& around_from, const Vec2& direction,
               double distance, double angle, bool adapts) {
    Vec2 point = from + distance * direction;
    if (boxes_.any_within(result_.points, point, spacing, 0.5 * spacing)) return;
    double wanted = wanted_at(point);
    if (adapts && wanted != spacing) {  // between two spacings the step is their mean
      distance = 0.5 * (distance + std::min(wanted, 1.5 * spacing));
      point = from + distance * direction;
      wanted = wanted_at(point);
    }
    if (!tree_.box_contains(point)) return;
    Surroundings around{around_from.distance - distance, around_from.clearance - distance,
                        around_from.spacing - growth_of_spacing * distance};
    const bool sure = around.clearance >= std::max(from_lines * wanted, 0.0) && around.spacing >= wanted;
    if (!sure) {
      around = tree_.around(point);
      wanted = std::min(wanted, around.spacing);
      if (around.distance < from_lines * wanted || around.clearance < 0.0 || tree_.crosses(from, point)) return;
    }
    if (boxes_.any_within(result_.points, point, wanted, from_points * wanted) || !room_.has(point)) return;
    add(point, wanted, wanted, around, angle);
  }

  void grow() {
    while (!waiting_.empty()) {
      const auto i = static_cast<std::size_t>(waiting_.top().point);
      waiting_.pop();
      const Vec2 from = result_.points[i];
      const double spacing = result_.spacing[i], angle = result_.angles[i];
      const Surroundings around = surroundings_[i];
      for (int k = 0; k < 6; ++k) {
        const double direction = angle + k * std::numbers::pi / 3.0;
        propose(from, spacing, around, {std::cos(direction), std::sin(direction)}, spacing, angle, true);
      }
    }
  }

  const std::vector<BorderSegment>& segments_;
  const std::function<double(const Vec2&)>& spacing_;
  SegmentTree tree_;
  PointBoxes boxes_;
  const InteriorPoints& former_;
  Room room_;
  InteriorPoints result_;
  std::vector<Surroundings> surroundings_;  // lower bounds, for each point
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
};

}  // namespace

InteriorPoints interior_points(const std::vector<BorderSegment>& segments,
                               const std::function<double(const Vec2&)>& spacing, const InteriorPoints& former) {
  return Growth(segments, spacing, former).run();
}

}  // namespace scabo::mesh
