// Edges and points of bodies in space: where faces of a body, sets of facets, meet.
#pragma once

#include <array>
#include <vector>

#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::mesh {

/// Both ends and the node in the middle of a curve of an element, quadratic.
using SolidEdge = std::array<int, 3>;

/// Edges that a facet of `a` and one of `b` have in common. Facets that both have are left out.
std::vector<SolidEdge> edges_between(const std::vector<SolidFacet>& a, const std::vector<SolidFacet>& b);
/// Corners that facets of all faces have in common, ascending. Facets that two faces have are left out.
std::vector<int> corners_between(const std::vector<std::vector<SolidFacet>>& faces);

/// Of the edges of these facets, those whose nodes are in a set; nodes from `given` on are not of the file and count as
/// members.
std::vector<SolidEdge> edges_among(const std::vector<SolidFacet>& facets, const std::vector<int>& nodes, int given);
/// The edges of cells with these ends.
std::vector<SolidEdge> edges_with_ends(const SolidMesh& mesh, const std::vector<std::array<int, 2>>& ends);

/// Of several pieces that have no node in common, the one whose nodes come nearest to a point.
std::vector<SolidEdge> piece_nearest(const SolidMesh& mesh, const std::vector<SolidEdge>& edges,
                                     const Eigen::Vector3d& point);

/// All nodes, ascending.
std::vector<int> nodes_of_edges(const std::vector<SolidEdge>& edges);

}  // namespace scabo::mesh
