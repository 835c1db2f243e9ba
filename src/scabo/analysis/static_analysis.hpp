// The analysis of a model with its steps: Model -> Mesh -> super-elements -> systems -> contact -> results of every
// increment, on one mesh or on several. Results are written elsewhere (result/); what runs go on from, in state/.
#pragma once

#include "scabo/analysis/march/options.hpp"

namespace scabo::analysis {

/// Validates the model (model/validate.hpp), meshes it and checks, without solving anything, that every body is held
/// (not required for a modal analysis) and that every output point lies in a body. Throws InputError.
mesh::Mesh check(const model::Model& model);

/// Whether large bodies can be divided among ranks (Options::ranks); otherwise `why_no_ranks` says why not.
bool can_use_ranks(const model::Model& model);
inline constexpr const char* why_no_ranks =
    "modal analyses, steps in time, cracks that grow, bodies of revolution and analyses on several meshes (error bars, "
    "`tolerance`, `error`) are not divided among ranks";

/// Runs all steps. Throws InputError for models that cannot be analysed; an increment that does not converge is part of
/// the result.
StaticSolution solve_static(model::Model model, const Options& options = {});

}  // namespace scabo::analysis
