// What acts on edges of bodies in space. Vectors have three components for each node of the mesh.
#pragma once

#include <functional>

#include "scabo/mesh/space/solid_edges.hpp"
#include "scabo/system/solid_springs.hpp"

namespace scabo::system {

double length_of_edges(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidEdge>& edges);

/// int N ds of every node of the mesh.
Vector length_weights_of(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidEdge>& edges);

/// Nodal forces of a force per length.
Vector line_load_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidEdge>& edges,
                        const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& load);

/// Force / length^2 along the axes.
SolidSpring springs_on_edges(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidEdge>& edges,
                             const Eigen::Vector3d& k);

}  // namespace scabo::system
