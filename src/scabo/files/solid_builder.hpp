// What the readers of solids share: they hand over nodes, cells and sets as the file numbers them, in any order;
// `finish` checks them and makes the ImportedSolidMesh.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scabo/files/imported_solid_mesh.hpp"
#include "scabo/files/mesh_builder.hpp"
#include "scabo/files/number_index.hpp"
#include "scabo/files/split_solid.hpp"

namespace scabo::files {

class SolidBuilder {
 public:
  /// What becomes of a cell whose corners have the other order than ImportedSolidMesh guarantees.
  enum class TurnedCells { refused, put_in_order };

  /// Indices of the cells that one cell of the file becomes: itself, or its tetrahedra.
  struct CellRange {
    int first = 0, last = 0;  ///< without the last one
  };

  /// `files`: knows the files of all places; it outlives this.
  SolidBuilder(const MeshBuilder& files, TurnedCells turned, Bricks bricks)
      : files_(files), turned_(turned), bricks_(bricks) {}

  /// Throws InputError if a coordinate is not finite.
  void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at);

  /// As many nodes as an ImportedSolidCell may have, in its order; their numbers are not negative.
  /// `entity`: cells with equal nodes and the same entity >= 0 are one cell that the file repeats for each of its sets.
  CellRange add_cell(std::int64_t number, std::span<const std::int64_t> nodes, const FilePlace& at,
                     std::int64_t entity = -1);

  std::size_t nodes() const { return node_numbers_.size(); }
  std::size_t cells() const { return cell_numbers_.size(); }
  /// Throws InputError if two cells have one number.
  NumberIndex cell_index() const;

  /// Index of the set of this name; a new one if there is none yet.
  int node_set(const std::string& name) { return index_of(node_sets_, name); }
  int cell_set(const std::string& name) { return index_of(cell_sets_, name); }
  int side_set(const std::string& name) { return index_of(side_sets_, name); }
  int line_set(const std::string& name) { return index_of(line_sets_, name); }

  void add_node_to_set(int set, std::int64_t node) { node_sets_[static_cast<std::size_t>(set)].nodes.push_back(node); }
  void add_cell_to_set(int set, int cell) { cell_sets_[static_cast<std::size_t>(set)].cells.insert(cell); }
  void add_cells_to_set(int set, const CellRange& cells) {
    for (int cell = cells.first; cell < cells.last; ++cell) add_cell_to_set(set, cell);
  }
  void add_line(int set, std::int64_t from, std::int64_t to) {
    line_sets_[static_cast<std::size_t>(set)].lines.push_back({from, to});
  }
  void add_side(int set, const SolidSide& side);
  /// By its three or four corners; those of all cells that have it. No side of a cell: left out.
  void add_facet(int set, std::span<const std::int64_t> corners);

  /// Throws InputError for what the header of ImportedSolidMesh excludes.
  ImportedSolidMesh finish();
  /// After `finish`: of every node of the mesh; those that were added are negative.
  const std::vector<std::int64_t>& kept_numbers() const { return kept_numbers_; }

 private:
  struct RawNodes {
    std::string name;
    std::vector<std::int64_t> nodes;
  };
  struct RawLines {
    std::string name;
    std::vector<std::array<std::int64_t, 2>> lines;
  };
  struct RawCells {
    std::string name;
    std::set<int> cells;
  };
  struct RawSides {
    std::string name;
    std::vector<SolidSide> sides;
    std::vector<std::array<std::int64_t, 4>> facets;  // of triangles, the last one is no_node
  };
  using Corners = std::array<int, 4>;  // ascending; of triangles, the first one is -1
  static constexpr std::int64_t no_node = std::numeric_limits<std::int64_t>::min();

  template <class Set>
  static int index_of(std::vector<Set>& sets, const std::string& name) {
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (sets[i].name == name) return static_cast<int>(i);
    sets.emplace_back();
    sets.back().name = name;
    return static_cast<int>(sets.size()) - 1;
  }

  void check_numbers(const NumberIndex& numbers, const std::vector<FilePlace>& places, const char* what) const;
  CellRange next_cells(std::int64_t number, std::span<const std::int64_t> nodes, const FilePlace& at);
  void append(std::int64_t number, std::int64_t unique_number, std::span<const std::int64_t> nodes,
              const FilePlace& at);
  void divide(std::int64_t number, std::span<const std::int64_t> nodes, const FilePlace& at);
  void place_between();
  void make_cells(const NumberIndex& nodes, ImportedSolidMesh& mesh) const;
  void put_in_order(std::span<ImportedSolidCell> parts, std::size_t nodes_of_whole, const FilePlace& at) const;
  int sense_of(const ImportedSolidCell& cell) const;
  /// Drops nodes without a cell; `place`: of each node of the file, its index in the mesh, or -1.
  std::vector<int> keep_used_nodes(ImportedSolidMesh& mesh) const;
  void make_sets(const NumberIndex& nodes, const std::vector<int>& place, ImportedSolidMesh& mesh) const;
  void make_side_sets(const NumberIndex& nodes, const std::vector<int>& place, ImportedSolidMesh& mesh) const;

  const MeshBuilder& files_;
  TurnedCells turned_;
  Bricks bricks_;
  std::vector<std::int64_t> node_numbers_;
  std::vector<std::int64_t> cell_numbers_;     // of parts but the first, negative
  std::vector<std::int64_t> written_numbers_;  // of cells: those of parts are that of the whole, many times
  std::vector<AddedNode> between_;             // their numbers are -1, -2 and so on
  std::map<std::vector<std::int64_t>, std::int64_t> between_corners_;  // those numbers by corners
  std::map<int, std::pair<int, std::size_t>> divided_;  // by the first part, the end of them and the nodes of the whole
  std::vector<std::int64_t> kept_numbers_;
  std::vector<FilePlace> node_places_, cell_places_;
  std::vector<double> coordinates_;  // three of each node
  std::vector<std::vector<std::int64_t>> cells_;
  std::map<std::pair<std::int64_t, std::vector<std::int64_t>>, CellRange> repeated_;  // by entity and corners
  std::vector<RawNodes> node_sets_;
  std::vector<RawCells> cell_sets_;
  std::vector<RawSides> side_sets_;
  std::vector<RawLines> line_sets_;
};

}  // namespace scabo::files
