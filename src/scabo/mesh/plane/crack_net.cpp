#include "scabo/mesh/plane/crack_net.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/geometry/plane/outline_checks.hpp"

namespace scabo::mesh {

namespace {

geometry::Edge segment(const std::vector<Vec2>& path, std::size_t k) {
  geometry::Edge edge;
  edge.start = path[k];
  edge.end = path[k + 1];
  return edge;
}

}  // namespace

CrackNet::CrackNet(const model::Body& body) : tolerance_(1e-9 * geometry::outline_size(body.outline)) {
  cuts_.assign(body.outline.edges.size(), {0.0, 1.0});
  for (const model::Crack& crack : body.cracks) paths_.push_back(crack.path);
  std::vector<std::pair<std::size_t, bool>> open_ends;
  for (std::size_t p = 0; p < paths_.size(); ++p)
    for (const bool last : {false, true}) {
      Vec2& end = last ? paths_[p].back() : paths_[p].front();
      if (!put_on_outline(body, end) && !put_on_crack(p, end)) open_ends.emplace_back(p, last);
    }
  for (std::size_t p = 0; p < paths_.size(); ++p)
    for (std::size_t q = 0; q <= p; ++q) divide_at_crossings(p, q);
  for (const model::Region& region : body.regions) {
    region_cuts_.emplace_back();
    for (const geometry::Edge& edge : region.outline.edges) region_cuts_.back().push_back(cuts_by_cracks(edge));
  }
  for (std::vector<double>& cut : cuts_) std::sort(cut.begin(), cut.end());
  for (const auto& [p, last] : open_ends) tips_.push_back(last ? paths_[p].back() : paths_[p].front());
}

/// A point on segment k becomes a point of the path; whether one was added (not if it is an end of the segment).
bool CrackNet::divide(std::vector<Vec2>& path, std::size_t k, const Vec2& point) const {
  for (Vec2* end : {&path[k], &path[k + 1]})
    if ((*end - point).norm() <= 3.0 * tolerance_) {
      *end = point;
      return false;
    }
  path.insert(path.begin() + static_cast<std::ptrdiff_t>(k) + 1, point);
  return true;
}

/// Where two cracks, or parts of one, cross, both get a point.
void CrackNet::divide_at_crossings(std::size_t p, std::size_t q) {
  for (std::size_t k = 0; k + 1 < paths_[p].size(); ++k)
    for (std::size_t l = 0; l + 1 < (p == q ? k : paths_[q].size()); ++l) {
      const auto shared = geometry::shared_points(segment(paths_[p], k), segment(paths_[q], l), tolerance_);
      if (shared.size() != 1) continue;
      Vec2 point = shared.front();
      for (const Vec2& end : {paths_[q][l], paths_[q][l + 1], paths_[p][k], paths_[p][k + 1]})
        if ((end - point).norm() <= 3.0 * tolerance_) point = end;
      if (p == q) {  // the later one first, because its number changes
        divide(paths_[p], k, point);
        if (divide(paths_[q], l, point)) ++k;
      } else {
        divide(paths_[p], k, point);
        divide(paths_[q], l, point);
      }
    }
}

/// Divides cracks where they cross an edge of a region, and gives the positions on the edge.
std::vector<double> CrackNet::cuts_by_cracks(const geometry::Edge& edge) {
  std::vector<double> cuts{0.0, 1.0};
  const double slack = 3.0 * tolerance_ / edge.length();
  const auto point_of = [&](const Vec2& shared) {
    const double at = geometry::closest_position(edge, shared);
    if (at <= slack) return edge.start;
    if (at >= 1.0 - slack) return edge.end;
    const auto same = std::find_if(cuts.begin(), cuts.end(), [&](double c) { return std::abs(c - at) <= slack; });
    if (same != cuts.end()) return edge.at(*same);
    cuts.push_back(at);
    return edge.at(at);
  };
  for (std::vector<Vec2>& path : paths_)
    for (std::size_t k = 0; k + 1 < path.size();) {
      const auto shared = geometry::shared_points(segment(path, k), edge, tolerance_);
      const auto divides = [&](const Vec2& point) { return divide(path, k, point_of(point)); };
      if (std::none_of(shared.begin(), shared.end(), divides)) ++k;
    }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

bool CrackNet::put_on_outline(const model::Body& body, Vec2& end) {
  for (std::size_t e = 0; e < body.outline.edges.size(); ++e) {
    const geometry::Edge& edge = body.outline.edges[e];
    const double at = geometry::closest_position(edge, end);
    if ((edge.at(at) - end).norm() > tolerance_) continue;
    end = edge.at(at);
    const double slack = tolerance_ / edge.length();
    if (at <= slack) {
      end = edge.start;
    } else if (at >= 1.0 - slack) {
      end = edge.end;
    } else {
      cuts_[e].push_back(at);
    }
    return true;
  }
  return false;
}

/// An end on another crack becomes a point of it.
bool CrackNet::put_on_crack(std::size_t own, Vec2& end) {
  for (std::size_t p = 0; p < paths_.size(); ++p) {
    if (p == own) continue;
    std::vector<Vec2>& path = paths_[p];
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const Vec2 along = path[k + 1] - path[k];
      const double t = (end - path[k]).dot(along) / along.squaredNorm();
      if (t < -1e-9 || t > 1.0 + 1e-9 || (path[k] + t * along - end).norm() > tolerance_) continue;
      if ((path[k] - end).norm() <= tolerance_)
        end = path[k];
      else if ((path[k + 1] - end).norm() <= tolerance_)
        end = path[k + 1];
      else
        path.insert(path.begin() + static_cast<std::ptrdiff_t>(k) + 1, end);
      return true;
    }
  }
  return false;
}

}  // namespace scabo::mesh
