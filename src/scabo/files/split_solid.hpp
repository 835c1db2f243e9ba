// Hexahedra and wedges of Abaqus as tetrahedra: from the corner with the least number to the triangles of all faces
// without it. A quadrilateral is cut from its corner with the least number, so that neighbours divide it alike.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scabo::files {

/// Middle of a face, or of the whole cell, that no node of the cell has: the sum of weight * node.
struct AddedNode {
  std::vector<std::int64_t> corners;  ///< ascending, which tell it from others
  std::vector<std::int64_t> nodes;
  std::vector<double> weights;
};

struct SplitSolid {
  /// Corners in the order of ImportedSolidCell, then the middles of the edges 12, 23, 31, 14, 24, 34 of cells with
  /// middle nodes: a node, or with -k the added node k - 1.
  std::vector<std::vector<std::int64_t>> tetrahedra;
  std::vector<AddedNode> added;
};

/// Number of nodes of an element type; nothing if it is neither C3D6, C3D8, C3D15 nor C3D20, with R, I or H.
std::optional<std::size_t> nodes_of_split(const std::string& type);

/// `nodes`: 6, 8, 15 or 20 numbers in the order of Abaqus. Corners may have one number: collapsed edges have no part.
SplitSolid split_solid(std::span<const std::int64_t> nodes);

/// The triangles of side S`side`, from 1; empty if there is none of that number.
std::vector<std::vector<std::int64_t>> triangles_of_side(std::span<const std::int64_t> nodes, int side);

}  // namespace scabo::files
