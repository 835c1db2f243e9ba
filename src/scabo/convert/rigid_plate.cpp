#include "scabo/convert/rigid_plate.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "scabo/files/split_solid.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using files::ImportedSolidMesh;
using model::number_text;

/// Corners and middle nodes of a side.
std::vector<int> nodes_of(const ImportedSolidMesh& mesh, int side) {
  return files::nodes_of_side(mesh.cells[static_cast<std::size_t>(side / 4)], side % 4);
}

Eigen::Vector3d area_of(const ImportedSolidMesh& mesh, const std::vector<int>& nodes) {
  const auto x = [&](std::size_t i) -> Eigen::Vector3d { return mesh.nodes.col(nodes[i]); };
  return 0.5 * (x(1) - x(0)).cross(x(2) - x(0));
}

/// Extrudes the sides along the mean normals of their nodes by half of their size.
class Plate {
 public:
  Plate(const ImportedSolidMesh& mesh, const std::vector<int>& sides, std::int64_t first) : mesh_(mesh), next_(first) {
    double area = 0.0;
    for (const int side : sides) {
      const std::vector<int> nodes = nodes_of(mesh, side);
      const Eigen::Vector3d of_side = area_of(mesh, nodes);
      area += of_side.norm() / static_cast<double>(sides.size());
      for (const int node : nodes) outwards_.try_emplace(node, Eigen::Vector3d::Zero()).first->second += of_side;
    }
    height_ = 0.5 * std::sqrt(area);
    for (const int side : sides) add(nodes_of(mesh, side));
  }

  std::map<std::int64_t, Eigen::Vector3d> places;  // by number
  std::vector<std::vector<std::int64_t>> cells;
  std::vector<std::int64_t> on_face;
  std::int64_t next() const { return next_; }

 private:
  /// `level`: 0 on the face, 1 in the middle, 2 on the other side.
  std::int64_t number(int node, int level) {
    const auto [found, is_new] = numbers_.try_emplace({node, level}, next_);
    if (!is_new) return found->second;
    places[next_] = mesh_.nodes.col(node) + 0.5 * level * height_ * outwards_.at(node).normalized();
    if (level == 0) on_face.push_back(next_);
    return next_++;
  }

  std::int64_t between(const files::AddedNode& added) {
    const auto [found, is_new] = between_.try_emplace(added.corners, next_);
    if (!is_new) return found->second;
    places[next_] = files::place_of(added, [&](std::int64_t node) { return places.at(node); });
    return next_++;
  }

  void add(const std::vector<int>& side) {
    std::vector<std::int64_t> wedge;
    for (const int level : {0, 2})
      for (std::size_t i = 0; i < 3; ++i) wedge.push_back(number(side[i], level));
    if (side.size() > 3) {
      for (const int level : {0, 2})
        for (std::size_t i = 3; i < 6; ++i) wedge.push_back(number(side[i], level));
      for (std::size_t i = 0; i < 3; ++i) wedge.push_back(number(side[i], 1));
    }
    const files::SplitSolid split = files::split_solid(wedge);
    std::vector<std::int64_t> added;
    for (const files::AddedNode& node : split.added) added.push_back(between(node));
    for (std::vector<std::int64_t> cell : split.tetrahedra) {
      for (std::int64_t& node : cell)
        if (node < 0) node = added[static_cast<std::size_t>(-node - 1)];
      cells.push_back(std::move(cell));
    }
  }

  const ImportedSolidMesh& mesh_;
  std::int64_t next_;
  double height_ = 0.0;
  std::map<int, Eigen::Vector3d> outwards_;
  std::map<std::pair<int, int>, std::int64_t> numbers_;
  std::map<std::vector<std::int64_t>, std::int64_t> between_;
};

}  // namespace

bool hang_together(const ImportedSolidMesh& mesh, const std::vector<int>& sides) {
  std::vector<std::size_t> parent(sides.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k];
    return k;
  };
  std::map<std::pair<int, int>, std::size_t> at;  // edge: a side
  std::size_t parts = sides.size();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const std::vector<int> nodes = nodes_of(mesh, sides[k]);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [found, is_new] = at.try_emplace(std::minmax({nodes[i], nodes[(i + 1) % 3]}), k);
      const std::size_t one = root(k), other = root(found->second);
      if (one == other) continue;
      parent[one] = other;
      --parts;
    }
  }
  return parts == 1;
}

std::string plate_text(const ImportedSolidMesh& mesh, const std::vector<int>& sides, const std::string& region,
                       const std::string& face, std::int64_t& node, std::int64_t& cell) {
  const Plate plate(mesh, sides, node);
  node = plate.next();
  std::string text = "*NODE\n";
  for (const auto& [number, x] : plate.places)
    text += fmt::format("{}, {}, {}, {}\n", number, number_text(x.x()), number_text(x.y()), number_text(x.z()));
  for (const std::size_t count : {4u, 10u}) {
    std::string lines;
    for (const std::vector<std::int64_t>& nodes : plate.cells)
      if (nodes.size() == count) lines += fmt::format("{}, {}\n", cell++, fmt::join(nodes, ", "));
    if (!lines.empty()) text += fmt::format("*ELEMENT, TYPE=C3D{}, ELSET={}\n{}", count, region, lines);
  }
  text += fmt::format("*NSET, NSET={}\n", face);
  for (const std::int64_t number : plate.on_face) text += fmt::format("{}\n", number);
  return text;
}

}  // namespace scabo::convert
