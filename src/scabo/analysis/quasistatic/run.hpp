// A static analysis on one mesh.
#pragma once

#include <functional>

#include "scabo/analysis/march/options.hpp"
#include "scabo/analysis/quasistatic/scheme.hpp"

namespace scabo::analysis {

/// Goes through the steps of a solution, whose systems the scheme has.
using GoThrough = std::function<void(Quasistatic& scheme, StaticSolution& solution, const Options& options)>;

/// All steps of a valid model on its mesh, once: without refinement or error estimate. `go_through`: empty for steps
/// that are all quasi-static.
StaticSolution solve_on_mesh(model::Model model, mesh::Mesh mesh, const Options& options,
                             const GoThrough& go_through = {});

}  // namespace scabo::analysis
