// Estimated error of an analysis, and refinement until it is below a tolerance.
//
// The model is solved on its mesh and once more with every boundary element raised by one order; the difference in the
// energy norm, body by body and increment by increment, is the estimate (element/two_orders.hpp). Relative errors are
// divided by the norm of the whole model's displacement.
//
// Refinement. With tau_b the tolerance of body b and eta_b its relative error, meshes follow each other until
//
//     sum of (eta_b / tau_b)^2 <= 0.7^2     over the bodies with a tolerance, in every increment             (1)
//
// (the estimate falls short of the error; where no mesh gets that far, 1 is good enough).
// In each pass the elements that hold the largest part of that sum are changed: raised by one order where their error
// fell as it does for smooth solutions, else divided, next to a corner of the outline in 0.15 : 0.85 with the small
// part at the corner, in the middle otherwise (Melenk and Wohlmuth 2001: an element carries the error predicted for
// it). Elements that face each other in a contact are changed alike.
//
// Stress under a point force is infinite, and so is its energy. The elements beside point forces, beside point supports
// that carry a reaction and beside `near` places keep their length and order in all meshes, the finer one of the
// estimate included: the force counts as spread over them. Before the first pass those at the corner of a force are
// divided once, 0.15 : 0.85.
#pragma once

#include "scabo/analysis/static_analysis.hpp"

namespace scabo::analysis {

/// Whether some body has a tolerance.
bool wants_refinement(const model::Model& model);

/// Throws InputError for contacts whose two sides cannot be refined alike.
void check_refinable(const model::Model& model, const mesh::Mesh& mesh);

/// solve_static() with the error of every increment estimated.
StaticSolution solve_with_error(model::Model model, mesh::Mesh mesh, const Options& options);

struct RefinementLimits {
  int dofs = 5000;  ///< in one body
  int passes = 40;
  int without_progress = 4;  ///< passes that together take less than a fifth off the sum of eq. (1)
};

/// solve_static() on the first mesh that meets eq. (1); its increments are reported when it is found. Where none does
/// within the limits, the outcome is not_converged, with the last mesh's results.
StaticSolution solve_refined(model::Model model, const Options& options, const RefinementLimits& limits = {});

/// The error of an increment: `increment` on the narrower mesh of `solution`, `wider` on the wider one.
ErrorEstimate estimate(const StaticSolution& solution, const IncrementResult& increment, const StaticSolution& wider,
                       const IncrementResult& wider_increment);

/// Errors of the boundary elements of a body whose error was estimated, relative as the body's; their squares sum to
/// its square.
std::vector<double> element_errors(const StaticSolution& solution, const IncrementResult& increment,
                                   const StaticSolution& wider, const IncrementResult& wider_increment,
                                   std::size_t body);

}  // namespace scabo::analysis
