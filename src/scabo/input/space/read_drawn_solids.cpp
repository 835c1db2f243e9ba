// `extrude` and `revolve` of models in space: a plane outline, read and checked as that of a body in the plane.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "scabo/input/reading.hpp"
#include "scabo/input/space/solid_values.hpp"
#include "scabo/model/validate.hpp"

namespace scabo::input {

using namespace model;

namespace {

/// Nothing after a mistake. Validation is that of a body in the plane, of which only what concerns the outline is told.
std::optional<Outline> profile_of(Reading& reading, const Value& profile, const std::optional<Value>& holes) {
  auto outline = read_shape(reading, profile);
  if (!outline || (holes && !read_holes(reading, *holes, *outline))) return {};
  Model model;
  model.materials.emplace_back();
  Body body;
  body.name = "body";
  body.material = 0;
  body.outline = *outline;
  body.mesh.kind = MeshKind::fem;
  body.mesh.size = 1.0;
  model.bodies.push_back(body);
  Gaps gaps;
  gaps.materials = gaps.places = gaps.conditions = gaps.steps = true;
  for (const Mistake& mistake : validate(model, gaps))
    for (const char* part : {"bodies.body.shape", "bodies.body.holes"})
      if (mistake.at.path.rfind(part, 0) == 0) {
        reading.report.error(profile, mistake.message);
        return {};
      }
  return outline;
}

/// `profile` and `holes`; no edges after a mistake.
Outline outline_of(Report& report, const MapReader& map) {
  const auto profile = map.need("profile"), holes = map.get("holes");
  if (!profile) return {};
  Reading reading;
  std::swap(reading.report, report);
  auto outline = profile_of(reading, *profile, holes);
  std::swap(reading.report, report);
  return outline ? *std::move(outline) : Outline{};
}

/// `plane: xz`: its axes, then the one across.
std::array<int, 3> axes_of(Report& report, const MapReader& map) {
  const auto plane = map.need("plane");
  if (!plane) return {0, 1, 2};
  const std::string text = plane->node->kind == Node::Kind::scalar ? plane->node->text : "";
  const auto axis = [&](std::size_t k) { return text.size() == 2 ? static_cast<int>(text[k] - 'x') : -1; };
  const int first = axis(0), second = axis(1);
  if (first >= 0 && first <= 2 && second >= 0 && second <= 2 && first != second)
    return {first, second, 3 - first - second};
  report.error(*plane, fmt::format("must be the two axes along which the profile is drawn, as in xy or xz, not {}",
                                   describe(*plane->node)));
  return {0, 1, 2};
}

/// The outline lies on one side of the axis, and touches it at most.
bool is_beside(const SolidRevolution& of) {
  const Vec2 along = (of.to - of.from).normalized();
  double least = 0.0, most = 0.0;
  for (const Edge& edge : of.outline.edges)
    for (int i = 0; i < 16; ++i) {
      const double away = cross(along, edge.at(i / 16.0) - of.from);
      least = std::min(least, away), most = std::max(most, away);
    }
  return std::min(-least, most) <= 1e-9 * std::max(-least, most);
}

}  // namespace

SolidExtrusion read_extrusion(Report& report, const Value& value) {
  const MapReader map(report, value, {"profile", "holes", "plane", "from", "to"},
                      "{profile: {rectangle: {corner: [0, 0], size: [2, 1]}}, plane: xz, from: 0, to: 3}");
  SolidExtrusion extrusion;
  if (!map.is_map()) return extrusion;
  extrusion.outline = outline_of(report, map);
  extrusion.axes = axes_of(report, map);
  const auto from = map.need("from"), to = map.need("to");
  if (from) extrusion.from = read_number(report, *from).value_or(0.0);
  if (to) extrusion.to = read_number(report, *to).value_or(0.0);
  if (from && to && !(extrusion.from < extrusion.to)) report.error(*to, "must be greater than 'from'");
  return extrusion;
}

SolidRevolution read_revolution(Report& report, const Value& value) {
  const MapReader map(report, value, {"profile", "holes", "plane", "axis", "angle"},
                      "{profile: {rectangle: {corner: [1, 0], size: [2, 1]}}, plane: xz, axis: {from: [0, 0], to: [0, "
                      "1]}, angle: 90}");
  SolidRevolution turned;
  if (!map.is_map()) return turned;
  turned.outline = outline_of(report, map);
  turned.axes = axes_of(report, map);
  if (const auto angle = map.get("angle")) {
    turned.angle = read_number(report, *angle).value_or(360.0);
    if (!(turned.angle >= 1.0 && turned.angle <= 360.0))
      report.error(*angle, fmt::format("must be from 1 to 360 degrees, not {}", angle->node->text));
  }
  const auto axis = map.need("axis");
  if (!axis) return turned;
  const std::size_t before = report.count();
  const MapReader ends(report, *axis, {"from", "to"}, "{from: [0, 0], to: [0, 1]}");
  if (const auto from = ends.need("from")) turned.from = read_vector(report, *from).value_or(Vec2(0.0, 0.0));
  if (const auto to = ends.need("to")) turned.to = read_vector(report, *to).value_or(Vec2(0.0, 1.0));
  if (report.count() > before || !ends.is_map() || turned.outline.edges.empty()) return turned;
  if (turned.from == turned.to)
    report.error(*axis, "'from' and 'to' are the same point: they are two points of the axis, in the plane");
  else if (!is_beside(turned))
    report.error(*axis, "the profile lies on both sides of the axis: it must lie on one, and may touch the axis");
  return turned;
}

}  // namespace scabo::input
