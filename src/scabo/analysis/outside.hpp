// Bodies that reach to infinity. In the plane their displacement under forces out of balance is relative: it grows with
// the logarithm of the distance and is known only up to a translation (element/stiffness.hpp, eqs. 5 and 6).
#pragma once

#include "scabo/analysis/increment.hpp"

namespace scabo::analysis {

/// Throws InputError for a reference point that does not lie in its body.
void check_references(const model::Model& model, const mesh::Mesh& mesh);

/// A sentence about the first outside body whose forces are out of balance although nothing says where it stands still;
/// empty where there is none.
std::string without_reference(const Prepared& prepared, const State& state);

/// Takes the displacement of the reference point of an outside body off all bodies, where no support says where they
/// are.
void refer_displacements(const StaticSolution& solution, IncrementResult& result);

}  // namespace scabo::analysis
