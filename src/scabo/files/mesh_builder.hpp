// What the readers of all formats share: they hand over nodes, cells and sets as the file numbers them, in any order;
// `finish` checks them and makes the ImportedMesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scabo/files/imported_mesh.hpp"
#include "scabo/files/number_index.hpp"

namespace scabo::files {

/// Place in a mesh file, or in a file that it includes.
struct FilePlace {
  int file = 0;  ///< index into MeshBuilder's files
  int line = 0;  ///< from 1; 0 in binary data
};

class SideTable;

class MeshBuilder {
 public:
  /// `from_zero`: cells are numbered from 0 by their position.
  explicit MeshBuilder(const std::string& file, bool from_zero = false) : files_{file}, from_zero_(from_zero) {}

  /// A further file that the first includes.
  int add_file(const std::string& file);

  const std::string& file(const FilePlace& at) const { return files_[static_cast<std::size_t>(at.file)]; }

  /// Throws InputError with the place.
  [[noreturn]] void fail(const FilePlace& at, const std::string& message) const;

  /// Memory for about so many; the caller bounds the counts by the size of the file.
  void reserve(std::size_t nodes, std::size_t cells);

  /// Throws InputError if a coordinate is not finite.
  void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at);

  /// Nodes in our order: corners around the cell in either direction, then the middle nodes. Returns its index.
  /// `entity`: cells with equal nodes and the same entity >= 0 are one cell that the file repeats for each of its sets.
  int add_cell(CellKind kind, std::int64_t number, std::span<const std::int64_t> nodes, int region, const FilePlace& at,
               std::int64_t entity = -1);

  /// Index of the region, set, ... of this name; a new one if there is none yet.
  int region(const std::string& name);
  int facet_set(const std::string& name) { return index_of(facet_sets_, facet_set_names_, name); }
  int node_set(const std::string& name) { return index_of(node_sets_, node_set_names_, name); }
  int cell_set(const std::string& name) { return index_of(cell_sets_, cell_set_names_, name); }

  void set_region(int cell, int region) { cells_[static_cast<std::size_t>(cell)].region = region; }
  void set_material(int region, const std::string& name) { materials_[static_cast<std::size_t>(region)] = name; }

  /// Two or three nodes: start, end, middle. No side of a cell: left out.
  void add_facet(int set, std::span<const std::int64_t> nodes);
  /// Side of a cell, from 0, as its nodes were given; nothing if it has no such side.
  bool add_side(int set, int cell, int side);
  /// All sides of a cell that no other cell has.
  void add_free_sides(int set, int cell);
  void add_node_to_set(int set, std::int64_t node) { node_sets_[static_cast<std::size_t>(set)].nodes.push_back(node); }
  void add_cell_to_set(int set, int cell) { cell_sets_[static_cast<std::size_t>(set)].cells.push_back(cell); }

  void remark(const FilePlace& at, const std::string& message);

  std::size_t nodes() const { return numbers_.size(); }
  const std::vector<std::int64_t>& node_numbers() const { return numbers_; }
  std::size_t cells() const { return cells_.size(); }
  std::int64_t cell_number(int cell) const { return cells_[static_cast<std::size_t>(cell)].number; }
  FilePlace cell_place(int cell) const;
  /// The nodes of a cell as they were given.
  std::span<const std::int64_t> cell_nodes(int cell) const;

  /// In messages the number k + (i + 1) spacing is `k of 'names[i]'`.
  void name_copies(std::int64_t spacing, const std::vector<std::string>& names) {
    spacing_ = spacing;
    copies_ = names;
  }

  /// Throws InputError for what the header of ImportedMesh excludes.
  ImportedMesh finish();
  /// After `finish`: number in the file of each node of the mesh.
  std::vector<std::int64_t> take_node_numbers() { return std::move(kept_numbers_); }

 private:
  struct RawCell {
    std::int64_t number;
    std::int64_t entity;
    std::size_t first;  // of its nodes in cell_nodes_
    int count;
    int region;
    int line;
    int file;
    CellKind kind;
  };
  struct RawFacets {
    std::string name;
    std::vector<std::int64_t> nodes;  // three per facet, middle -1 on a straight one
    std::vector<int> free_sides_of;   // cells
  };
  struct RawNodes {
    std::string name;
    std::vector<std::int64_t> nodes;
  };
  using Names = std::unordered_map<std::string, int>;

  template <class Set>
  static int index_of(std::vector<Set>& sets, Names& names, const std::string& name) {
    const auto [entry, is_new] = names.try_emplace(name, static_cast<int>(sets.size()));
    if (is_new) {
      sets.emplace_back();
      sets.back().name = name;
    }
    return entry->second;
  }

  std::string shown(std::int64_t number) const;
  std::string label(const RawCell& cell) const;
  [[noreturn]] void fail(const RawCell& cell, const std::string& message) const;

  /// Index of each cell after those that the file repeats were joined.
  std::vector<int> join_repeated_cells();
  /// Node numbers -> positions among all nodes of the file.
  void find_nodes(ImportedMesh& mesh) const;
  /// Positions -> indices of the nodes that cells have. Returns the position of each of them.
  std::vector<int> drop_unused_nodes(ImportedMesh& mesh) const;
  void check_plane(const std::vector<int>& original) const;
  void check_shapes(ImportedMesh& mesh, const std::vector<int>& original) const;
  void make_sets(ImportedMesh& mesh, const std::vector<int>& original, const std::vector<int>& joined) const;
  /// Fails if two cells cannot have the same side.
  void check_sides(const ImportedMesh& mesh, const SideTable& table, const std::vector<int>& original) const;
  FacetSet facet_set_of(const RawFacets& raw, const ImportedMesh& mesh, const SideTable& table,
                        const NumberIndex& by_number, const std::vector<int>& joined) const;
  static NodeSet node_set_of(const RawNodes& raw, const NumberIndex& by_number);

  std::vector<std::string> files_;
  bool from_zero_;
  std::int64_t spacing_ = 0;
  std::vector<std::string> copies_;
  std::vector<std::int64_t> numbers_, kept_numbers_;
  std::vector<double> coordinates_;  // three per node
  std::vector<FilePlace> node_places_;
  std::vector<RawCell> cells_;
  std::vector<std::int64_t> cell_nodes_;
  std::vector<std::string> regions_, materials_;
  std::vector<RawFacets> facet_sets_;
  std::vector<RawNodes> node_sets_;
  std::vector<CellSet> cell_sets_;
  std::vector<std::string> remarks_;
  Names region_names_, facet_set_names_, node_set_names_, cell_set_names_;
};

}  // namespace scabo::files
