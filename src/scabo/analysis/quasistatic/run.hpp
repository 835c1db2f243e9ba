// A static analysis on one mesh.
#pragma once

#include "scabo/analysis/march/options.hpp"

namespace scabo::analysis {

/// All steps of a valid model on its mesh, once: without refinement or error estimate.
StaticSolution solve_on_mesh(model::Model model, mesh::Mesh mesh, const Options& options);

}  // namespace scabo::analysis
