#include "scabo/model/solid_bodies.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace scabo::model {

namespace {

using files::ImportedSolidCell;
using files::ImportedSolidMesh;
using files::SolidSide;

constexpr double cosine_of_turn = 0.86602540378443865;  // of 30 degrees

/// The cells that have a side, by its corners in ascending order.
using SidesByCorners = std::map<std::vector<int>, std::vector<SolidSide>>;

int sides_of(const ImportedSolidMesh& mesh, int cell) {
  return files::sides_of(mesh.cells[static_cast<std::size_t>(cell)]);
}

std::vector<int> key_of_side(const ImportedSolidMesh& mesh, const SolidSide& at) {
  std::vector<int> key = files::corners_of(mesh.cells[static_cast<std::size_t>(at.cell)], at.side);
  std::sort(key.begin(), key.end());
  return key;
}

SidesByCorners sides_by_corners(const ImportedSolidMesh& mesh) {
  SidesByCorners sides;
  for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c)
    for (int side = 0; side < sides_of(mesh, c); ++side) sides[key_of_side(mesh, {c, side})].push_back({c, side});
  return sides;
}

/// Sets that are joined; each is called by its least member.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int of(int i) {
    while (parent_[index(i)] != i) i = parent_[index(i)] = parent_[index(parent_[index(i)])];
    return i;
  }
  void join(int i, int j) {
    const int one = of(i), other = of(j);
    parent_[index(std::max(one, other))] = std::min(one, other);
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::vector<int> parent_;
};

/// For each cell of the file its part, from 0 in the order of the first cells; -1: not chosen.
std::vector<int> parts_of_cells(const ImportedSolidMesh& mesh, const SidesByCorners& sides, int cell_set) {
  std::vector<char> chosen(mesh.cells.size(), cell_set < 0);
  if (cell_set >= 0)
    for (const int cell : mesh.cell_sets[static_cast<std::size_t>(cell_set)].cells)
      chosen[static_cast<std::size_t>(cell)] = true;
  Groups groups(mesh.cells.size());
  for (const auto& [corners, at] : sides)
    for (std::size_t k = 1; k < at.size(); ++k)
      if (chosen[static_cast<std::size_t>(at[0].cell)] && chosen[static_cast<std::size_t>(at[k].cell)])
        groups.join(at[0].cell, at[k].cell);
  std::map<int, int> number;
  std::vector<int> parts(mesh.cells.size(), -1);
  for (int c = 0; c < static_cast<int>(parts.size()); ++c)
    if (chosen[static_cast<std::size_t>(c)])
      parts[static_cast<std::size_t>(c)] =
          number.try_emplace(groups.of(c), static_cast<int>(number.size())).first->second;
  return parts;
}

/// One part of the file.
class PartOfFile {
 public:
  PartOfFile(const ImportedSolidMesh& file, const SidesByCorners& sides, const std::vector<int>& parts, int part)
      : file_(file), sides_(sides), parts_(parts), part_(part), cell_(file.cells.size(), -1) {}

  ImportedSolidMesh mesh();

 private:
  bool has(int cell) const { return parts_[static_cast<std::size_t>(cell)] == part_; }
  bool is_outer(const SolidSide& at) const;
  void take_cells();
  void take_sets();
  void add_faces_to_others();
  void add_other_faces();
  std::vector<SolidSide> sides_without_set() const;
  Eigen::Vector3d normal_of(const SolidSide& at) const;

  const ImportedSolidMesh& file_;
  const SidesByCorners& sides_;
  const std::vector<int>& parts_;
  int part_;
  std::vector<int> cell_;  // of each cell of the file, that of the part
  ImportedSolidMesh mesh_;
};

bool PartOfFile::is_outer(const SolidSide& at) const {
  const std::vector<SolidSide>& all = sides_.at(key_of_side(file_, at));
  return std::count_if(all.begin(), all.end(), [&](const SolidSide& one) { return has(one.cell); }) == 1;
}

void PartOfFile::take_cells() {
  std::vector<int> place(static_cast<std::size_t>(file_.nodes.cols()), -1), kept;
  for (std::size_t c = 0; c < file_.cells.size(); ++c) {
    if (parts_[c] != part_) continue;
    cell_[c] = static_cast<int>(mesh_.cells.size());
    mesh_.cells.push_back(file_.cells[c]);
    for (const int node : file_.cells[c].nodes) place[static_cast<std::size_t>(node)] = 0;
  }
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] < 0) continue;
    place[i] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(i));
  }
  mesh_.nodes = file_.nodes(Eigen::all, kept);
  for (ImportedSolidCell& cell : mesh_.cells)
    for (int& node : cell.nodes) node = place[static_cast<std::size_t>(node)];
  for (const files::NodeSet& set : file_.node_sets) {
    files::NodeSet of{set.name, {}};
    for (const int node : set.nodes)
      if (const int at = place[static_cast<std::size_t>(node)]; at >= 0) of.nodes.push_back(at);
    if (!of.nodes.empty()) mesh_.node_sets.push_back(std::move(of));
  }
  for (const files::SolidLineSet& set : file_.line_sets) {
    files::SolidLineSet of{set.name, {}};
    for (const auto& [from, to] : set.edges) {
      const int a = place[static_cast<std::size_t>(from)], b = place[static_cast<std::size_t>(to)];
      if (a >= 0 && b >= 0) of.edges.push_back({a, b});
    }
    if (!of.edges.empty()) mesh_.line_sets.push_back(std::move(of));
  }
}

void PartOfFile::take_sets() {
  for (const files::CellSet& set : file_.cell_sets) {
    files::CellSet of{set.name, {}};
    for (const int cell : set.cells)
      if (has(cell)) of.cells.push_back(cell_[static_cast<std::size_t>(cell)]);
    if (!of.cells.empty()) mesh_.cell_sets.push_back(std::move(of));
  }
  for (const files::SolidSideSet& set : file_.side_sets) {
    files::SolidSideSet of{set.name, {}};
    bool touches = false;
    for (const SolidSide& at : set.sides) {
      if (!has(at.cell)) continue;
      touches = true;
      if (is_outer(at)) of.sides.push_back({cell_[static_cast<std::size_t>(at.cell)], at.side});
    }
    if (touches) mesh_.side_sets.push_back(std::move(of));
  }
}

void PartOfFile::add_faces_to_others() {
  for (const files::CellSet& set : file_.cell_sets) {
    files::SolidSideSet to{"to_" + set.name, {}};
    for (const int cell : set.cells) {
      if (has(cell)) continue;
      for (int side = 0; side < sides_of(file_, cell); ++side)
        for (const SolidSide& other : sides_.at(key_of_side(file_, {cell, side})))
          if (has(other.cell)) to.sides.push_back({cell_[static_cast<std::size_t>(other.cell)], other.side});
    }
    if (!to.sides.empty()) mesh_.side_sets.push_back(std::move(to));
  }
}

std::vector<SolidSide> PartOfFile::sides_without_set() const {
  std::set<std::pair<int, int>> named;
  for (const files::SolidSideSet& set : mesh_.side_sets)
    for (const SolidSide& at : set.sides) named.emplace(at.cell, at.side);
  std::vector<SolidSide> sides;
  for (int c = 0; c < static_cast<int>(file_.cells.size()); ++c)
    for (int side = 0; has(c) && side < sides_of(file_, c); ++side)
      if (is_outer({c, side}) && named.count({cell_[static_cast<std::size_t>(c)], side}) == 0)
        sides.push_back({cell_[static_cast<std::size_t>(c)], side});
  return sides;
}

Eigen::Vector3d PartOfFile::normal_of(const SolidSide& at) const {
  const std::vector<int> corners = files::corners_of(mesh_.cells[static_cast<std::size_t>(at.cell)], at.side);
  const auto node = [&](std::size_t k) -> Eigen::Vector3d { return mesh_.nodes.col(corners[k]); };
  if (corners.size() == 3) return (node(1) - node(0)).cross(node(2) - node(0)).normalized();
  return (node(2) - node(0)).cross(node(3) - node(1)).normalized();
}

void PartOfFile::add_other_faces() {
  const std::vector<SolidSide> sides = sides_without_set();
  std::map<std::pair<int, int>, std::vector<int>> at_edge;  // by its ends in ascending order
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    normals.push_back(normal_of(sides[i]));
    const std::vector<int> corners =
        files::corners_of(mesh_.cells[static_cast<std::size_t>(sides[i].cell)], sides[i].side);
    for (std::size_t k = 0; k < corners.size(); ++k)
      at_edge[std::minmax(corners[k], corners[(k + 1) % corners.size()])].push_back(static_cast<int>(i));
  }
  Groups groups(sides.size());
  for (const auto& [edge, around] : at_edge)
    for (std::size_t k = 1; k < around.size(); ++k)
      if (normals[static_cast<std::size_t>(around[0])].dot(normals[static_cast<std::size_t>(around[k])]) >
          cosine_of_turn)
        groups.join(around[0], around[k]);
  std::map<int, std::size_t> set_of;
  std::set<std::string> taken;
  for (const files::SolidSideSet& set : mesh_.side_sets) taken.insert(set.name);
  int number = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto [at, is_new] = set_of.try_emplace(groups.of(static_cast<int>(i)), mesh_.side_sets.size());
    if (is_new) {
      std::string name;
      do name = fmt::format("face_{}", ++number);
      while (taken.count(name) > 0);
      mesh_.side_sets.push_back({name, {}});
    }
    mesh_.side_sets[at->second].sides.push_back(sides[i]);
  }
}

ImportedSolidMesh PartOfFile::mesh() {
  take_cells();
  take_sets();
  add_faces_to_others();
  add_other_faces();
  return std::move(mesh_);
}

}  // namespace

std::vector<ImportedSolidMesh> solid_bodies(const ImportedSolidMesh& mesh, int cell_set) {
  const SidesByCorners sides = sides_by_corners(mesh);
  const std::vector<int> parts = parts_of_cells(mesh, sides, cell_set);
  const int count = 1 + *std::max_element(parts.begin(), parts.end());
  std::vector<ImportedSolidMesh> bodies;
  for (int part = 0; part < count; ++part) bodies.push_back(PartOfFile(mesh, sides, parts, part).mesh());
  return bodies;
}

}  // namespace scabo::model
