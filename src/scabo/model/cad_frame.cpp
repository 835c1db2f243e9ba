#include "scabo/model/cad_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scabo::model {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

AlignedBox3d around_line(const Vector3d& from, const Vector3d& to, double radius) {
  AlignedBox3d box(from);
  box.extend(to);
  return AlignedBox3d(box.min().array() - radius, box.max().array() + radius);
}

Eigen::AlignedBox2d box_of_outline(const geometry::Outline& outline) {
  Eigen::AlignedBox2d box;
  constexpr int steps = 16;
  for (const geometry::Edge& edge : outline.edges)
    for (int i = 0; i <= steps; ++i) box.extend(edge.at(static_cast<double>(i) / steps));
  return box;
}

struct BoxAround {
  AlignedBox3d operator()(const SolidBox& of) const { return {of.corner, of.corner + of.size}; }
  AlignedBox3d operator()(const SolidCylinder& of) const { return around_line(of.from, of.to, of.radius); }
  AlignedBox3d operator()(const SolidTube& of) const { return around_line(of.from, of.to, of.outer); }
  AlignedBox3d operator()(const SolidSphere& of) const { return around_line(of.centre, of.centre, of.radius); }
  AlignedBox3d operator()(const SolidExtrusion& of) const {
    const PlaneFrame frame{of.axes};
    const Eigen::AlignedBox2d plane = box_of_outline(of.outline);
    AlignedBox3d box(frame.at(plane.min(), of.from));
    return box.extend(frame.at(plane.max(), of.to));
  }
  AlignedBox3d operator()(const SolidRevolution& of) const {
    const PlaneFrame frame{of.axes};
    const Vec2 along = (of.to - of.from).normalized();
    double low = 0.0, high = 0.0, radius = 0.0;
    for (const geometry::Edge& edge : of.outline.edges)
      for (const double t : {0.0, 0.25, 0.5, 0.75}) {
        const Vec2 x = edge.at(t) - of.from;
        low = std::min(low, x.dot(along)), high = std::max(high, x.dot(along));
        radius = std::max(radius, std::abs(cross(along, x)));
      }
    return around_line(frame.at(of.from + low * along, 0.0), frame.at(of.from + high * along, 0.0), radius);
  }
  AlignedBox3d operator()(const CadFile&) const { return {}; }
  AlignedBox3d operator()(const SolidCombination& of) const {
    AlignedBox3d box;
    for (const SolidOperand& operand : of.of) box.extend(box_of(operand.shape));
    return box;
  }
};

/// Points along an edge from its start; each arc leads over less than half a circle.
void add_edge(const geometry::Edge& edge, const PlaneFrame& frame, double across, files::SolidLoop& loop) {
  if (!edge.arc) {
    for (int i = 0; i < edge.segments(); ++i) loop.lines.push_back({frame.at(edge.chain_point(i), across)});
    return;
  }
  const int parts =
      std::max(1, static_cast<int>(std::ceil(std::abs(edge.arc->sweep) / (std::numbers::pi / 2.0) - 1e-9)));
  for (int i = 0; i < parts; ++i)
    loop.lines.push_back(
        {frame.at(edge.at(static_cast<double>(i) / parts), across), true, frame.at(edge.arc->centre, across)});
}

}  // namespace

std::vector<files::SolidLoop> loops_of(const geometry::Outline& outline, const PlaneFrame& frame, double across) {
  std::vector<files::SolidLoop> loops(1);
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    if (std::find(outline.holes.begin(), outline.holes.end(), static_cast<int>(e)) != outline.holes.end())
      loops.emplace_back();
    add_edge(outline.edges[e], frame, across, loops.back());
  }
  return loops;
}

AlignedBox3d box_of(const AnyShape& shape) {
  return std::visit([](const auto& of) { return std::visit(BoxAround{}, of); }, shape);
}

}  // namespace scabo::model
