#include "scabo/mesh/plane/polygons.hpp"

#include <algorithm>

#include "scabo/base/error.hpp"
#include "scabo/mesh/plane/dual_cells.hpp"
#include "scabo/mesh/plane/dual_vertices.hpp"
#include "scabo/mesh/plane/polygon_quality.hpp"

namespace scabo::mesh {
namespace {

PolygonMesh mesh_of(const Domain& domain, bool divide_arcs, FormerVertices& former) {
  FormerVertices kept = former;
  PolygonMesh mesh =
      improved(dual_cells(domain, triangulate_domain(domain, vertices_on_lines(domain, divide_arcs), kept)));
  former = std::move(kept);
  return mesh;
}

}  // namespace

PolygonMesh polygon_mesh(const Domain& domain) {
  FormerVertices none;
  return polygon_mesh(domain, none);
}

PolygonMesh polygon_mesh(const Domain& domain, FormerVertices& former) {
  const bool arcs = std::any_of(domain.lines.begin(), domain.lines.end(),
                                [](const DomainLine& line) { return line.arc.has_value(); });
  if (arcs) try {
      return mesh_of(domain, false, former);
    } catch (const InputError&) {
      // Vertices at every node of an arc follow its facets more closely.
    }
  return mesh_of(domain, true, former);
}

}  // namespace scabo::mesh
