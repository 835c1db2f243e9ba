// Bodies of many super-elements: polygons, or the squares of a quadtree.
#pragma once

#include <variant>

#include "scabo/mesh/domain.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// Wanted length of the sides of cells at a point of the body: mesh.size, and less near places of mesh.refine.
double wanted_size(const model::Body& body, const Vec2& x);

/// The outline and the regions of a body, divided by wanted_size. Region 0 is the body outside of its regions, and region
/// k + 1 is body.regions[k].
Domain domain_of(const model::Body& body);

/// Divides a body into cells, of polynomial order mesh.order; or says why this is not possible. `most_nodes`: at most
/// about as many nodes.
std::variant<BodyMesh, Diagnostic> divide_into_cells(const model::Body& body, double most_nodes);

/// Line elements of the given order on the sides of polygons; sides on arcs are curved. `domain`: that of the body, in
/// which polygons were made.
BodyMesh body_mesh_of(const PolygonMesh& polygons, const Domain& domain, const model::Body& body);

}  // namespace scabo::mesh
