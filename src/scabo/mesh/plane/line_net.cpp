#include "scabo/mesh/plane/line_net.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"
#include "scabo/geometry/plane/pieces.hpp"
#include "scabo/mesh/plane/distinct_points.hpp"

namespace scabo::mesh {

namespace {

constexpr int of_outline = -1;

/// A line and the outlines that it bounds.
struct Shared {
  NetLine line;
  Vec2 middle = Vec2::Zero();
  struct Owner {
    int region = of_outline;
    bool forwards = true;  ///< runs like the line
  };
  std::vector<Owner> owners;
};

class Builder {
 public:
  Builder(const model::Body& body, const CrackNet& cracks)
      : body_(body),
        cracks_(cracks),
        tolerance_(1e-9 * geometry::outline_size(body.outline)),
        points_(4.0 * tolerance_) {
    for (const model::Region& region : body.regions) {
      areas_.push_back(region.outline.area());
      boxes_.push_back(geometry::box_of(region.outline));
    }
  }

  std::vector<NetLine> run() {
    cut_outlines();
    for (Shared& shared : shared_) {
      NetLine& line = shared.line;
      line.left = region_beside(shared, true);
      line.right = region_beside(shared, false);
      const bool in_body = line.of_edge >= 0 || geometry::encloses(body_.outline, shared.middle);
      if (in_body && line.left != line.right) net_.push_back(std::move(line));
    }
    add_cracks();
    return std::move(net_);
  }

 private:
  void cut_outlines() {
    std::vector<const geometry::Edge*> edges;
    std::vector<std::pair<int, std::size_t>> origin;  // region and edge
    const auto collect = [&](int region, const geometry::Outline& outline) {
      for (std::size_t e = 0; e < outline.edges.size(); ++e) {
        edges.push_back(&outline.edges[e]);
        origin.emplace_back(region, e);
      }
    };
    collect(of_outline, body_.outline);
    for (std::size_t k = 0; k < body_.regions.size(); ++k) collect(static_cast<int>(k), body_.regions[k].outline);
    std::vector<std::vector<double>> positions;
    if (body_.regions.empty())
      positions.assign(edges.size(), {0.0, 1.0});
    else
      positions = geometry::meeting_positions(edges, tolerance_);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto& [region, e] = origin[i];
      add_cuts(positions[i], *edges[i],
               region == of_outline ? cracks_.cuts(e) : cracks_.region_cuts(static_cast<std::size_t>(region), e));
      for (std::size_t k = 0; k + 1 < positions[i].size(); ++k) {
        NetLine line;
        line.edge = geometry::part_of(*edges[i], positions[i][k], positions[i][k + 1]);
        line.region = region;
        (region == of_outline ? line.of_edge : line.region_edge) = static_cast<int>(e);
        add(std::move(line), region);
      }
    }
  }

  /// The ends of cracks on an edge.
  void add_cuts(std::vector<double>& positions, const geometry::Edge& edge, const std::vector<double>& cuts) const {
    const double slack = 3.0 * tolerance_ / edge.length();
    for (const double cut : cuts)
      if (std::none_of(positions.begin(), positions.end(), [&](double at) { return std::abs(at - cut) <= slack; }))
        positions.push_back(cut);
    std::sort(positions.begin(), positions.end());
  }

  /// The number of a point, which moves to the first point near it.
  int number_of(Vec2& point) {
    const int number = points_.number(point);
    point = points_.points[static_cast<std::size_t>(number)];
    return number;
  }

  void add(NetLine line, int region) {
    line.start = number_of(line.edge.start);
    line.end = number_of(line.edge.end);
    const Vec2 middle = line.edge.at(0.5);
    std::vector<std::size_t>& between = between_[std::minmax(line.start, line.end)];
    for (const std::size_t k : between) {
      Shared& other = shared_[k];
      if ((other.middle - middle).norm() > 8.0 * tolerance_) continue;
      const auto own = geometry::foot_on(line.edge, middle), foot = geometry::foot_on(other.line.edge, middle);
      other.owners.push_back({region, own->normal.dot(foot->normal) > 0.0});
      return;
    }
    between.push_back(shared_.size());
    shared_.push_back({std::move(line), middle, {{region, true}}});
  }

  /// The smallest region on one side of a line; -1 outside of the body.
  int region_beside(const Shared& shared, bool left) const {
    int found = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const Shared::Owner& owner : shared.owners)
      if (owner.region == of_outline && owner.forwards != left) return -1;
    for (std::size_t k = 0; k < body_.regions.size(); ++k) {
      const Vec2 &low = boxes_[k].low, &high = boxes_[k].high, &x = shared.middle;
      const bool apart = (x.array() < low.array() - tolerance_).any() || (x.array() > high.array() + tolerance_).any();
      if (areas_[k] >= least || apart) continue;
      const auto owner = std::find_if(shared.owners.begin(), shared.owners.end(),
                                      [&](const Shared::Owner& o) { return o.region == static_cast<int>(k); });
      const bool holds = owner != shared.owners.end() ? owner->forwards == left
                                                      : geometry::encloses(body_.regions[k].outline, shared.middle);
      if (!holds) continue;
      found = static_cast<int>(k) + 1;
      least = areas_[k];
    }
    return found;
  }

  void add_cracks() {
    for (std::size_t p = 0; p < cracks_.paths().size(); ++p) {
      const std::vector<Vec2>& path = cracks_.paths()[p];
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        Shared crack;
        NetLine& line = crack.line;
        line.edge.start = path[k];
        line.edge.end = path[k + 1];
        line.crack = true;
        line.of_crack = static_cast<int>(p);
        line.start = number_of(line.edge.start);
        line.end = number_of(line.edge.end);
        crack.middle = line.edge.at(0.5);
        line.left = line.right = region_beside(crack, true);
        net_.push_back(std::move(line));
      }
    }
  }

  const model::Body& body_;
  const CrackNet& cracks_;
  const double tolerance_;
  DistinctPoints points_;
  std::vector<double> areas_;  // of the regions
  std::vector<geometry::Box> boxes_;
  std::vector<Shared> shared_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> between_;  // of shared_, by their ends
  std::vector<NetLine> net_;
};

}  // namespace

std::vector<NetLine> line_net(const model::Body& body, const CrackNet& cracks) { return Builder(body, cracks).run(); }

}  // namespace scabo::mesh
