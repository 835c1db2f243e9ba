#include "scabo/files/solid_builder.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/base/cell_topology.hpp"

namespace scabo::files {

namespace {

constexpr std::size_t most_solid_entries = std::numeric_limits<int>::max() / 4;

const CellTopology& topology_of(const ImportedSolidCell& cell) { return CellTopology::of(cell.nodes.size()); }

std::vector<int> chosen(const ImportedSolidCell& cell, const std::vector<std::size_t>& places) {
  std::vector<int> nodes;
  for (const std::size_t place : places) nodes.push_back(cell.nodes[place]);
  return nodes;
}

}  // namespace

int sides_of(const ImportedSolidCell& cell) { return static_cast<int>(topology_of(cell).sides.size()); }

std::vector<int> corners_of(const ImportedSolidCell& cell, int side) {
  return chosen(cell, topology_of(cell).sides[static_cast<std::size_t>(side)]);
}

std::vector<int> nodes_of_side(const ImportedSolidCell& cell, int side) {
  const CellTopology& topology = topology_of(cell);
  return chosen(cell, topology.nodes_of_side(static_cast<std::size_t>(side), cell.nodes.size() > topology.corners));
}

std::vector<std::vector<int>> triangles_of_side(const ImportedSolidCell& cell, int side) {
  const std::vector<int> corners = corners_of(cell, side);
  std::vector<std::vector<int>> triangles;
  for (std::size_t k = 2; k < corners.size(); ++k) triangles.push_back({corners[0], corners[k - 1], corners[k]});
  return triangles;
}

void SolidBuilder::add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
    files_.fail(at, fmt::format("node {} has a coordinate that is not finite; correct it", number));
  if (node_numbers_.size() >= most_solid_entries) files_.fail(at, "the mesh has more than 5e8 nodes");
  node_numbers_.push_back(number);
  coordinates_.insert(coordinates_.end(), {x, y, z});
  node_places_.push_back(at);
}

int SolidBuilder::add_cell(std::int64_t number, std::span<const std::int64_t> nodes, const FilePlace& at,
                           std::int64_t entity) {
  const auto index = static_cast<int>(cells_.size());
  if (entity >= 0) {
    std::array<std::int64_t, 4> corners{nodes[0], nodes[1], nodes[2], nodes[3]};
    std::sort(corners.begin(), corners.end());
    const auto [known, is_new] = repeated_.try_emplace({entity, corners}, index);
    if (!is_new) return known->second;
  }
  if (cells_.size() >= most_solid_entries) files_.fail(at, "the mesh has more than 5e8 cells");
  cell_numbers_.push_back(number);
  written_numbers_.push_back(number);
  cell_places_.push_back(at);
  cells_.emplace_back(nodes.begin(), nodes.end());
  return index;
}

int SolidBuilder::add_part(std::int64_t number, std::span<const std::int64_t> nodes, const FilePlace& at) {
  const int index = add_cell(-1 - static_cast<std::int64_t>(cells_.size()), nodes, at);
  written_numbers_.back() = number;
  return index;
}

void SolidBuilder::add_between(std::int64_t number, std::vector<std::int64_t> nodes, std::vector<double> weights) {
  between_.push_back({number, std::move(nodes), std::move(weights)});
}

/// A node that the file does not have is told with its cell.
void SolidBuilder::place_between() {
  const NumberIndex nodes(node_numbers_);
  for (const Between& between : between_) {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < between.nodes.size(); ++i)
      if (const int node = nodes.find(between.nodes[i]); node >= 0)
        at += between.weights[i] *
              Eigen::Map<const Eigen::Vector3d>(coordinates_.data() + 3 * static_cast<std::size_t>(node));
    add_node(between.number, at.x(), at.y(), at.z(), {});
  }
}

void SolidBuilder::add_side(int set, const SolidSide& side) {
  side_sets_[static_cast<std::size_t>(set)].sides.push_back(side);
}

void SolidBuilder::add_facet(int set, std::span<const std::int64_t> corners) {
  side_sets_[static_cast<std::size_t>(set)].facets.push_back({corners[0], corners[1], corners[2]});
}

void SolidBuilder::check_numbers(const NumberIndex& numbers, const std::vector<FilePlace>& places,
                                 const char* what) const {
  if (!numbers.repeated()) return;
  const auto [first, second] = *numbers.repeated();
  const FilePlace& other = places[static_cast<std::size_t>(first)];
  files_.fail(
      places[static_cast<std::size_t>(second)],
      other.line > 0
          ? fmt::format("this number is also that of the {} in line {}; number every one differently", what, other.line)
          : fmt::format("two {}s have one number; number every one differently", what));
}

/// Puts the corners in order, or refuses the cell.
void SolidBuilder::check_cell(ImportedSolidCell& cell, const FilePlace& at) const {
  const auto node = [&](std::size_t i) {
    return Eigen::Map<const Eigen::Vector3d>(coordinates_.data() + 3 * static_cast<std::size_t>(cell.nodes[i]));
  };
  const std::size_t corners = topology_of(cell).corners, at_end = corners == 4 ? 3 : corners / 2;  // next to corner 0
  const Eigen::Vector3d a = node(1) - node(0), b = node(at_end - 1) - node(0), along = node(at_end) - node(0);
  const double size = std::max({a.norm(), b.norm(), along.norm()}), volume = a.cross(b).dot(along);
  const double flat = 1e-12 * size * size * size;
  if (volume > flat) return;
  if (corners > 4)
    files_.fail(at, fmt::format("cell {} is flat or turned over: seen from its other end, the corners of its first one "
                                "must be counter-clockwise; write the mesh again",
                                cell.number));
  if (turned_ == TurnedCells::refused)
    files_.fail(at, fmt::format("cell {} is flat or turned over: seen from node 4, the nodes 1, 2, 3 must "
                                "be counter-clockwise; write the mesh again",
                                cell.number));
  if (!(volume < -flat)) files_.fail(at, fmt::format("cell {} is flat; correct its nodes, or mesh again", cell.number));
  std::swap(cell.nodes[1], cell.nodes[2]);
  if (cell.nodes.size() == 4) return;
  std::swap(cell.nodes[4], cell.nodes[6]);
  std::swap(cell.nodes[8], cell.nodes[9]);
}

void SolidBuilder::make_cells(const NumberIndex& nodes, ImportedSolidMesh& mesh) const {
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    ImportedSolidCell cell{{}, static_cast<long>(written_numbers_[c])};
    for (const std::int64_t number : cells_[c]) {
      const int node = nodes.find(number);
      if (node < 0)
        files_.fail(cell_places_[c], fmt::format("cell {} has the node {}, which the file does not contain; correct "
                                                 "the number or add the node",
                                                 cell.number, number));
      cell.nodes.push_back(node);
    }
    check_cell(cell, cell_places_[c]);
    mesh.cells.push_back(std::move(cell));
  }
}

std::vector<int> SolidBuilder::keep_used_nodes(ImportedSolidMesh& mesh) const {
  std::vector<int> place(node_numbers_.size(), -1);
  for (const ImportedSolidCell& cell : mesh.cells)
    for (const int node : cell.nodes) place[static_cast<std::size_t>(node)] = 0;
  int count = 0;
  for (int& at : place)
    if (at == 0) at = count++;
  mesh.nodes.resize(3, count);
  for (std::size_t i = 0; i < place.size(); ++i)
    for (Eigen::Index k = 0; place[i] >= 0 && k < 3; ++k)
      mesh.nodes(k, place[i]) = coordinates_[3 * i + static_cast<std::size_t>(k)];
  for (ImportedSolidCell& cell : mesh.cells)
    for (int& node : cell.nodes) node = place[static_cast<std::size_t>(node)];
  return place;
}

void SolidBuilder::make_sets(const NumberIndex& nodes, const std::vector<int>& place, ImportedSolidMesh& mesh) const {
  for (const RawNodes& set : node_sets_) {
    std::set<int> kept;
    for (const std::int64_t number : set.nodes)
      if (const int node = nodes.find(number); node >= 0 && place[static_cast<std::size_t>(node)] >= 0)
        kept.insert(place[static_cast<std::size_t>(node)]);
    if (!kept.empty()) mesh.node_sets.push_back({set.name, {kept.begin(), kept.end()}});
  }
  for (const RawCells& set : cell_sets_)
    if (!set.cells.empty()) mesh.cell_sets.push_back({set.name, {set.cells.begin(), set.cells.end()}});
  make_side_sets(nodes, place, mesh);
}

void SolidBuilder::make_side_sets(const NumberIndex& nodes, const std::vector<int>& place,
                                  ImportedSolidMesh& mesh) const {
  std::multimap<Corners, SolidSide> sides_at;
  const bool by_corners =
      std::any_of(side_sets_.begin(), side_sets_.end(), [](const RawSides& set) { return !set.facets.empty(); });
  for (std::size_t c = 0; by_corners && c < mesh.cells.size(); ++c)
    for (int side = 0; side < sides_of(mesh.cells[c]); ++side) {
      const std::vector<int> of_side = corners_of(mesh.cells[c], side);
      Corners corners{of_side[0], of_side[1], of_side[2]};
      std::sort(corners.begin(), corners.end());
      sides_at.emplace(corners, SolidSide{static_cast<int>(c), side});
    }
  for (const RawSides& raw : side_sets_) {
    SolidSideSet set{raw.name, {}};
    std::set<std::pair<int, int>> known;
    const auto add = [&](const SolidSide& side) {
      if (known.emplace(side.cell, side.side).second) set.sides.push_back(side);
    };
    for (const SolidSide& side : raw.sides) add(side);
    for (const std::array<std::int64_t, 3>& facet : raw.facets) {
      Corners corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const int node = nodes.find(facet[k]);
        corners[k] = node < 0 ? -1 : place[static_cast<std::size_t>(node)];
      }
      std::sort(corners.begin(), corners.end());
      const auto [first, last] = sides_at.equal_range(corners);
      for (auto at = first; at != last; ++at) add(at->second);
    }
    if (!set.sides.empty()) mesh.side_sets.push_back(std::move(set));
  }
}

NumberIndex SolidBuilder::cell_index() const {
  NumberIndex cells(cell_numbers_);
  check_numbers(cells, cell_places_, "cell");
  return cells;
}

ImportedSolidMesh SolidBuilder::finish() {
  place_between();
  const NumberIndex nodes(node_numbers_);
  check_numbers(nodes, node_places_, "node");
  cell_index();
  ImportedSolidMesh mesh;
  make_cells(nodes, mesh);
  const std::vector<int> place = keep_used_nodes(mesh);
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] >= 0) kept_numbers_.push_back(node_numbers_[i]);
  make_sets(nodes, place, mesh);
  return mesh;
}

}  // namespace scabo::files
