// Every distinct super-element of a mesh is solved once, and all equal ones share the solution.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "scabo/element/plane/held_faces.hpp"
#include "scabo/element/plane/sectors.hpp"
#include "scabo/element/plane/stress_intensity.hpp"
#include "scabo/element/sbfem/internal_level.hpp"

namespace scabo::element {

/// Super-elements of equal shape are one, in spite of the rounding of their coordinates, while these differ by less
/// than this part of their size. A stiffness of coordinates that differ by d resists rotation by as much: 1e-9 of the
/// size left 1.4e-10 of the forces unbalanced.
inline constexpr double most_apart = 1e-11;

/// A super-element, solved once for all that are equal to it but for a translation.
struct SolvedSuperElement {
  Ring ring;
  Sectors sectors;
  double thickness = 1.0;
  Domain domain;
  int threads = 1;                                   ///< number of threads for its modes
  std::shared_ptr<const mesh::HeldFaces> held = {};  ///< null: its side faces are free
  double scale = 1.0;                                ///< mesh::Cell::scale

  /// Its stiffness comes from `solution`.
  void set(SuperElementSolution solution);
  /// Its stiffness comes from a batch, or from held faces, with SuperElementSolution::rounding; the rest is solved when
  /// first needed, as if all faces were free.
  void set(Matrix K, double rounding);

  // Of a super-element that was not solved with the others (another process did), all are computed when first needed.
  const Matrix& K() const { return whole_ ? whole_->K : is_set() ? K_ : solution().K; }  ///< n x n, symmetric
  double rounding() const { return is_set() ? rounding_ : solution().rounding; }  ///< SuperElementSolution::rounding
  // Computed when first needed; these may be called from several threads.
  const SuperElementSolution& solution() const;
  const ModalSolution& modes() const;  ///< of the interior
  /// One internal level, and its modes; `density`: of every material, always the same.
  const InternalLevel& level(const std::vector<double>& density) const;
  const InternalModes& level_modes(const std::vector<double>& density) const;
  const CornerAnalysis& corner() const;  ///< of its crack or corner; the ring must be open
  /// Of its crack or corner, which for a super-element on a line of symmetry is that of both halves together. Lengths
  /// that factors refer to are those of the body from which rings have left this cell.
  StressIntensity factors(const Vector& u, const std::vector<RadialLoad>& loads = {}) const;

 private:
  bool is_set() const { return whole_ || K_.size() > 0; }

  Matrix K_;
  double rounding_ = 0.0;
  std::unique_ptr<const SuperElementSolution> whole_;  // null: K_ is from a batch
  mutable std::once_flag solution_flag_, modes_flag_, corner_flag_, level_flag_, level_modes_flag_;
  mutable std::unique_ptr<const SuperElementSolution> solution_;  // where K_ is from a batch
  mutable std::unique_ptr<const ModalSolution> modes_;
  mutable std::unique_ptr<const CornerAnalysis> corner_;
  mutable std::unique_ptr<const InternalLevel> level_;
  mutable std::unique_ptr<const InternalModes> level_modes_;
  mutable std::unique_ptr<const Mirrored> both_;  // halves: of held->mirror
  mutable std::unique_ptr<const SuperElementSolution> solution_of_both_;
};

/// Of one body, for each cell; null for finite elements. Empty for a rigid body.
using SolvedCells = std::vector<std::shared_ptr<const SolvedSuperElement>>;

/// Numbers of the degrees of freedom of a cell's own nodes in the body, two for each.
std::vector<int> dofs_of(const mesh::Cell& cell);

/// Solves the super-elements of all bodies, each distinct one once, on up to `threads` threads; [body][cell]. Two are
/// equal if their boundaries relative to the scaling centre, their elasticity and their thickness agree. Throws
/// InputError for those that cannot be solved, and for finite elements that are folded. `elsewhere`: one for each body
/// whose cells other processes solve, or empty; here they are solved when they are first needed. `before`: solutions on
/// another mesh of the model; those of super-elements that are the same to the last bit are taken, which changes no
/// result.
std::vector<SolvedCells> solve_cells(const model::Model& model, const mesh::Mesh& mesh, int threads,
                                     const std::vector<char>& elsewhere = {},
                                     const std::vector<SolvedCells>& before = {});

}  // namespace scabo::element
