#include "scabo/mesh/plane/contact_side.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::mesh {

namespace {

int order_of(const LineElement& element) { return static_cast<int>(element.nodes.size()) - 1; }

}  // namespace

ContactSide::ContactSide(const model::Edge& edge_, const std::vector<LineElement>& body_elements,
                         const std::vector<Vec2>& body_nodes)
    : edge(&edge_), element_length(edge_.length()) {
  ensure(!body_elements.empty(), "a contact edge has elements");
  closed = (edge->at(0.0) - edge->at(1.0)).norm() <= 1e-9 * edge->length();
  for (const LineElement& element : body_elements) {
    LineElement local;
    // An element begins where the one before ends; at the mouth of a crack it has a node of its own there.
    if (nodes.empty() || nodes.back() != element.nodes.front()) nodes.push_back(element.nodes.front());
    local.nodes.push_back(static_cast<int>(nodes.size()) - 1);
    for (int i = 1; i <= order_of(element); ++i) {
      local.nodes.push_back(static_cast<int>(nodes.size()));
      nodes.push_back(element.nodes[i]);
    }
    const double chord = (body_nodes[element.nodes.back()] - body_nodes[element.nodes.front()]).norm();
    element_length = std::min(element_length, chord);
    elements.push_back(std::move(local));
  }
  if (closed && nodes.front() == nodes.back()) {  // otherwise a crack ends at the first point
    nodes.pop_back();
    elements.back().nodes.back() = 0;
  }
  const int count = size();
  for (const int node : nodes) points.push_back(body_nodes[node]);

  // N_i times the normal has degree 2 p - 1, so that Lobatto quadrature at the nodes is exact and reduces the integral
  // to the weight times the normal at the node.
  normals.assign(count, Vec2::Zero());
  spacing = std::numeric_limits<double>::max();
  for (const LineElement& element : elements) {
    const int order = order_of(element);
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
    for (int i = 0; i <= order; ++i) {
      Vec2 along = Vec2::Zero();
      for (int j = 0; j <= order; ++j) along += basis.derivatives_at_nodes()(i, j) * points[element.nodes[j]];
      normals[element.nodes[i]] += basis.weights()[i] * tangent_of(along);
    }
    for (int i = 0; i < order; ++i) {
      spacing = std::min(spacing, (points[element.nodes[i + 1]] - points[element.nodes[i]]).norm());
    }
  }
  for (int i = 0; i < count; ++i) {
    normals[i].normalize();
    const std::optional<geometry::Foot> foot = geometry::foot_on(*edge, points[i]);
    true_normals.push_back(foot ? foot->normal : normals[i]);
  }
}

NearestPoint::NearestPoint(const std::vector<Vec2>& curve) {
  ensure(!curve.empty(), "the nearest of no points");
  Vec2 along = curve.back() - curve.front();
  along = along.norm() > 0.0 ? along.normalized() : Vec2(1.0, 0.0);
  frame_.row(0) = along;
  frame_.row(1) = tangent_of(along);
  for (const Vec2& point : curve) points_.push_back(frame_ * point);
  runs_.push_back({.last = static_cast<int>(points_.size())});
  divide(0);
}

void NearestPoint::divide(int run) {
  constexpr int short_run = 8;
  const int first = runs_[run].first;
  const int last = runs_[run].last;
  Vec2 low = points_[first];
  Vec2 high = points_[first];
  for (int i = first; i < last; ++i) {
    low = low.cwiseMin(points_[i]);
    high = high.cwiseMax(points_[i]);
  }
  runs_[run].low = low;
  runs_[run].high = high;
  if (last - first <= short_run) return;
  const int middle = (first + last) / 2;
  const int half = static_cast<int>(runs_.size());
  runs_[run].half = half;
  runs_.push_back({.first = first, .last = middle});
  runs_.push_back({.first = middle, .last = last});
  divide(half);
  divide(half + 1);
}

int NearestPoint::operator()(const Vec2& to) const {
  Found best{0, std::numeric_limits<double>::max()};
  search(0, frame_ * to, best);
  return best.point;
}

void NearestPoint::search(int run, const Vec2& to, Found& best) const {
  const Run& here = runs_[run];
  if (here.half < 0) {
    for (int i = here.first; i < here.last; ++i) {
      const double squared = (points_[i] - to).squaredNorm();
      if (squared < best.squared_distance) best = {i, squared};
    }
    return;
  }
  const auto squared_distance = [&](int r) {
    return (to - to.cwiseMax(runs_[r].low).cwiseMin(runs_[r].high)).squaredNorm();
  };
  int near = here.half;
  int far = here.half + 1;
  if (squared_distance(far) < squared_distance(near)) std::swap(near, far);
  for (const int r : {near, far}) {
    if (squared_distance(r) < best.squared_distance) search(r, to, best);
  }
}

}  // namespace scabo::mesh
