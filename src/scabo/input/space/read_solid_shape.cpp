// `shape` of bodies in space.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scabo/files/solid_cad.hpp"
#include "scabo/input/space/solid_values.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

namespace {

using Eigen::Vector3d;

/// What lies too far away, or is too large, has no digits left. `sizes`: all greater than 0, or not reported.
void check_extent(Report& report, const Value& value, const Vector3d& at, std::initializer_list<double> sizes) {
  const double least = std::min(sizes), largest = std::max(sizes);
  constexpr double most = 1e30, digits = 1e-8;
  if (!(least > 0.0)) return;  // reported
  if (least < 1.0 / most || largest > most)
    report.error(value, fmt::format("has a size of {:.2g}, but sizes must be from 1e-30 to 1e30: use another unit of "
                                    "length",
                                    largest > most ? largest : least));
  else if (least < digits * at.cwiseAbs().maxCoeff())
    report.error(value, fmt::format("with a size of {:.2g} lies {:.2g} away from the origin, where coordinates have "
                                    "too few digits for it: move the model to the origin",
                                    least, at.cwiseAbs().maxCoeff()));
}

SolidBox solid_box_of(Report& report, const Value& value) {
  const MapReader map(report, value, {"corner", "size"}, "{corner: [0, 0, 0], size: [1, 1, 1]}");
  SolidBox box{needed_vector(report, map, "corner"), Vector3d::Zero()};
  if (const auto size = map.need("size")) {
    const std::size_t before = report.count();
    box.size = read_vector_in_space(report, *size);
    if (report.count() == before && !(box.size.minCoeff() > 0.0))
      report.error(*size, "the three sides must be greater than 0");
  }
  check_extent(report, value, box.corner, {box.size.x(), box.size.y(), box.size.z()});
  return box;
}

/// The ends of the axis of a cylinder or tube.
std::pair<Vector3d, Vector3d> axis_of(Report& report, const MapReader& map) {
  const Vector3d from = needed_vector(report, map, "from"), to = needed_vector(report, map, "to");
  if (map.has("from") && map.has("to") && from == to)
    report.error(map.map(), "'from' and 'to' are the same point: they are the centres of both ends");
  return {from, to};
}

SolidCylinder cylinder_of(Report& report, const Value& value) {
  const MapReader map(report, value, {"from", "to", "radius"}, "{from: [0, 0, 0], to: [0, 0, 1], radius: 0.2}");
  const auto [from, to] = axis_of(report, map);
  SolidCylinder cylinder{from, to, read_positive(report, map.need("radius"))};
  check_extent(report, value, from, {(to - from).norm(), cylinder.radius});
  return cylinder;
}

SolidTube tube_of(Report& report, const Value& value) {
  const MapReader map(report, value, {"from", "to", "inner", "outer"},
                      "{from: [0, 0, 0], to: [0, 0, 1], inner: 0.2, outer: 0.3}");
  const auto [from, to] = axis_of(report, map);
  SolidTube tube{from, to, read_positive(report, map.need("inner")), read_positive(report, map.need("outer"))};
  if (map.has("inner") && map.has("outer") && !(tube.inner < tube.outer))
    report.error(*map.get("outer"), "'outer', a radius, must be greater than 'inner'");
  check_extent(report, value, from, {(to - from).norm(), tube.inner, tube.outer - tube.inner});
  return tube;
}

/// `[+x, -z]`: above and below the centre.
std::array<int, 3> kept_of(Report& report, const Value& value) {
  std::array<int, 3> kept{0, 0, 0};
  for (const Value& item : read_list(report, value, "[-z]").value_or(std::vector<Value>{})) {
    const std::string text = item.node->kind == Node::Kind::scalar ? item.node->text : "";
    const bool is_half = text.size() == 2 && (text[0] == '+' || text[0] == '-') && text[1] >= 'x' && text[1] <= 'z';
    if (!is_half)
      report.error(item, fmt::format("must be one of +x, -x, +y, -y, +z and -z, not {}", describe(*item.node)));
    else if (int& side = kept[static_cast<std::size_t>(text[1] - 'x')]; side != 0)
      report.error(item, fmt::format("{} is given twice: keep one half", text[1]));
    else
      side = text[0] == '+' ? 1 : -1;
  }
  return kept;
}

SolidSphere sphere_of(Report& report, const Value& value) {
  const MapReader map(report, value, {"centre", "radius", "keep"}, "{centre: [0, 0, 0], radius: 0.1, keep: [-z]}");
  SolidSphere sphere{needed_vector(report, map, "centre"), read_positive(report, map.need("radius"))};
  if (const auto keep = map.get("keep")) sphere.kept = kept_of(report, *keep);
  check_extent(report, value, sphere.centre, {sphere.radius});
  return sphere;
}

CadFile file_of(Report& report, const Value& value, const std::string& folder) {
  const auto name = read_text(report, value);
  if (!name) return {};
  if (!files::is_solid_cad_file(*name))
    report.error(value,
                 fmt::format("must be a file .step, .stp, .brep or .stl, not {}; a mesh is the 'file' of 'mesh', "
                             "without a 'shape'",
                             quoted_name(*name)));
  return {(std::filesystem::path(folder) / *name).string()};
}

/// `{plate: {box: ...}, bore: {cylinder: ...}}`.
SolidCombination combination_of(Report& report, const Value& value, SolidCombination::Kind kind,
                                const std::string& folder) {
  SolidCombination combined{kind, {}};
  const std::size_t before = report.count();
  for (const Entry& entry : read_named(report, value, "shapes",
                                       "{plate: {box: {corner: [0, 0, 0], size: [4, 4, 1]}}, bore: {cylinder: {from: "
                                       "[2, 2, 0], to: [2, 2, 1], radius: 1}}}")) {
    auto shape = read_solid_shape(report, entry.value, folder);
    if (shape) combined.of.push_back({entry.key, *std::move(shape)});
  }
  if (report.count() == before && combined.of.size() < 2)
    report.error(value, "needs two shapes or more, each with a name of its own");
  return combined;
}

}  // namespace

const std::vector<std::string>& kinds_of_solid_shapes() {
  static const std::vector<std::string> kinds{"box",     "cylinder", "tube",     "sphere",    "extrude",
                                              "revolve", "union",    "subtract", "intersect", "file"};
  return kinds;
}

std::optional<AnyShape> read_solid_shape(Report& report, const Value& value, const std::string& folder) {
  const std::size_t before = report.count();
  const std::vector<std::string>& kinds = kinds_of_solid_shapes();
  const MapReader map(report, value, kinds, "{box: {corner: [0, 0, 0], size: [1, 1, 1]}}",
                      only_in_the_plane({"rectangle", "circle", "polygon", "outline", "image", "names"}));
  if (!map.is_map()) return {};
  std::vector<std::string> given;
  for (const std::string& kind : kinds)
    if (map.has(kind)) given.push_back(kind);
  if (given.size() != 1) {
    if (given.size() > 1)
      report.error(value,
                   fmt::format("has '{}' and '{}': a body has one shape; 'union' joins two", given[0], given[1]));
    else if (map.all_known())
      report.error(value,
                   "needs one of 'box', 'cylinder', 'tube', 'sphere', 'extrude', 'revolve', 'union', 'subtract', "
                   "'intersect' and 'file'");
    return {};
  }
  const std::string& kind = given.front();
  const Value of = *map.get(kind);
  using Kind = SolidCombination::Kind;
  AnyShape shape;
  if (kind == "box") shape = SolidShape(solid_box_of(report, of));
  if (kind == "cylinder") shape = SolidShape(cylinder_of(report, of));
  if (kind == "tube") shape = SolidShape(tube_of(report, of));
  if (kind == "sphere") shape = SolidShape(sphere_of(report, of));
  if (kind == "extrude") shape = SolidShape(read_extrusion(report, of));
  if (kind == "revolve") shape = CadShape(read_revolution(report, of));
  if (kind == "file") shape = CadShape(file_of(report, of, folder));
  if (kind == "union") shape = CadShape(combination_of(report, of, Kind::united, folder));
  if (kind == "subtract") shape = CadShape(combination_of(report, of, Kind::cut, folder));
  if (kind == "intersect") shape = CadShape(combination_of(report, of, Kind::common, folder));
  return report.count() == before ? std::optional(std::move(shape)) : std::nullopt;
}

}  // namespace scabo::input
