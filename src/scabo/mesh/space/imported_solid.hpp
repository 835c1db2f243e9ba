// A body from a mesh file: its mesh, and the facets that named sets of the file are.
#pragma once

#include "scabo/files/imported_solid_mesh.hpp"
#include "scabo/mesh/space/solid_mesh.hpp"

namespace scabo::mesh {

/// All cells quadratic: linear ones get straight edges, but where a quadratic neighbour has its middle node.
SolidMesh solid_mesh_of(const files::ImportedSolidMesh& file);

/// The sides of cells, as facets whose normals are outwards.
std::vector<SolidFacet> facets_of_sides(const SolidMesh& mesh, const std::vector<files::SolidSide>& sides);

/// Of these facets, those whose corners are all among `nodes`.
std::vector<SolidFacet> facets_among(const std::vector<SolidFacet>& facets, const std::vector<int>& nodes);

}  // namespace scabo::mesh
