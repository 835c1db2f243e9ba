// All bodies with their supports and loads.
#pragma once

#include <memory>
#include <vector>

#include "scabo/element/stiffness.hpp"
#include "scabo/system/body_system.hpp"

namespace scabo::system {

struct Structure {
  std::vector<std::unique_ptr<BodySystem>> bodies;  ///< one for each body of the model
  /// [load][body]: generalised forces at factor 1; empty where the load does not act on the body.
  std::vector<std::vector<Vector>> loads;
  /// [load][body]: body force at factor 1, force / length^3.
  std::vector<std::vector<Vec2>> body_forces;
};

/// Constraints of every body, from the supports of the model. Throws InputError for supports that contradict each other.
std::vector<std::vector<Constraint>> constraints_of(const model::Model& model, const mesh::Mesh& mesh);

/// Throws InputError for bodies that neither supports nor contact pairs hold.
void check_supports(const model::Model& model, const mesh::Mesh& mesh);

/// Stiffness of a body divided into 8-node elements.
linalg::SparseMatrix fem_stiffness(const mesh::BodyMesh& mesh, const element::Mat3& D, double thickness);

/// Factorises every body. `super_elements[body]`: its solution, null for rigid bodies and FE meshes.
Structure make_structure(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<const element::SuperElementSolution*>& super_elements);

/// Adds the loads to a structure.
void add_loads(Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
               const std::vector<const element::SuperElementSolution*>& super_elements);

/// Area-weighted body load of one body, two per node: int N dV b for b in x and y is this times b.
/// For a super-element this is equivalent in the semi-analytical sense (element/modal_solution.hpp, eq. 4).
Vector body_load(const mesh::BodyMesh& mesh, const element::SuperElementSolution* super_element, double thickness,
                 const Vec2& body_force);

}  // namespace scabo::system
