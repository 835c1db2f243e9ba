#include "scabo/convert/deck_transforms.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/convert/deck_names.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

namespace {

using Eigen::Vector3d;
using files::DeckBlock;

/// The two points of the data line; nothing, with a remark.
std::optional<std::array<Vector3d, 2>> points_of(const DeckBlock& block, Remarks& remarks) {
  if (block.lines.empty()) return std::nullopt;  // keyword_rules tells of it
  std::array<Vector3d, 2> points;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto value = number(remarks, block.lines[0], k, "a point of *TRANSFORM");
    if (!value) return std::nullopt;
    points[k / 3][static_cast<Eigen::Index>(k % 3)] = *value;
  }
  return points;
}

/// The axes at a point; nothing where they have no direction.
std::optional<NodeAxes> axes_at(const Vector3d& x, const std::array<Vector3d, 2>& points, bool round) {
  Vector3d first = points[0], third = points[0].cross(points[1]);
  NodeAxes axes;
  if (round) {
    third = points[1] - points[0];
    first = x - points[0];
    first -= first.dot(third) / third.squaredNorm() * third;
    axes.radius = first.norm();
  }
  constexpr double none = 1e-9;  // of a length, beside the others
  const double size = round ? third.norm() + (x - points[0]).norm() : points[0].norm() * points[1].norm();
  if (!(third.norm() > none * size) || !(first.norm() > none * (round ? size : 0.0))) return std::nullopt;
  third.normalize();
  first.normalize();
  axes.rows << first.transpose(), third.cross(first).transpose(), third.transpose();
  for (double& component : axes.rows.reshaped())
    if (std::abs(component) < 1e-14) component = 0.0;
  return axes;
}

/// Whether the set of a *TRANSFORM has reference nodes; a remark about each.
bool tell_reference_nodes(const files::AbaqusDeck& deck, const std::vector<DeckReference>& references,
                          const DeckBlock& block, const std::string& name, Remarks& remarks) {
  std::vector<std::int64_t> numbers(1, 0);
  if (const auto set = deck.loose_sets.find(files::upper(name)); set != deck.loose_sets.end())
    numbers = set->second;
  else if (!files::parse_number(std::string_view(name), numbers[0]))
    return false;
  bool any = false;
  for (const std::int64_t number : numbers) {
    if (!reference_at(references, number)) continue;
    any = true;
    remarks.essential(block.at,
                      fmt::format("node {} of *TRANSFORM is a reference node, whose axes are not taken; take it out of "
                                  "the set, and write its *BOUNDARY and *CLOAD along x, y and z",
                                  number));
  }
  return any;
}

}  // namespace

std::map<int, NodeAxes> transforms_of(const files::AbaqusDeck& deck, const std::vector<DeckReference>& references,
                                      Remarks& remarks) {
  std::map<int, NodeAxes> axes;
  for (const DeckBlock& block : deck.blocks) {
    if (block.name != "TRANSFORM") continue;
    if (block.instance >= 0) {
      remarks.essential(block.at, "*TRANSFORM stands within a part, where it is not taken; put it into the assembly");
      continue;
    }
    const auto points = points_of(block, remarks);
    const std::string name = parameter(block, "NSET");
    const auto nodes = nodes_named(deck, name);
    const bool of_references = tell_reference_nodes(deck, references, block, name, remarks);
    if (!nodes && !of_references)
      remarks.essential(block.at, fmt::format("there is no node set '{}' with nodes of elements for *TRANSFORM; "
                                              "correct its name",
                                              files::printable(name)));
    if (!points || !nodes) continue;
    const bool round = parameter(block, "TYPE") == "C" || parameter(block, "TYPE") == "c";
    for (const int node : *nodes) {
      auto at = axes_at(deck.solid->nodes.col(node), *points, round);
      if (!at) {
        remarks.essential(block.at, round
                                        ? "a node of *TRANSFORM lies on the axis, where it has no radius; take it out "
                                          "of the set"
                                        : "the points of *TRANSFORM give no axes; correct them");
        break;
      }
      at->at = block.at;
      axes[node] = *at;
    }
  }
  return axes;
}

}  // namespace scabo::convert
