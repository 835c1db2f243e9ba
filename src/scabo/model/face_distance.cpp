// How far points are from faces of shapes: by the ways back to the face along its own coordinates.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/model/cad_frame.hpp"
#include "scabo/model/cad_shape.hpp"

namespace scabo::model {

namespace {

using Eigen::Vector3d;

double beyond(double value, double low, double high) { return std::max({low - value, value - high, 0.0}); }

/// Along an axis from its start, and away from it.
struct Polar {
  double along, radius, length;
};
Polar polar(const Vector3d& from, const Vector3d& to, const Vector3d& point) {
  const Vector3d axis = to - from, x = point - from;
  const double length = axis.norm(), along = x.dot(axis) / length;
  return {along, (x - along / length * axis).norm(), length};
}

double to_tube_face(const Polar& at, double inner, double outer, const std::string& name) {
  if (name == "bottom") return std::hypot(at.along, beyond(at.radius, inner, outer));
  if (name == "top") return std::hypot(at.along - at.length, beyond(at.radius, inner, outer));
  const double radius = name == "inside" ? inner : outer;
  return std::hypot(at.radius - radius, beyond(at.along, 0.0, at.length));
}

double to_edge(const geometry::Outline& outline, const std::string& name, const Vec2& at) {
  double least = std::numeric_limits<double>::max();
  for (const geometry::Edge& edge : outline.edges)
    if (std::find(edge.names.begin(), edge.names.end(), name) != edge.names.end())
      least = std::min(least, geometry::distance_to(edge, at));
  return least;
}

double outside_of(const geometry::Outline& outline, const Vec2& at) {
  return geometry::encloses(outline, at) ? 0.0 : geometry::distance_to(outline, at);
}

struct ToFace {
  const std::string& name;
  const Vector3d& point;

  double operator()(const SolidBox& box) const {
    const std::vector<std::string> names = face_names(SolidShape(box));
    const auto face = static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
    Vector3d ways;
    for (int k = 0; k < 3; ++k) {
      const double low = box.corner[k], high = low + box.size[k];
      ways[k] = face / 2 != k ? beyond(point[k], low, high) : point[k] - (face % 2 == 0 ? low : high);
    }
    return ways.norm();
  }
  double operator()(const SolidCylinder& of) const {
    return to_tube_face(polar(of.from, of.to, point), 0.0, of.radius, name);
  }
  double operator()(const SolidTube& of) const {
    return to_tube_face(polar(of.from, of.to, point), of.inner, of.outer, name);
  }
  double operator()(const SolidSphere& of) const {
    const Vector3d x = point - of.centre;
    const double outside = x.norm() - of.radius;
    double square = std::pow(name == "surface" ? outside : std::max(0.0, outside), 2);
    for (int k = 0; k < 3; ++k) {
      const int kept = of.kept[static_cast<std::size_t>(k)];
      if (name == std::string("cut_") + "xyz"[k] || kept * x[k] < 0.0) square += x[k] * x[k];
    }
    return std::sqrt(square);
  }
  double operator()(const SolidExtrusion& of) const {
    const Vec2 at = PlaneFrame{of.axes}.in_plane(point);
    const double across = point[of.axes[2]];
    if (name == "start" || name == "end")
      return std::hypot(across - (name == "start" ? of.from : of.to), outside_of(of.outline, at));
    return std::hypot(to_edge(of.outline, name, at), beyond(across, of.from, of.to));
  }
  double operator()(const SolidRevolution& of) const;
  double operator()(const CadFile&) const { return std::numeric_limits<double>::max(); }
  double operator()(const SolidCombination& of) const {
    double least = std::numeric_limits<double>::max();
    for (const SolidOperand& operand : of.of)
      if (name.rfind(operand.name + "_", 0) == 0) {
        const std::string own = name.substr(operand.name.size() + 1);
        const auto known = std::visit([](const auto& s) { return face_names(s); }, operand.shape);
        if (std::find(known.begin(), known.end(), own) != known.end())
          least = std::min(least, distance_to_face(operand.shape, own, point));
      }
    return least;
  }
};

/// Turned back about the axis into the plane of the outline.
double ToFace::operator()(const SolidRevolution& of) const {
  const PlaneFrame frame{of.axes};
  const Vec2 along = (of.to - of.from).normalized();
  Vec2 away = tangent_of(along);
  if ((of.outline.centroid() - of.from).dot(away) < 0.0) away = -away;
  const Vector3d origin = frame.at(of.from, 0.0), axis = frame.at(of.from + along, 0.0) - origin;
  const Vector3d start = frame.at(of.from + away, 0.0) - origin, x = point - origin;
  const double height = x.dot(axis), first = x.dot(start), second = x.dot(axis.cross(start));
  const double radius = std::hypot(first, second);
  const Vec2 in_plane = of.from + height * along + radius * away;
  double angle = std::atan2(second, first);
  const double whole = 2.0 * std::numbers::pi, end = of.angle * std::numbers::pi / 180.0;
  const auto to_angle = [&](double other) {  // length of the chord between them
    return 2.0 * radius * std::abs(std::sin(0.5 * (angle - other)));
  };
  if (name == "start" || name == "end")
    return std::hypot(to_angle(name == "start" ? 0.0 : end), outside_of(of.outline, in_plane));
  if (angle < 0.0) angle += whole;
  const double turned = of.is_whole() || angle <= end ? 0.0 : std::min(to_angle(0.0), to_angle(end));
  return std::hypot(to_edge(of.outline, name, in_plane), turned);
}

}  // namespace

double distance_to_face(const AnyShape& shape, const std::string& name, const Vector3d& point) {
  return std::visit([&](const auto& of) { return std::visit(ToFace{name, point}, of); }, shape);
}

}  // namespace scabo::model
