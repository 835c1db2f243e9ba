// The exponents of the super-elements of a model: u ~ xi^lambda, where xi is the distance from the scaling centre.
//
// Bounded: 0 for the two translations, 1 for the rotation and for linear displacements; with an exponent below 1,
// stress is infinite at the scaling centre (open super-elements: cracks, notches, corners). Unbounded: negative real
// parts, and 0.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "scabo/model/model.hpp"

namespace scabo::element {

struct Exponent {
  std::complex<double> value;  ///< imaginary part >= 0: a complex pair is one entry
  int multiplicity = 1;        ///< number of equal exponents (to 1e-6); complex pair: of each
  bool singular = false;       ///< 0 < real part < 1
  bool defective = false;      ///< fewer modes than exponents: power-logarithmic, with a factor ln xi
  std::string meaning;         ///< `translations`, `rotation` ..., or empty
};

struct BodyExponents {
  int body = -1;     ///< index into Model::bodies
  std::string kind;  ///< `closed`, `open` (with side faces), `open, held` (supports hold a side face) or `outside`
  int dofs = 0;
  std::vector<Exponent> exponents;  ///< ascending real part
};

/// Meshes the model and solves its super-elements. Bodies without super-elements (rigid, finite elements) are left out.
std::vector<BodyExponents> exponents_of(const model::Model& model);

}  // namespace scabo::element
