// Pressure of a fluid in contacts (model::PorePressure): forces p w t n on B and -p w t n on A of every pair, open or
// closed, with the pressure p at the pair, its tributary length w (tributary_lengths.hpp), the thickness t and its normal
// n out of A. What the pairs carry besides is their effective force; the total one is the sum of both.
//
// On elements of order 2 or more, p w are the consistent nodal forces of a pressure that is linear along them.
#pragma once

#include "scabo/mesh/mesh.hpp"

namespace scabo::system {

/// The pressure at a point, at factor 1.
double pressure_at(const model::PorePressure& pores, const Vec2& x);

/// Forces p w t of the pairs of a contact, one for each pair of its interface, at factor 1.
Vector pore_forces(const model::PorePressure& pores, int contact, const model::Model& model, const mesh::Mesh& mesh);

}  // namespace scabo::system
