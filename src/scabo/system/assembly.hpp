// Stiffness and mass of a body, or of a part of tied bodies, from those of its cells, super-elements and finite
// elements alike.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "scabo/element/cell_library.hpp"
#include "scabo/system/body_system.hpp"
#include "scabo/system/dofs.hpp"

namespace scabo::system {

/// Whether a body is one super-element with the same node numbers.
bool is_whole(const mesh::BodyMesh& mesh);

/// Stiffness of a body: that of its super-element, shared with it, if it is one; otherwise sparse. The same bits on any
/// number of threads. `extent`: of the body, across the plane.
Stiffness body_stiffness(const model::Model& model, const Extent& extent, const mesh::BodyMesh& mesh,
                         const element::SolvedCells& cells, int threads = 1);

/// Stiffness of an elastic part; that of several tied bodies is sparse.
Stiffness part_stiffness(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<element::SolvedCells>& cells, const Dofs& dofs, std::size_t part,
                         int threads = 1);

/// Masses of super-elements, each distinct one computed once.
class MassLibrary {
 public:
  using MassOf = std::function<Matrix(const element::SolvedSuperElement&)>;
  explicit MassLibrary(MassOf compute) : compute_(std::move(compute)) {}
  std::shared_ptr<const Matrix> of(const element::SolvedSuperElement& super_element);

 private:
  MassOf compute_;
  std::map<const element::SolvedSuperElement*, std::shared_ptr<const Matrix>> known_;
};

/// Masses of the super-elements of a model, which outlives the library. Every material needs a density.
MassLibrary masses_of(const model::Model& model, int threads);

/// Mass, stored like the stiffness. Every material needs a density.
Stiffness body_mass(const model::Model& model, const Extent& extent, const mesh::BodyMesh& mesh,
                    const element::SolvedCells& cells, MassLibrary& masses);

/// Mass of an elastic part, stored like its stiffness.
Stiffness part_mass(const model::Model& model, const mesh::Mesh& mesh, const std::vector<element::SolvedCells>& cells,
                    const Dofs& dofs, std::size_t part, MassLibrary& masses);

/// Rayleigh damping of an elastic part, each cell by its material, stored like its stiffness; without any, nothing.
std::optional<Stiffness> part_damping(const model::Model& model, const mesh::Mesh& mesh,
                                      const std::vector<element::SolvedCells>& cells, const Dofs& dofs,
                                      std::size_t part, MassLibrary& masses);

}  // namespace scabo::system
