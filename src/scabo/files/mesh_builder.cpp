#include "scabo/files/mesh_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "scabo/files/cell_shape.hpp"
#include "scabo/files/folded_cell.hpp"
#include "scabo/files/side_table.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

constexpr std::size_t most_entries = std::numeric_limits<int>::max() / 2;
constexpr double plane_tolerance = 1e-6;  // of the size of the mesh: files with six digits pass

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// A quadrilateral that the file collapses to a triangle by repeating the nodes of one side: without that side.
void open_collapsed(ImportedCell& cell) {
  std::vector<int>& nodes = cell.nodes;
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    if (nodes[index(i)] != nodes[index(next)]) continue;
    if (cell.kind == CellKind::quad8) {
      if (nodes[index(4 + i)] != nodes[index(i)]) return;
      nodes.erase(nodes.begin() + 4 + i);
    }
    nodes.erase(nodes.begin() + std::max(i, next));  // either of the two; corner 1 stays the first
    cell.kind = cell.kind == CellKind::quad4 ? CellKind::triangle3 : CellKind::triangle6;
    return;
  }
}

bool has_repeated_node(const std::vector<int>& nodes) {
  if (nodes.size() > 8) {
    std::vector<int> sorted = nodes;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (nodes[i] == nodes[j]) return true;
    }
  }
  return false;
}

/// Corners 1 n ... 2, and the sides between them.
void turn_round(ImportedCell& cell) {
  const int corners = cell.corners();
  std::reverse(cell.nodes.begin() + 1, cell.nodes.begin() + corners);
  std::reverse(cell.nodes.begin() + corners, cell.nodes.end());
}

}  // namespace

int MeshBuilder::add_file(const std::string& file) {
  files_.push_back(file);
  return static_cast<int>(files_.size()) - 1;
}

void MeshBuilder::fail(const FilePlace& at, const std::string& message) const {
  fail_in_file(files_[index(at.file)], at.line, 1, message);
}

std::string MeshBuilder::shown(std::int64_t number) const {
  const std::size_t copy = copies_.empty() || number < 0 ? 0 : static_cast<std::size_t>(number / spacing_);
  if (copy == 0 || copy > copies_.size()) return fmt::format("{}", number);
  return fmt::format("{} of '{}'", number % spacing_, printable(copies_[copy - 1]));
}

std::string MeshBuilder::label(const RawCell& cell) const {
  return fmt::format("cell {}{}", shown(cell.number), from_zero_ ? " (counted from 0)" : "");
}

void MeshBuilder::fail(const RawCell& cell, const std::string& message) const {
  fail(FilePlace{cell.file, cell.line}, label(cell) + " " + message);
}

void MeshBuilder::remark(const FilePlace& at, const std::string& message) {
  constexpr std::size_t most = 20;
  if (remarks_.size() < most) remarks_.push_back(fmt::format("{}:{}: {}", files_[index(at.file)], at.line, message));
}

void MeshBuilder::reserve(std::size_t nodes, std::size_t cells) {
  numbers_.reserve(numbers_.size() + nodes);
  coordinates_.reserve(coordinates_.size() + 3 * nodes);
  node_places_.reserve(node_places_.size() + nodes);
  cells_.reserve(cells_.size() + cells);
  cell_nodes_.reserve(cell_nodes_.size() + 3 * cells);
}

void MeshBuilder::add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) {
  if (number < 0) fail(at, fmt::format("node {} has a negative number; number the nodes from 1", number));
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    fail(at, fmt::format("node {} has a coordinate that is not finite ({}, {}, {}); correct it or mesh again", number,
                         x, y, z));
  }
  if (numbers_.size() >= most_entries) fail(at, "the mesh has more than 1e9 nodes: divide it into several files");
  numbers_.push_back(number);
  coordinates_.insert(coordinates_.end(), {x, y, z});
  node_places_.push_back(at);
}

int MeshBuilder::add_cell(CellKind kind, std::int64_t number, std::span<const std::int64_t> nodes, int region,
                          const FilePlace& at, std::int64_t entity) {
  if (cells_.size() >= most_entries) fail(at, "the mesh has more than 1e9 cells: divide it into several files");
  cells_.push_back(
      {number, entity, cell_nodes_.size(), static_cast<int>(nodes.size()), region, at.line, at.file, kind});
  cell_nodes_.insert(cell_nodes_.end(), nodes.begin(), nodes.end());
  return static_cast<int>(cells_.size()) - 1;
}

int MeshBuilder::region(const std::string& name) {
  const auto [entry, is_new] = region_names_.try_emplace(name, static_cast<int>(regions_.size()));
  if (is_new) {
    regions_.push_back(name);
    materials_.emplace_back();
  }
  return entry->second;
}

void MeshBuilder::add_facet(int set, std::span<const std::int64_t> nodes) {
  auto& all = facet_sets_[index(set)].nodes;
  all.insert(all.end(), {nodes[0], nodes[1], nodes.size() > 2 ? nodes[2] : -1});
}

FilePlace MeshBuilder::cell_place(int cell) const { return {cells_[index(cell)].file, cells_[index(cell)].line}; }

std::span<const std::int64_t> MeshBuilder::cell_nodes(int cell) const {
  const RawCell& raw = cells_[index(cell)];
  return {cell_nodes_.data() + raw.first, index(raw.count)};
}

bool MeshBuilder::add_side(int set, int cell, int side) {
  const auto nodes = cell_nodes(cell);
  const bool quadratic = is_quadratic(cells_[index(cell)].kind);
  const int corners = static_cast<int>(nodes.size()) / (quadratic ? 2 : 1);
  if (side < 0 || side >= corners) return false;
  const std::array<std::int64_t, 3> facet{nodes[index(side)], nodes[index((side + 1) % corners)],
                                          quadratic ? nodes[index(corners + side)] : -1};
  add_facet(set, facet);
  return true;
}

void MeshBuilder::add_free_sides(int set, int cell) { facet_sets_[index(set)].free_sides_of.push_back(cell); }

std::vector<int> MeshBuilder::join_repeated_cells() {
  std::vector<int> joined(cells_.size());
  for (std::size_t i = 0; i < joined.size(); ++i) joined[i] = static_cast<int>(i);
  if (std::none_of(cells_.begin(), cells_.end(), [](const RawCell& cell) { return cell.entity >= 0; })) return joined;

  const auto nodes_of = [this](int cell) { return cell_nodes(cell); };
  const auto hash_of = [this](std::size_t cell) {
    std::uint64_t hash = static_cast<std::uint64_t>(cells_[cell].entity);
    for (const std::int64_t node : cell_nodes(static_cast<int>(cell))) {
      hash = (hash ^ static_cast<std::uint64_t>(node)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return hash;
  };
  std::vector<std::pair<std::uint64_t, int>> hashes(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) hashes[i] = {hash_of(i), static_cast<int>(i)};
  std::sort(hashes.begin(), hashes.end());
  std::vector<bool> repeated(cells_.size());
  bool any = false;
  for (std::size_t i = 0; i + 1 < hashes.size(); ++i) {
    const auto [hash, first] = hashes[i];
    const int second = hashes[i + 1].second;
    if (hash != hashes[i + 1].first || cells_[index(first)].entity != cells_[index(second)].entity) continue;
    const auto a = nodes_of(first), b = nodes_of(second);
    if (!std::equal(a.begin(), a.end(), b.begin(), b.end())) continue;
    joined[index(second)] = joined[index(first)];
    repeated[index(second)] = any = true;
  }
  if (!any) return joined;
  std::vector<int> position(cells_.size());
  std::vector<RawCell> kept;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    position[i] = static_cast<int>(kept.size());
    if (!repeated[i]) kept.push_back(cells_[i]);
  }
  for (int& cell : joined) cell = position[index(cell)];
  cells_ = std::move(kept);
  return joined;
}

void MeshBuilder::find_nodes(ImportedMesh& mesh) const {
  const NumberIndex by_number(numbers_);
  if (const auto& repeated = by_number.repeated()) {
    fail(node_places_[index(repeated->second)],
         fmt::format("node {} is defined twice{}; give each node its own number",
                     shown(numbers_[index(repeated->first)]),
                     node_places_[index(repeated->first)].line > 0
                         ? fmt::format(" (first in line {})", node_places_[index(repeated->first)].line)
                         : ""));
  }
  mesh.cells.resize(cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const RawCell& raw = cells_[c];
    ImportedCell& cell = mesh.cells[c];
    cell.kind = raw.kind;
    cell.number = raw.number;
    cell.line = raw.line;
    cell.region = raw.region;
    cell.nodes.resize(index(raw.count));
    for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
      const std::int64_t number = cell_nodes_[raw.first + i];
      cell.nodes[i] = by_number.find(number);
      if (cell.nodes[i] < 0) {
        fail(raw, fmt::format("has node {}, which is not in the file; add the node or remove the cell", shown(number)));
      }
    }
    if (has_repeated_node(cell.nodes)) {
      if (cell.kind == CellKind::quad4 || cell.kind == CellKind::quad8) open_collapsed(cell);
      if (has_repeated_node(cell.nodes)) {
        fail(raw, fmt::format("is a {} and repeats a node; write it with as many nodes as it has, or remove it",
                              name_of(raw.kind)));
      }
    }
  }
}

std::vector<int> MeshBuilder::drop_unused_nodes(ImportedMesh& mesh) const {
  std::vector<int> position(numbers_.size(), -1), original;
  for (const ImportedCell& cell : mesh.cells) {
    for (const int node : cell.nodes) position[index(node)] = 0;
  }
  int count = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (position[i] < 0) continue;
    original.push_back(static_cast<int>(i));
    position[i] = count++;
  }
  for (ImportedCell& cell : mesh.cells) {
    for (int& node : cell.nodes) node = position[index(node)];
  }
  mesh.nodes.resize(index(count));
  for (std::size_t i = 0; i < original.size(); ++i) {
    const std::size_t at = 3 * index(original[i]);
    mesh.nodes[i] = {coordinates_[at], coordinates_[at + 1]};
  }
  return original;
}

void MeshBuilder::check_plane(const std::vector<int>& original) const {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  std::size_t lowest = 0, highest = 0;  // by z
  for (const int node : original) {
    const double* x = &coordinates_[3 * index(node)];
    if (x[2] < low[2]) lowest = index(node);
    if (x[2] > high[2]) highest = index(node);
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  }
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (high[2] - low[2] <= plane_tolerance * size) return;
  const bool other = high[0] - low[0] <= plane_tolerance * size || high[1] - low[1] <= plane_tolerance * size;
  fail(node_places_[highest],
       fmt::format("the mesh is not in a plane z = constant: node {} has z = {}, node {} has z = {}; {}",
                   shown(numbers_[lowest]), low[2], shown(numbers_[highest]), high[2],
                   other ? "turn it into the xy plane" : "Scabo reads plane meshes only"));
}

void MeshBuilder::check_shapes(ImportedMesh& mesh, const std::vector<int>& original) const {
  std::vector<Vec2> points;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    ImportedCell& cell = mesh.cells[c];
    if (cell.corners() > most_corners) {
      fail(cells_[c], fmt::format("has {} corners, more than {}; divide it", cell.corners(), most_corners));
    }
    if (area_of(mesh, cell) < 0.0) turn_round(cell);
    points.clear();
    for (const int node : cell.nodes) points.push_back(mesh.nodes[index(node)]);
    const auto folded = folded_at(cell.kind, points);
    if (!folded) continue;
    std::vector<std::int64_t> nodes;
    for (const int node : cell.nodes) {
      const std::int64_t number = numbers_[index(original[index(node)])];
      nodes.push_back(copies_.empty() ? number : number % spacing_);
    }
    std::string list;
    for (const std::int64_t node : nodes) {
      list += list.size() > 100 ? " ..." : fmt::format(" {}", node);
      if (list.ends_with("...")) break;
    }
    fail(cells_[c],
         fmt::format("({}, nodes{}) {}", name_of(cell.kind), list, why_folded(cell.kind, points, nodes, *folded)));
  }
}

void MeshBuilder::check_sides(const ImportedMesh& mesh, const SideTable& table,
                              const std::vector<int>& original) const {
  const auto conflict = table.conflict();
  if (!conflict) return;
  const RawCell &first = cells_[index(conflict->first.cell)], &second = cells_[index(conflict->second.cell)];
  const Facet side = side_of(mesh.cells[index(conflict->first.cell)], conflict->first.side);
  const auto number = [&](int node) { return shown(numbers_[index(original[index(node)])]); };
  const std::string where =
      fmt::format("and {} share the side from node {} to node {}", label(first), number(side.start), number(side.end));
  if (conflict->kind == SideTable::Conflict::Kind::overlap) {
    fail(second, where + " and lie on the same side of it: cells overlap; remove one");
  }
  fail(second, where + ", but only one of them has a middle node there: use cells of one order");
}

FacetSet MeshBuilder::facet_set_of(const RawFacets& raw, const ImportedMesh& mesh, const SideTable& table,
                                   const NumberIndex& by_number, const std::vector<int>& joined) const {
  FacetSet set{raw.name, {}};
  std::unordered_set<std::uint64_t> taken;  // cell and side
  const auto add = [&](const Facet& facet) {
    const std::vector<CellSide> sides = table.sides_at(facet);
    if (sides.empty()) return;
    const Facet as_in_cell = side_of(mesh.cells[index(sides.front().cell)], sides.front().side);
    const bool free = !table.neighbour(sides.front());
    const std::uint64_t key =
        static_cast<std::uint64_t>(sides.front().cell) * most_corners + static_cast<std::uint64_t>(sides.front().side);
    if (!taken.insert(key).second) return;
    if (free || facet.start == as_in_cell.start) {
      set.facets.push_back(as_in_cell);
    } else {
      set.facets.push_back({as_in_cell.end, as_in_cell.start, as_in_cell.middle});
    }
  };
  for (std::size_t i = 0; i + 2 < raw.nodes.size(); i += 3) {
    const Facet facet{by_number.find(raw.nodes[i]), by_number.find(raw.nodes[i + 1]),
                      raw.nodes[i + 2] < 0 ? -1 : by_number.find(raw.nodes[i + 2])};
    const bool known = facet.start >= 0 && facet.end >= 0 && (raw.nodes[i + 2] < 0 || facet.middle >= 0);
    if (known && facet.start != facet.end) add(facet);
  }
  for (const int repeated : raw.free_sides_of) {
    const int cell = joined[index(repeated)];
    for (int i = 0; i < mesh.cells[index(cell)].corners(); ++i) {
      if (!table.neighbour({cell, i})) add(side_of(mesh.cells[index(cell)], i));
    }
  }
  return set;
}

NodeSet MeshBuilder::node_set_of(const RawNodes& raw, const NumberIndex& by_number) {
  NodeSet set{raw.name, {}};
  std::unordered_set<int> taken;
  for (const std::int64_t number : raw.nodes) {
    const int node = by_number.find(number);
    if (node >= 0 && taken.insert(node).second) set.nodes.push_back(node);
  }
  return set;
}

void MeshBuilder::make_sets(ImportedMesh& mesh, const std::vector<int>& original,
                            const std::vector<int>& joined) const {
  const SideTable table(mesh.cells, static_cast<int>(mesh.nodes.size()));
  check_sides(mesh, table, original);
  const NumberIndex by_number([&] {
    std::vector<std::int64_t> used;
    used.reserve(original.size());
    for (const int node : original) used.push_back(numbers_[index(node)]);
    return used;
  }());
  for (const RawFacets& raw : facet_sets_) {
    FacetSet set = facet_set_of(raw, mesh, table, by_number, joined);
    if (!set.facets.empty()) mesh.facet_sets.push_back(std::move(set));
  }
  for (const RawNodes& raw : node_sets_) {
    NodeSet set = node_set_of(raw, by_number);
    if (!set.nodes.empty()) mesh.node_sets.push_back(std::move(set));
  }
  for (const CellSet& raw : cell_sets_) {
    CellSet set{raw.name, {}};
    for (const int cell : raw.cells) set.cells.push_back(joined[index(cell)]);
    std::sort(set.cells.begin(), set.cells.end());
    set.cells.erase(std::unique(set.cells.begin(), set.cells.end()), set.cells.end());
    if (!set.cells.empty()) mesh.cell_sets.push_back(std::move(set));
  }
}

ImportedMesh MeshBuilder::finish() {
  if (cells_.empty()) {
    fail(FilePlace{},
         "the mesh is empty: the file has no plane cells (triangles, quadrilaterals, polygons); save the mesh of a "
         "surface");
  }
  ImportedMesh mesh;
  const std::vector<int> joined = join_repeated_cells();
  find_nodes(mesh);
  const std::vector<int> original = drop_unused_nodes(mesh);
  for (const int at : original) kept_numbers_.push_back(numbers_[index(at)]);
  check_plane(original);
  check_shapes(mesh, original);
  make_sets(mesh, original, joined);

  mesh.remarks = remarks_;
  std::vector<int> position(regions_.size(), -1);
  for (ImportedCell& cell : mesh.cells) {
    int& region = position[index(cell.region)];
    if (region < 0) {
      region = static_cast<int>(mesh.regions.size());
      mesh.regions.push_back(regions_[index(cell.region)]);
      mesh.materials.push_back(materials_[index(cell.region)]);
    }
    cell.region = region;
  }
  return mesh;
}

}  // namespace scabo::files
