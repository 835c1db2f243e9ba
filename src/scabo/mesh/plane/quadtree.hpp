// A quadtree over a plane region: cells of the wanted size, halved towards small features. Cells that no line cuts are
// equal rectangles (squares where the body allows it) with up to four hanging nodes; cells that lines cut are polygons.
//
// Equal roots side by side cover the bounding box exactly, so that axis-parallel rectangles are meshed by uncut cells.
// Nodes of uncut cells are whole multiples of one length, so that equal cells have equal coordinates relative to their
// centre, up to rounding. Cells that share a side or a corner differ by one halving at most, except across the outside.
#pragma once

#include <functional>

#include "scabo/mesh/plane/domain.hpp"

namespace scabo::mesh {

struct QuadtreeOptions {
  /// Length, >= 0: cells are not halved below it on account of lines, except where lines could not be told apart
  /// otherwise, and on circles of less than its 2/3 in radius. 0: 1/32 of the wanted size at the cell.
  double min_size = 0.0;
  /// Radians, > 0: a cell on an arc is not larger than this times the radius, unless min_size forbids it.
  double turn = 0.5;
  /// In parts of the size of a cell, 0 to 0.3: sides that cutting makes shorter than this are collapsed where the cells
  /// around remain well shaped.
  double shortest_side = 0.15;
  /// Sides on arcs are going to be arcs: cells see their hollow sides, too. Otherwise they see the chords.
  bool curved_sides = false;
  /// Wanted size from which the roots are made; empty: that of the domain. Meshes of the same roots are nested where no
  /// line cuts them.
  std::function<double(const Vec2&)> size_of_roots = {};
};

/// The mesh. Nodes on a line are on it to rounding; a side on an arc is the chord between two of them. Of the points of
/// a line only the first and the last are nodes. A line is straight if it has no arc. The chain of a line from a centre
/// to a node of the centre's cell is this node alone.
///
/// A point of domain.centres becomes the centre of a cell made of those within about one cell's size: an open one at
/// the tip of a crack or a corner of the body, a closed one where only regions meet. Lines between regions that end
/// there have no nodes inside this cell; its sides know their regions. Points at which more than one crack or part of
/// the outside ends keep their node.
///
/// Throws InputError if lines cut squares of every size into parts that are no cells: they are too close to each other,
/// or meet elsewhere than at their ends.
PolygonMesh quadtree_mesh(const Domain& domain, const QuadtreeOptions& options = {});

}  // namespace scabo::mesh
