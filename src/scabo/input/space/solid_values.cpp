#include "scabo/input/space/solid_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/formula.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

using namespace model;

namespace {

using Eigen::Vector3d;

std::string list_or_other(const Node& node) {
  return node.kind == Node::Kind::sequence ? fmt::format("a list of {}", node.items.size()) : describe(node);
}

double positive(Report& report, const std::optional<Value>& value) {
  return read_number_from(report, value, 0.0, false);
}

Vector3d needed_vector(Report& report, const MapReader& map, std::string_view key) {
  const auto value = map.need(key);
  return value ? read_vector_in_space(report, *value) : Vector3d::Zero();
}

SolidBox solid_box_of(Report& report, const Value& value) {
  const MapReader map(report, value, {"corner", "size"}, "{corner: [0, 0, 0], size: [1, 1, 1]}");
  SolidBox box{needed_vector(report, map, "corner"), Vector3d::Zero()};
  const auto size = map.need("size");
  if (size) box.size = read_vector_in_space(report, *size);
  if (size && size->node->kind == Node::Kind::sequence && size->node->items.size() == 3 && !(box.size.minCoeff() > 0.0))
    report.error(*size, "the three sides must be greater than 0");
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
  return {from, to, positive(report, map.need("radius"))};
}

SolidTube tube_of(Report& report, const Value& value) {
  const MapReader map(report, value, {"from", "to", "inner", "outer"},
                      "{from: [0, 0, 0], to: [0, 0, 1], inner: 0.2, outer: 0.3}");
  const auto [from, to] = axis_of(report, map);
  SolidTube tube{from, to, positive(report, map.need("inner")), positive(report, map.need("outer"))};
  if (map.has("inner") && map.has("outer") && !(tube.inner < tube.outer))
    report.error(*map.get("outer"), "'outer', a radius, must be greater than 'inner'");
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
  SolidSphere sphere{needed_vector(report, map, "centre"), positive(report, map.need("radius"))};
  if (const auto keep = map.get("keep")) sphere.kept = kept_of(report, *keep);
  return sphere;
}

}  // namespace

Later only_in_the_plane(const std::vector<const char*>& keys) {
  Later later;
  for (const char* key : keys)
    later.emplace_back(key, "a model in space does not have it (docs/model/space.md): leave it out");
  return later;
}

double read_number_from(Report& report, const std::optional<Value>& value, double least, bool itself) {
  const auto read = value ? read_number(report, *value) : std::nullopt;
  if (read && (*read < least || (!itself && *read == least)))
    report.error(
        *value, fmt::format("must be {} {:g}, not {}", itself ? "at least" : "greater than", least, value->node->text));
  return read.value_or(least);
}

Vector3d read_vector_in_space(Report& report, const Value& value) {
  const Node& node = *value.node;
  if (node.kind != Node::Kind::sequence || node.items.size() != 3) {
    report.error(value, fmt::format("must be three numbers in space, as in [x, y, z], not {}", list_or_other(node)));
    return Vector3d::Zero();
  }
  Vector3d read;
  for (int k = 0; k < 3; ++k) read[k] = read_number(report, value.item(static_cast<std::size_t>(k))).value_or(0.0);
  return read;
}

SpaceFormula read_formula_in_space(Report& report, const Value& value) {
  const auto text = read_text(report, value);
  if (!text) return {};
  for (const std::string& name : names_in_formula(*text))
    if (name != "x" && name != "y" && name != "z") {
      report.error(value, fmt::format("the formula {} has the name {}: besides parameters in ${{}} there are x, y and "
                                      "z, the coordinates",
                                      quoted_name(*text), quoted_name(name)));
      return {};
    }
  return [text = *text](const Vector3d& at) {
    return value_of_formula(text, {{"x", at.x()}, {"y", at.y()}, {"z", at.z()}});
  };
}

std::optional<SolidShape> read_solid_shape(Report& report, const Value& value) {
  const std::size_t before = report.count();
  const MapReader map(report, value, {"box", "cylinder", "tube", "sphere", "extrude"},
                      "{box: {corner: [0, 0, 0], size: [1, 1, 1]}}",
                      only_in_the_plane({"rectangle", "circle", "polygon", "outline", "image", "names"}));
  if (!map.is_map()) return {};
  const auto box = map.get("box"), cylinder = map.get("cylinder"), tube = map.get("tube"), sphere = map.get("sphere");
  const auto extrude = map.get("extrude");
  std::optional<SolidShape> shape;
  if (box.has_value() + cylinder.has_value() + tube.has_value() + sphere.has_value() + extrude.has_value() != 1) {
    if (map.all_known()) report.error(value, "needs one of 'box', 'cylinder', 'tube', 'sphere' and 'extrude'");
  } else if (box) {
    shape = solid_box_of(report, *box);
  } else if (cylinder) {
    shape = cylinder_of(report, *cylinder);
  } else if (tube) {
    shape = tube_of(report, *tube);
  } else if (extrude) {
    shape = read_extrusion(report, *extrude);
  } else {
    shape = sphere_of(report, *sphere);
  }
  return report.count() == before ? shape : std::nullopt;
}

SolidSizes read_solid_sizes(Report& report, const Value& value) {
  Later later = only_in_the_plane({"kind", "order", "centre", "tolerance", "min_size", "elements", "region"});
  later.emplace_back("file", "a body is either a 'shape' or the mesh of a file: leave one of the two out");
  const MapReader map(report, value, {"size", "refine"}, "{size: 0.1}", later);
  SolidSizes sizes;
  sizes.size = positive(report, map.need("size"));
  const auto refine = map.get("refine");
  if (!refine) return sizes;
  constexpr std::string_view example = "[{near: [0, 0, 0], size: 0.01}]";
  for (const Value& item : read_list(report, *refine, example).value_or(std::vector<Value>{})) {
    const MapReader keys(report, item, {"near", "size", "growth"}, "{near: [0, 0, 0], size: 0.01, growth: 0.3}",
                         only_in_the_plane({"on"}));
    SolidSizes::Near near;
    near.point = needed_vector(report, keys, "near");
    near.size = positive(report, keys.need("size"));
    if (const auto growth = keys.get("growth")) {
      near.growth = read_number(report, *growth).value_or(near.growth);
      if (!(near.growth >= 0.02 && near.growth <= 0.5))
        report.error(*growth, fmt::format("must be from 0.02 to 0.5, not {}", growth->node->text));
    }
    sizes.near.push_back(near);
  }
  return sizes;
}

}  // namespace scabo::input
