// Bodies in space as parts of a structure: their stiffness, their loads and their contact pairs.
//
// Vectors of a body have three components for each node of its mesh. `solved`: the super-elements of an elastic body.
#pragma once

#include "scabo/element/space/facet.hpp"
#include "scabo/element/space/solid_cell.hpp"
#include "scabo/mesh/space/facet_pairs.hpp"
#include "scabo/mesh/space/solid_mesh.hpp"
#include "scabo/system/contact_system.hpp"

namespace scabo::system {

/// Stress = D strain in all cells.
Stiffness solid_stiffness(const mesh::SolidMesh& mesh, const element::Mat6& D,
                          const element::SuperElements& solved = {});

/// Holds component `axis` of a node at `value`.
Constraint held_along_axis(int node, int axis, double value = 0.0);

/// Nodal forces of a force per volume.
Vector volume_forces(const mesh::SolidMesh& mesh, const Eigen::Vector3d& per_volume,
                     const element::SuperElements& solved = {});
/// Of a traction on facets.
Vector traction_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets,
                       const Eigen::Vector3d& traction);
/// Of a pressure on facets, against their outward normal.
Vector pressure_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets, double pressure);

/// Of a traction that varies.
Vector varying_traction_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets,
                               const element::TractionAt& traction);
/// Of a moment on facets: the traction w x (point - their centroid), which has no resultant.
Vector moment_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets,
                     const Eigen::Vector3d& moment);
double area_of_facets(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets);
Eigen::Vector3d centroid_of_facets(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets);

/// Volume and centroid of a body, and the weight of every node in integrals over it.
struct SolidVolume {
  Vector weights;  ///< int N dV
  double volume = 0.0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
};
SolidVolume volume_of(const mesh::SolidMesh& mesh);
/// Nodal forces of a force at the centroid of a rigid body and a moment on it.
Vector forces_on_rigid(const mesh::SolidMesh& mesh, const Eigen::Vector3d& force, const Eigen::Vector3d& moment);

/// Nodal forces of changes of temperature of the nodes that would strain a free body by `expansion` times them.
Vector thermal_forces(const mesh::SolidMesh& mesh, const element::Mat6& D, double expansion, const Vector& change,
                      const element::SuperElements& solved = {});
/// What they store while all nodes are held.
double held_thermal_energy(const mesh::SolidMesh& mesh, const element::Mat6& D, double expansion, const Vector& change,
                           const element::SuperElements& solved = {});

/// The pairs of two faces, those of `a` on part `part_a` and so on.
std::vector<PairPoints> points_of(const std::vector<mesh::FacetPair>& pairs, std::size_t part_a, std::size_t part_b);

}  // namespace scabo::system
