// Unbounded bodies. In the plane their displacement under forces out of balance is relative: it grows with
// the logarithm of the distance and is known only up to a translation (element/stiffness.hpp, eqs. 5 and 6).
#pragma once

#include "scabo/analysis/increment.hpp"

namespace scabo::analysis {

/// Throws InputError for a reference point that does not lie in its body.
void check_references(const model::Model& model, const mesh::Mesh& mesh);

/// A sentence about the first outside body whose forces are out of balance although nothing says where it stands still;
/// empty where there is none.
std::string without_reference(const Prepared& prepared, const State& state);

/// Finds the displacement of the reference point of an outside body, where no support says where the bodies are: sets
/// IncrementResult::reference_displacement and takes it off the displacements of the pairs. The nodes keep theirs, from
/// which the fields follow: the stiffness of an outside body is that of one held far away, and resists a translation.
void refer_displacements(const Prepared& prepared, const StaticSolution& solution, IncrementResult& result);

}  // namespace scabo::analysis
