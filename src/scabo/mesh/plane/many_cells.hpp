// Bodies of many super-elements: polygons, or the squares of a quadtree.
#pragma once

#include <variant>

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/domain.hpp"
#include "scabo/mesh/plane/former_vertices.hpp"
#include "scabo/mesh/plane/graded_edge.hpp"
#include "scabo/mesh/plane/narrow_places.hpp"
#include "scabo/mesh/plane/size_field.hpp"

namespace scabo::mesh {

/// The outline, the regions and the cracks of a body as lines, divided by wanted_size or less in narrow places. It
/// holds on to `body` and to `sizes`. If the cells in narrow places are too many (NarrowOptions), it has no lines.
struct BodyDomain {
  Domain domain;  ///< region 0 is the body outside of its regions, and region k + 1 is body.regions[k]
  std::vector<std::vector<std::size_t>> lines_of_edge;   ///< the lines of each edge of the outline, in its direction
  std::vector<std::vector<std::size_t>> lines_of_crack;  ///< the lines of each crack, in the direction of its path
  std::vector<NetLine> sources;                          ///< what each line is a part of
  std::vector<FormerLine> divided;                       ///< how whole lines were divided
  NarrowPlaces narrow;
};
/// `former`: lines that were divided before, and stay so where that is fine enough.
BodyDomain domain_of(const model::Body& body, const SizeField& sizes, const NarrowOptions& options,
                     const std::vector<FormerLine>& former = {});

/// Divides a body into cells, of polynomial order mesh.order; or says why this is not possible. `most_nodes`: at most
/// about as many nodes. `former`: of polygons, from what those before were made; becomes that of these.
std::variant<BodyMesh, Diagnostic> divide_into_cells(const model::Body& body, const SizeField& sizes, double most_nodes,
                                                     FormerVertices* former = nullptr);

/// Line elements of the given order on the sides of polygons; sides on arcs are curved. `of`: the domain of the body,
/// in which polygons were made.
BodyMesh body_mesh_of(const PolygonMesh& polygons, const BodyDomain& of, const model::Body& body);

}  // namespace scabo::mesh
