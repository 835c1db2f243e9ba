// Every distinct super-element of a mesh is solved once, and all equal ones share the solution.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "scabo/element/modal_solution.hpp"
#include "scabo/element/sectors.hpp"
#include "scabo/element/stress_intensity.hpp"

namespace scabo::element {

/// A super-element, solved once for all that are equal to it but for a translation.
struct SolvedSuperElement {
  Ring ring;
  Sectors sectors;
  double thickness = 1.0;
  Domain domain;
  int threads = 1;  ///< number of threads for its modes
  SuperElementSolution solution;
  /// Modes of the interior, computed when first needed; may be called from several threads.
  const ModalSolution& modes() const;
  /// Analysis of its crack or corner, computed when first needed; the ring must be open.
  const CornerAnalysis& corner() const;

 private:
  mutable std::once_flag modes_flag_, corner_flag_;
  mutable std::unique_ptr<CornerAnalysis> corner_;
  mutable std::unique_ptr<ModalSolution> modes_;
};

/// Of one body, for each cell; null for finite elements. Empty for a rigid body.
using SolvedCells = std::vector<std::shared_ptr<const SolvedSuperElement>>;

/// Numbers of the degrees of freedom of a cell's own nodes in the body, two for each.
std::vector<int> dofs_of(const mesh::Cell& cell);

/// Solves the super-elements of all bodies, each distinct one once, on up to `threads` threads; [body][cell]. Two are
/// equal if their boundaries relative to the scaling centre, their elasticity and their thickness agree. Throws
/// InputError for those that cannot be solved, and for finite elements that are folded.
std::vector<SolvedCells> solve_cells(const model::Model& model, const mesh::Mesh& mesh, int threads);

}  // namespace scabo::element
