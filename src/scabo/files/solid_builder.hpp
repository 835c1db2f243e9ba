// What the readers of solids share: they hand over nodes, cells and sets as the file numbers them, in any order;
// `finish` checks them and makes the ImportedSolidMesh.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scabo/files/imported_solid_mesh.hpp"
#include "scabo/files/mesh_builder.hpp"
#include "scabo/files/number_index.hpp"

namespace scabo::files {

class SolidBuilder {
 public:
  /// What becomes of a cell whose corners have the other order than ImportedSolidMesh guarantees.
  enum class TurnedCells { refused, put_in_order };

  /// `files`: knows the files of all places; it outlives this.
  SolidBuilder(const MeshBuilder& files, TurnedCells turned) : files_(files), turned_(turned) {}

  /// Throws InputError if a coordinate is not finite.
  void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at);

  /// As many nodes as an ImportedSolidCell may have, in its order; 4 or 10 of a cell with an entity. Returns its index.
  /// `entity`: cells with equal nodes and the same entity >= 0 are one cell that the file repeats for each of its sets.
  int add_cell(std::int64_t number, std::span<const std::int64_t> nodes, const FilePlace& at, std::int64_t entity = -1);

  /// A tetrahedron that is a part of cell `number`, which the caller knows to be there once. Returns its index.
  int add_part(std::int64_t number, std::span<const std::int64_t> nodes, const FilePlace& at);
  /// A node at the sum of weight * node; its number is negative.
  void add_between(std::int64_t number, std::vector<std::int64_t> nodes, std::vector<double> weights);

  std::size_t nodes() const { return node_numbers_.size(); }
  std::size_t cells() const { return cell_numbers_.size(); }
  /// Throws InputError if two cells have one number.
  NumberIndex cell_index() const;

  /// Index of the set of this name; a new one if there is none yet.
  int node_set(const std::string& name) { return index_of(node_sets_, name); }
  int cell_set(const std::string& name) { return index_of(cell_sets_, name); }
  int side_set(const std::string& name) { return index_of(side_sets_, name); }

  void add_node_to_set(int set, std::int64_t node) { node_sets_[static_cast<std::size_t>(set)].nodes.push_back(node); }
  void add_cell_to_set(int set, int cell) { cell_sets_[static_cast<std::size_t>(set)].cells.insert(cell); }
  void add_side(int set, const SolidSide& side);
  /// By its three corners; those of all cells that have it. No side of a cell: left out.
  void add_facet(int set, std::span<const std::int64_t> corners);

  /// Throws InputError for what the header of ImportedSolidMesh excludes.
  ImportedSolidMesh finish();
  /// After `finish`: of every node of the mesh; those that were added are negative.
  const std::vector<std::int64_t>& kept_numbers() const { return kept_numbers_; }

 private:
  struct Between {
    std::int64_t number;
    std::vector<std::int64_t> nodes;
    std::vector<double> weights;
  };
  struct RawNodes {
    std::string name;
    std::vector<std::int64_t> nodes;
  };
  struct RawCells {
    std::string name;
    std::set<int> cells;
  };
  struct RawSides {
    std::string name;
    std::vector<SolidSide> sides;
    std::vector<std::array<std::int64_t, 3>> facets;
  };
  using Corners = std::array<int, 3>;  // ascending

  template <class Set>
  static int index_of(std::vector<Set>& sets, const std::string& name) {
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (sets[i].name == name) return static_cast<int>(i);
    sets.emplace_back();
    sets.back().name = name;
    return static_cast<int>(sets.size()) - 1;
  }

  void check_numbers(const NumberIndex& numbers, const std::vector<FilePlace>& places, const char* what) const;
  void place_between();
  void make_cells(const NumberIndex& nodes, ImportedSolidMesh& mesh) const;
  void check_cell(ImportedSolidCell& cell, const FilePlace& at) const;
  /// Drops nodes without a cell; `place`: of each node of the file, its index in the mesh, or -1.
  std::vector<int> keep_used_nodes(ImportedSolidMesh& mesh) const;
  void make_sets(const NumberIndex& nodes, const std::vector<int>& place, ImportedSolidMesh& mesh) const;
  void make_side_sets(const NumberIndex& nodes, const std::vector<int>& place, ImportedSolidMesh& mesh) const;

  const MeshBuilder& files_;
  TurnedCells turned_;
  std::vector<std::int64_t> node_numbers_, cell_numbers_;
  std::vector<std::int64_t> written_numbers_;  // of cells: those of parts are that of the whole, many times
  std::vector<Between> between_;
  std::vector<std::int64_t> kept_numbers_;
  std::vector<FilePlace> node_places_, cell_places_;
  std::vector<double> coordinates_;  // three of each node
  std::vector<std::vector<std::int64_t>> cells_;
  std::map<std::pair<std::int64_t, std::array<std::int64_t, 4>>, int> repeated_;  // by entity and corners
  std::vector<RawNodes> node_sets_;
  std::vector<RawCells> cell_sets_;
  std::vector<RawSides> side_sets_;
};

}  // namespace scabo::files
