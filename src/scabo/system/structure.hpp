// All bodies with their supports and loads.
#pragma once

#include <memory>
#include <vector>

#include "scabo/element/radial_load.hpp"
#include "scabo/element/stiffness.hpp"
#include "scabo/system/body_system.hpp"

namespace scabo::system {

struct Structure {
  std::vector<std::unique_ptr<BodySystem>> bodies;  ///< one for each body of the model
  /// [load][body]: generalised forces at factor 1; empty where the load does not act on the body.
  std::vector<std::vector<Vector>> loads;
  /// [load][body]: loads inside the body, at factor 1.
  std::vector<std::vector<element::InteriorLoads>> interior;
};

/// Constraints of every body, from the supports of the model. Throws InputError for supports that contradict each
/// other.
std::vector<std::vector<Constraint>> constraints_of(const model::Model& model, const mesh::Mesh& mesh);

/// Throws InputError for bodies that are held neither by supports nor by contact pairs.
void check_supports(const model::Model& model, const mesh::Mesh& mesh);

/// Stiffness of a body divided into 8-node elements.
linalg::SparseMatrix fem_stiffness(const mesh::BodyMesh& mesh, const element::Mat3& D, double thickness);

/// Factorises every body. `super_elements[body]`: its solution, null for rigid bodies and finite element meshes.
Structure make_structure(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<const element::SuperElementSolution*>& super_elements);

/// Adds the loads to a structure (apply_loads.cpp).
void add_loads(Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
               const std::vector<const element::SuperElementSolution*>& super_elements);

/// Points of a rigid body that belong to a place.
std::vector<Vec2> rigid_points(const model::Place& place, const model::Body& body);

}  // namespace scabo::system
