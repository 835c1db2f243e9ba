// A plane mesh as a file gives it: nodes, cells and named sets, in one form for all formats (docs/mesh_files.md).
//
// Lengths are in the unit of the file. The readers guarantee: every node belongs to a cell; all coordinates are finite;
// the corners of a cell are counter-clockwise and its Jacobian is positive at its nodes (a polygon is simple and has a
// positive area); two cells that share a side lie on different sides of it. Nodes with equal coordinates stay apart:
// they may separate two bodies.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::files {

enum class CellKind : unsigned char { triangle3, quad4, triangle6, quad8, polygon, quadratic_polygon };

/// True if the cell has a node in the middle of each side.
bool is_quadratic(CellKind kind);

/// `quadrilateral with 8 nodes`
std::string_view name_of(CellKind kind);

/// One cell. `nodes`: the corners counter-clockwise, then, if it is quadratic, the middle nodes of sides 12, 23, ...
struct ImportedCell {
  CellKind kind = CellKind::triangle3;
  std::vector<int> nodes;
  int region = 0;   ///< index into ImportedMesh::regions
  long number = 0;  ///< as in the file; in .vtu files its position from 0
  int line = 0;     ///< from 1; 0 in binary data

  int corners() const { return static_cast<int>(nodes.size()) / (is_quadratic(kind) ? 2 : 1); }
};

/// A side of a cell. `middle` is -1 on a straight side.
struct Facet {
  int start = -1;
  int end = -1;
  int middle = -1;
  friend bool operator==(const Facet&, const Facet&) = default;
};

/// Sides of cells, without repetition. On the boundary of the mesh they have the material on their left; between two
/// cells they have the direction of the file.
struct FacetSet {
  std::string name;
  std::vector<Facet> facets;
};

/// Nodes, without repetition.
struct NodeSet {
  std::string name;
  std::vector<int> nodes;
};

/// Cells, without repetition, in ascending order. A cell has one region but may be in several sets.
struct CellSet {
  std::string name;
  std::vector<int> cells;
};

struct ImportedMesh {
  std::vector<Vec2> nodes;
  std::vector<ImportedCell> cells;
  std::vector<std::string> regions;    ///< in the order of their first cell; each has at least one
  std::vector<std::string> materials;  ///< per region: the material that a section of the file gives it, else empty
  std::vector<FacetSet> facet_sets;    ///< none is empty
  std::vector<NodeSet> node_sets;      ///< none is empty
  std::vector<CellSet> cell_sets;      ///< none is empty
  std::vector<std::string> remarks;    ///< what of the file was left out though it may matter, for the user to read
};

/// Side `i` of a cell, from corner i to corner i + 1: counter-clockwise around it.
Facet side_of(const ImportedCell& cell, int i);

/// Area of a cell; curved sides are parabolas through their three nodes.
double area_of(const ImportedMesh& mesh, const ImportedCell& cell);

/// Length of a facet; of a curved one by Gauss's rule with 5 points (exact if straight).
double length_of(const ImportedMesh& mesh, const Facet& facet);

/// A closed part of the boundary: every facet starts where the one before it ends, and has the material on its left.
struct BoundaryLoop {
  std::vector<Facet> facets;
  double area = 0.0;  ///< enclosed: positive for an outer boundary, negative for a hole
  bool hole() const { return area < 0.0; }
};

/// The sides that belong to one cell only, joined to closed loops, in the order of their first cell. Two parts of the
/// mesh that meet at one node only have loops of their own.
std::vector<BoundaryLoop> boundary_facets(const ImportedMesh& mesh);

}  // namespace scabo::files
