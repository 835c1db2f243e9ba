// Identical super-elements share one solution.
#pragma once

#include "scabo/analysis/static_analysis.hpp"

namespace scabo::analysis {

/// Solves the super-elements of all bodies, each distinct one once, on up to `threads` threads. Two are identical if
/// their boundaries relative to the scaling centre, their elasticity and their thickness agree.
std::vector<std::shared_ptr<const SolvedSuperElement>> solve_super_elements(const model::Model& model,
                                                                            const mesh::Mesh& mesh, int threads);

}  // namespace scabo::analysis
