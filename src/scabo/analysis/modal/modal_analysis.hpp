// Natural frequencies and modes of the elastic bodies of a model: Model -> Mesh -> stiffness and mass -> modes. Bodies
// that are not tied do not interact: contacts, loads and steps are ignored, prescribed displacements are 0
// (Model::warnings says so).
#pragma once

#include "scabo/analysis/march/options.hpp"

namespace scabo::analysis {

struct NaturalMode {
  std::vector<int> bodies;    ///< indices of the bodies that vibrate: one, or several that are tied
  bool rigid = false;         ///< rigid-body mode: its frequency is exactly 0
  double frequency = 0.0;     ///< 1 / time (SI: Hz)
  std::vector<Vector> shape;  ///< of these bodies, 2 per node; the largest displacement of a node is 1
  /// Of these bodies: motion of the internal level of one that is one super-element, else empty.
  std::vector<Vector> internal;
  double modal_mass = 0.0;             ///< shape' M shape, mass
  Vec2 effective_mass = Vec2::Zero();  ///< of motions of the supports along x and y, mass: (shape' M r)^2 / modal mass
  double residual = 0.0;               ///< of K phi = omega^2 M phi, free of units (system/natural_modes.hpp)
};

/// Seconds.
struct ModalTiming {
  double read = 0.0, mesh = 0.0, super_elements = 0.0, mass = 0.0, eigenvalues = 0.0, recover = 0.0, write = 0.0,
         total = 0.0;
};

struct ModalResult {
  /// Model (without contacts), mesh and super-elements, from which fields are recovered.
  Discretisation structure;
  std::vector<NaturalMode> modes;  ///< ascending frequency
  double total_mass = 0.0;         ///< of all elastic bodies
  std::vector<Warning> warnings;
  ModalTiming timing;
};

/// Throws InputError for models that cannot be analysed.
ModalResult solve_modal(model::Model model, const Options& options = {});

/// A mode as the state of all bodies, for result::Recovery.
FieldState state_of(const ModalResult& result, const NaturalMode& mode);

}  // namespace scabo::analysis
