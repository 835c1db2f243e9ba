// Unbounded bodies. In the plane, their displacement under forces with a nonzero resultant grows with the logarithm of
// the distance and is determined only up to a translation (element/plane/stiffness.hpp, eqs. 5 and 6).
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Throws InputError for a reference point that does not lie in its body.
void check_references(const model::Model& model, const mesh::Mesh& mesh);

/// A sentence about the first unbounded body whose forces have a nonzero resultant although it has no reference point;
/// empty if there is none.
std::string without_reference(const Prepared& prepared, const State& state);

/// The reference points of unbounded bodies that no support and no spring holds, nor any body that contacts and ties
/// join to them. Of several that are joined, the first in the model counts.
std::vector<Reference> references_of(const model::Model& model, const mesh::Mesh& mesh,
                                     const std::vector<element::SolvedCells>& cells, const system::Dofs& dofs);

/// Sets FieldState::reference_displacements and subtracts them from the displacements of the pairs. The nodal
/// displacements, from which fields are recovered, are not changed. Of a body that was put in place later (stages.hpp)
/// what the point had moved before is none of its own.
void refer_displacements(const Prepared& prepared, const State& state, IncrementResult& result);

}  // namespace scabo::analysis
