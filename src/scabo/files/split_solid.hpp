// Hexahedra and wedges as tetrahedra: from the corner with the least number to the triangles of all faces
// without it. A quadrilateral is cut from its corner with the least number, so that neighbours divide it alike.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::files {

/// Middle of a diagonal of a face, or of the whole cell, that no node of the cell has.
struct AddedNode {
  struct Edge {
    std::int64_t start, end, middle;
  };
  std::vector<std::int64_t> corners;   ///< of the face or cell, ascending, which tell it from others
  std::array<std::int64_t, 2> ends{};  ///< of the diagonal
  std::vector<Edge> edges;             ///< of the face or cell
};

struct SplitSolid {
  /// Corners in the order of ImportedSolidCell, then the middles of the edges 12, 23, 31, 14, 24, 34 of cells with
  /// middle nodes: a node, or with -k the added node k - 1.
  std::vector<std::vector<std::int64_t>> tetrahedra;
  std::vector<AddedNode> added;
};

/// By the functions of the nodes: half of the sum of the four middle nodes of a face less a quarter of that of its
/// corners; in a cell, a quarter of both. In a plane face with straight edges, and in a cell with straight edges, that
/// may be beside the diagonal, and its middle is taken: so tetrahedra have straight edges too, and faces of them pass a
/// constant pressure exactly. `at`: where a node of the file is.
Eigen::Vector3d place_of(const AddedNode& added, const std::function<Eigen::Vector3d(std::int64_t)>& at);

/// Number of nodes of an element type; nothing if it is neither C3D6, C3D8, C3D15 nor C3D20, with R, I or H.
std::optional<std::size_t> nodes_of_split(const std::string& type);

/// `nodes`: 6, 8, 15 or 20 numbers in the order of CellTopology. Corners may have one number: collapsed edges have no
/// part.
SplitSolid split_solid(std::span<const std::int64_t> nodes);

/// Triangles of a triangle or quadrilateral, cut from its corner with the least number.
std::vector<std::array<std::int64_t, 3>> triangles_of_facet(std::vector<std::int64_t> corners);

/// The triangles of side S`side`, from 1; empty if there is none of that number.
std::vector<std::vector<std::int64_t>> triangles_of_side(std::span<const std::int64_t> nodes, int side);

}  // namespace scabo::files
