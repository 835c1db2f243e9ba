// Bodies of tetrahedra in space as parts of a structure: their stiffness, their loads and their contact pairs.
//
// Vectors of a body have three components for each node of its mesh.
#pragma once

#include "scabo/element/space/tetrahedron.hpp"
#include "scabo/mesh/space/facet_pairs.hpp"
#include "scabo/mesh/space/solid_mesh.hpp"
#include "scabo/system/contact_system.hpp"

namespace scabo::system {

/// Stress = D strain in all cells.
Stiffness solid_stiffness(const mesh::SolidMesh& mesh, const element::Mat6& D);

/// Holds component `axis` of a node at `value`.
Constraint held_along_axis(int node, int axis, double value = 0.0);

/// Nodal forces of a force per volume.
Vector volume_forces(const mesh::SolidMesh& mesh, const Eigen::Vector3d& per_volume);
/// Of a traction on facets.
Vector traction_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets,
                       const Eigen::Vector3d& traction);
/// Of a pressure on facets, against their outward normal.
Vector pressure_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets, double pressure);

/// The pairs of two faces, those of `a` on part `part_a` and so on.
std::vector<PairPoints> points_of(const std::vector<mesh::FacetPair>& pairs, std::size_t part_a, std::size_t part_b);

}  // namespace scabo::system
