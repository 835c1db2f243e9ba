// `extrude` of models in space: a plane outline, read and checked as that of a body in the plane.
#include <fmt/format.h>

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

}  // namespace

SolidExtrusion read_extrusion(Report& report, const Value& value) {
  const MapReader map(report, value, {"profile", "holes", "plane", "from", "to"},
                      "{profile: {rectangle: {corner: [0, 0], size: [2, 1]}}, plane: xz, from: 0, to: 3}");
  SolidExtrusion extrusion;
  if (!map.is_map()) return extrusion;
  if (const auto profile = map.need("profile"), holes = map.get("holes"); profile) {
    Reading reading;
    std::swap(reading.report, report);
    auto outline = profile_of(reading, *profile, holes);
    std::swap(reading.report, report);
    if (outline) extrusion.outline = *std::move(outline);
  }
  if (const auto plane = map.need("plane")) {
    const std::string text = plane->node->kind == Node::Kind::scalar ? plane->node->text : "";
    const auto axis = [&](std::size_t k) { return text.size() == 2 ? static_cast<int>(text[k] - 'x') : -1; };
    const int first = axis(0), second = axis(1);
    if (first < 0 || first > 2 || second < 0 || second > 2 || first == second)
      report.error(*plane, fmt::format("must be the two axes along which the profile is drawn, as in xy or xz, not {}",
                                       describe(*plane->node)));
    else
      extrusion.axes = {first, second, 3 - first - second};
  }
  const auto from = map.need("from"), to = map.need("to");
  if (from) extrusion.from = read_number(report, *from).value_or(0.0);
  if (to) extrusion.to = read_number(report, *to).value_or(0.0);
  if (from && to && !(extrusion.from < extrusion.to)) report.error(*to, "must be greater than 'from'");
  return extrusion;
}

}  // namespace scabo::input
