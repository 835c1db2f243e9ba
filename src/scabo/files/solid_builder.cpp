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

/// The same cell, seen in a mirror: two corners of a tetrahedron change places, or both ends of a hexahedron or wedge.
void turn_over(ImportedSolidCell& cell) {
  const CellTopology& topology = topology_of(cell);
  const std::size_t corners = topology.corners;
  const auto other = [corners](std::size_t corner) {
    if (corners > 4) return (corner + corners / 2) % corners;
    return corner == 1 || corner == 2 ? 3 - corner : corner;
  };
  const std::vector<int> before = cell.nodes;
  for (std::size_t k = 0; k < corners; ++k) cell.nodes[k] = before[other(k)];
  for (std::size_t k = corners; k < before.size(); ++k) {
    const auto& [a, b] = topology.edges[k - corners];
    cell.nodes[k] = before[topology.middle(other(a), other(b))];
  }
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

SolidBuilder::CellRange SolidBuilder::add_cell(std::int64_t number, std::span<const std::int64_t> nodes,
                                               const FilePlace& at, std::int64_t entity) {
  if (entity < 0) return next_cells(number, nodes, at);
  std::vector<std::int64_t> corners(
      nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(CellTopology::of(nodes.size()).corners));
  std::sort(corners.begin(), corners.end());
  const auto [known, is_new] = repeated_.try_emplace({entity, std::move(corners)});
  if (is_new) known->second = next_cells(number, nodes, at);
  return known->second;
}

SolidBuilder::CellRange SolidBuilder::next_cells(std::int64_t number, std::span<const std::int64_t> nodes,
                                                 const FilePlace& at) {
  const auto first = static_cast<int>(cells_.size());
  const bool is_brick = CellTopology::of(nodes.size()).corners > 4;
  if (is_brick && bricks_ == Bricks::kept && std::set<std::int64_t>(nodes.begin(), nodes.end()).size() < nodes.size())
    files_.fail(at, fmt::format("cell {} has a node twice: a hexahedron or wedge whose edges are collapsed is read as "
                                "tetrahedra only; leave out 'kind'",
                                number));
  if (is_brick && bricks_ == Bricks::divided)
    divide(number, nodes, at);
  else
    append(number, number, nodes, at);
  return {first, static_cast<int>(cells_.size())};
}

void SolidBuilder::append(std::int64_t number, std::int64_t unique_number, std::span<const std::int64_t> nodes,
                          const FilePlace& at) {
  if (cells_.size() >= most_solid_entries) files_.fail(at, "the mesh has more than 5e8 cells");
  cell_numbers_.push_back(unique_number);
  written_numbers_.push_back(number);
  cell_places_.push_back(at);
  cells_.emplace_back(nodes.begin(), nodes.end());
}

/// The first part has the number of the cell, so that a second cell of this number is found.
void SolidBuilder::divide(std::int64_t number, std::span<const std::int64_t> nodes, const FilePlace& at) {
  if (const auto least = std::min_element(nodes.begin(), nodes.end()); *least < 0)
    files_.fail(at, fmt::format("cell {} has the node {}; numbers of nodes are not negative", number, *least));
  const std::size_t first = cells_.size();
  SplitSolid split = split_solid(nodes);
  std::vector<std::int64_t> added;
  for (AddedNode& node : split.added) {
    const auto next = -1 - static_cast<std::int64_t>(between_.size());
    const auto [known, is_new] = between_corners_.try_emplace(node.corners, next);
    if (is_new) between_.push_back(std::move(node));
    added.push_back(known->second);
  }
  for (std::vector<std::int64_t>& part : split.tetrahedra) {
    for (std::int64_t& node : part)
      if (node < 0) node = added[static_cast<std::size_t>(-node - 1)];
    append(number, cells_.size() == first ? number : -1 - static_cast<std::int64_t>(cells_.size()), part, at);
  }
  if (cells_.size() == first) files_.fail(at, fmt::format("cell {} is flat; correct its nodes, or mesh again", number));
  divided_[static_cast<int>(first)] = {static_cast<int>(cells_.size()), nodes.size()};
}

/// A node that the file does not have is told with its cell.
void SolidBuilder::place_between() {
  const NumberIndex nodes(node_numbers_);
  const auto place = [&](std::int64_t number) -> Eigen::Vector3d {
    const int node = nodes.find(number);
    if (node < 0) return Eigen::Vector3d::Zero();
    return Eigen::Map<const Eigen::Vector3d>(coordinates_.data() + 3 * static_cast<std::size_t>(node));
  };
  for (std::size_t k = 0; k < between_.size(); ++k) {
    const Eigen::Vector3d at = place_of(between_[k], place);
    add_node(-1 - static_cast<std::int64_t>(k), at.x(), at.y(), at.z(), {});
  }
}

void SolidBuilder::add_side(int set, const SolidSide& side) {
  side_sets_[static_cast<std::size_t>(set)].sides.push_back(side);
}

void SolidBuilder::add_facet(int set, std::span<const std::int64_t> corners) {
  auto& facets = side_sets_[static_cast<std::size_t>(set)].facets;
  if (corners.size() == 4 && bricks_ == Bricks::kept) {
    facets.push_back({corners[0], corners[1], corners[2], corners[3]});
    return;
  }
  for (const auto& [i, j, k] : triangles_of_facet({corners.begin(), corners.end()}))
    facets.push_back({i, j, k, no_node});
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

/// 1 of a cell whose corners are in order, -1 of one that is turned over, 0 of a flat one: by the corners next to the
/// first one.
int SolidBuilder::sense_of(const ImportedSolidCell& cell) const {
  const auto node = [&](std::size_t i) {
    return Eigen::Map<const Eigen::Vector3d>(coordinates_.data() + 3 * static_cast<std::size_t>(cell.nodes[i]));
  };
  const std::size_t corners = topology_of(cell).corners, at_end = corners == 4 ? 3 : corners / 2;  // next to corner 0
  const Eigen::Vector3d a = node(1) - node(0), b = node(at_end - 1) - node(0), along = node(at_end) - node(0);
  const double size = std::max({a.norm(), b.norm(), along.norm()}), volume = a.cross(b).dot(along);
  const double flat = 1e-12 * size * size * size;
  return volume > flat ? 1 : volume < -flat ? -1 : 0;
}

/// Puts the corners of a cell, or of all parts of one that is divided, in order, or refuses it.
void SolidBuilder::put_in_order(std::span<ImportedSolidCell> parts, std::size_t nodes_of_whole,
                                const FilePlace& at) const {
  const auto of_sense = [&](int sense) {
    return std::count_if(parts.begin(), parts.end(), [&](const auto& part) { return sense_of(part) == sense; });
  };
  const auto count = static_cast<std::ptrdiff_t>(parts.size()), turned = of_sense(-1);
  if (of_sense(1) == count) return;
  const bool is_brick = CellTopology::of(nodes_of_whole).corners > 4;
  if (turned_ == TurnedCells::put_in_order && turned == count) {
    for (ImportedSolidCell& part : parts) turn_over(part);
    return;
  }
  const long number = parts.front().number;
  if (turned_ == TurnedCells::put_in_order && of_sense(0) > 0)
    files_.fail(at, fmt::format("cell {} is flat; correct its nodes, or mesh again", number));
  if (turned_ == TurnedCells::put_in_order)
    files_.fail(at, fmt::format("cell {} is folded: put its nodes in order, or mesh again", number));
  if (is_brick)
    files_.fail(at, fmt::format("cell {} is flat or turned over: seen from its other end, the corners of its first one "
                                "must be counter-clockwise; write the mesh again",
                                number));
  files_.fail(at, fmt::format("cell {} is flat or turned over: seen from node 4, the nodes 1, 2, 3 must "
                              "be counter-clockwise; write the mesh again",
                              number));
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
    mesh.cells.push_back(std::move(cell));
  }
  for (std::size_t c = 0, end = 0; c < cells_.size(); c = end) {
    const auto of = divided_.find(static_cast<int>(c));
    end = of == divided_.end() ? c + 1 : static_cast<std::size_t>(of->second.first);
    put_in_order(std::span(mesh.cells).subspan(c, end - c),
                 of == divided_.end() ? mesh.cells[c].nodes.size() : of->second.second, cell_places_[c]);
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
  for (const RawLines& set : line_sets_) {
    const auto at = [&](std::int64_t number) {
      const int node = nodes.find(number);
      return node < 0 ? -1 : place[static_cast<std::size_t>(node)];
    };
    SolidLineSet of{set.name, {}};
    for (const auto& [from, to] : set.lines)
      if (at(from) >= 0 && at(to) >= 0) of.edges.push_back({at(from), at(to)});
    if (!of.edges.empty()) mesh.line_sets.push_back(std::move(of));
  }
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
      Corners corners{-1, -1, -1, -1};
      std::copy(of_side.begin(), of_side.end(), corners.begin());
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
    for (const std::array<std::int64_t, 4>& facet : raw.facets) {
      Corners corners{-1, -1, -1, -1};
      for (std::size_t k = 0; k < 4 && facet[k] != no_node; ++k) {
        const int node = nodes.find(facet[k]);
        const int at = node < 0 ? -1 : place[static_cast<std::size_t>(node)];
        corners[k] = at < 0 ? -2 : at;  // of no side
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
  if (!divided_.empty())
    mesh.remarks.push_back(
        fmt::format("{}: {} hexahedra and wedges are divided into quadratic tetrahedra of the same corners",
                    files_.file({}), divided_.size()));
  return mesh;
}

}  // namespace scabo::files
