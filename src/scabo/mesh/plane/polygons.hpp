// Meshes of polygons: the dual of a constrained Delaunay triangulation.
//
// Each cell belongs to a vertex of the triangulation and its corners are the centroids of the triangles around it.
// Vertices lie inside the regions at about the wanted distances (interior_points), and on the lines at the middle of
// each facet and at both ends of a line:
//
//     e_0   e_1     e_2     e_3  e_4      nodes of a line (given)
//      V-----+---V---+---V---+----V       V: vertices; each facet but the first and last has one in its middle
//
// so that a facet is a side of its vertex's cell, the given nodes are those of the mesh, and lines (borders of regions,
// holes, cracks) are kept without further work. The first and the last facet belong to the cells at the ends of the
// line. An end has one cell in each region that meets there, with the end as a node, or it is the scaling centre of a
// single cell (Domain::centres): a closed one if regions of material surround it, or an open one at a crack tip or a
// corner of the body, with sides of several regions (PolygonCell::side_regions) where several meet.
//
// A line of a single facet has no vertex between its ends; the facet is a side of the cell at one of them. It is
// divided by a node at its middle, the only nodes that are not given, if both ends are scaling centres or if it is a
// crack with tips at both ends. An arc whose facets turn by more than 30 degrees, or that shares its ends with another
// short line, is treated as a chain of such lines.
//
// The vertices inside are smoothed (each moves to the centroid of the triangles around it, weighted by the density of
// points), sides shorter than a tenth of the local size are collapsed, and corners of cells move where a cell would be
// hard to see from one point. A cell that no point sees well (re-entrant corners) is divided.
#pragma once

#include "scabo/mesh/plane/domain.hpp"
#include "scabo/mesh/plane/former_vertices.hpp"

namespace scabo::mesh {

/// Spacing of the vertices inside, per wanted size: hexagons with the area of a square of that size.
constexpr double spacing_per_size = 1.0745699318235418;

/// The mesh of polygons of `domain`. All cells are simple and counter-clockwise; from its centre every side is seen
/// with 2 area / length^2 > 2e-3 (mesh::visibility), wherever the facets given allow this. The same domain always gives
/// the same mesh, and the domain scaled by a power of two the mesh scaled alike. Throws InputError, without a place in
/// a file, if lines cross or touch between their ends, if a scaling centre is not the end of a line, or if the facets
/// given are too long for the shape.
PolygonMesh polygon_mesh(const Domain& domain);
/// The same, with what stays of `former`, whose segments and vertices become those of this mesh.
PolygonMesh polygon_mesh(const Domain& domain, FormerVertices& former);

}  // namespace scabo::mesh
