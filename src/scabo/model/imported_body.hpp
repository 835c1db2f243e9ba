// The part of a mesh file that is one body, with an outline made from the sides of its cells.
//
// Sides that belong to one cell of the part only are its boundary. It is cut into edges:
//     sides of a facet set                   an edge with the name of the set; where a set has several pieces, or
//     begins
//                                            within another one, the pieces are NAME, NAME_2, ...
//     sides with a cell of another part      likewise, `to_NAME` with the name of the region of that cell
//     all other sides                        edge_1, edge_2, ... from corner to corner
// Corners are the starts of edges, vertex_1, vertex_2, ...: the boundary of every loop begins at its lowest corner, the
// one furthest to the left if there are several. Sides without a set are cut where the boundary turns by more than 30
// degrees, and at nodes that are alone in a node set, whose names are further names of corners.
//
// Cells of one region that are not all joined by sides are several parts, each a body. Sides of two parts that have
// nodes of their own in the same places may be joined before (`join`).
//
// Names of the file are made names of Scabo: other characters become `_`. A chain of sides on one line becomes a
// straight edge; sides with a middle node that are curved become 32 straight segments each.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scabo/files/imported_mesh.hpp"
#include "scabo/geometry/plane/outline.hpp"

namespace scabo::model {

struct ImportedBody {
  /// The cells of the part and their nodes. facet_sets[i]: the sides along edge i of the outline, in their order; other
  /// sets are left out.
  std::shared_ptr<const files::ImportedMesh> mesh;
  geometry::Outline outline;  ///< the outer boundary, then the holes
  /// Of every edge that is the first of several pieces of a set: the names of the others.
  std::map<std::string, std::vector<std::string>> pieces;
  /// Sets of sides that are not all on the boundary, by name: the end points of their sides in chains, in the direction
  /// of the file where it has one for a whole chain. What a crack may follow.
  std::map<std::string, std::vector<std::vector<Vec2>>> lines;
  std::map<std::string, Vec2> lost_points;  ///< names of nodes that are no corners because they lie within a named edge
};

/// Parts of a mesh file that are bodies, in the order of their first cells.
struct ImportedBodies {
  std::vector<ImportedBody> parts;
  int joined_nodes = 0;  ///< how many nodes lay in the place of another one and were joined to it
};

/// Cells of a mesh file: a region, a set of cells or all.
struct CellChoice {
  int region = -1, set = -1;
};

/// Bodies of the chosen cells; or, as a sentence, why these are none. `join`: whole sides of two parts in the same
/// place become one.
std::variant<ImportedBodies, std::string> imported_bodies(const files::ImportedMesh& mesh, const CellChoice& choice,
                                                          bool join);

/// `text` with every character that a name cannot have replaced by `_`.
std::string name_from(std::string_view text);

}  // namespace scabo::model
