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
  if (const std::string mistake = mistake_in_formula(*text); !mistake.empty()) {
    report.error(value, fmt::format("the formula {} {}", quoted_name(*text), mistake));
    return {};
  }
  return [text = *text](const Vector3d& at) {
    return value_of_formula(text, {{"x", at.x()}, {"y", at.y()}, {"z", at.z()}});
  };
}

double read_positive(Report& report, const std::optional<Value>& value) {
  return read_number_from(report, value, 0.0, false);
}

Vector3d needed_vector(Report& report, const MapReader& map, std::string_view key) {
  const auto value = map.need(key);
  return value ? read_vector_in_space(report, *value) : Vector3d::Zero();
}

bool read_solid_kind(Report& report, const std::optional<Value>& value) {
  const auto text = value ? read_text(report, *value) : std::nullopt;
  if (text && *text != "tetrahedra" && *text != "hexahedra")
    report.error(*value, fmt::format("must be tetrahedra or hexahedra in space, not {}", quoted_name(*text)));
  return text == "hexahedra";
}

SolidSizes read_solid_sizes(Report& report, const Value& value, bool has_hexahedra) {
  Later later = only_in_the_plane({"order", "centre", "tolerance", "min_size", "elements", "region"});
  later.emplace_back("file", "a body is either a 'shape' or the mesh of a file: leave one of the two out");
  const MapReader map(report, value, {"size", "refine", "kind"}, "{size: 0.1}", later);
  SolidSizes sizes;
  const auto kind = map.get("kind");
  sizes.hexahedra = read_solid_kind(report, kind);
  if (sizes.hexahedra && !has_hexahedra)
    report.error(*kind,
                 "of the shapes, box, tube and extrude are divided into hexahedra or wedges, all others into "
                 "tetrahedra only: leave 'kind' out");
  sizes.size = read_positive(report, map.need("size"));
  const auto refine = map.get("refine");
  if (!refine) return sizes;
  constexpr std::string_view example = "[{near: [0, 0, 0], size: 0.01}]";
  for (const Value& item : read_list(report, *refine, example).value_or(std::vector<Value>{})) {
    const MapReader keys(report, item, {"near", "size", "growth"}, "{near: [0, 0, 0], size: 0.01, growth: 0.3}",
                         only_in_the_plane({"on"}));
    SolidSizes::Near near;
    near.point = needed_vector(report, keys, "near");
    near.size = read_positive(report, keys.need("size"));
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
