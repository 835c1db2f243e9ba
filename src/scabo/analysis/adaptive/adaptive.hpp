// Estimated error of an analysis, and refinement until it is below a tolerance.
//
// The model is solved on its mesh and again with every boundary element raised by one order. The difference in the
// energy norm, for every body and increment, is the estimate (element/plane/two_orders.hpp). Relative errors are
// divided by the norm of the displacement of the whole model.
//
// Refinement. With tau_b the tolerance of body b and eta_b its relative error, meshes are refined until
//
//     sum of (eta_b / tau_b)^2 <= 0.7^2     over the bodies with a tolerance, in every increment             (1)
//
// (the estimate is smaller than the error; if no mesh reaches this bound, 1 is accepted). Of every mesh the parts with
// the largest share of that sum are marked and refined (refinement_loop.hpp, refinement.hpp):
//  - Elements of a body that is one super-element are raised by one order if their error decreased as for smooth
//    solutions; otherwise they are divided: next to a corner of the outline in the ratio 0.15 : 0.85 with the small
//    part at the corner, elsewhere in the middle (Melenk and Wohlmuth 2001: every element carries a predicted error).
//    Elements of two such bodies that face each other in a contact are changed alike.
//  - Cells of polygon and quadtree meshes get smaller; their order stays. The sides of their contacts, and of those
//    between a body with and one without a tolerance, are matched in every mesh (mesh/plane/match.hpp).
//
// Stress under a point force is infinite, and so is its energy. Of a body of one super-element, elements beside point
// forces, beside point supports with a reaction and beside `near` places keep their length and order in all meshes,
// including the finer one of the estimate: the force is treated as distributed over them. Before the first pass,
// elements at a corner with a force are divided once, in the ratio 0.15 : 0.85. Of a body of many cells, cells with
// such a place are left out of the estimate and of the refinement, with those within 0.15 of the size of the first
// mesh; cells at a force have this size from the beginning.
#pragma once

#include "scabo/analysis/adaptive/refinement_loop.hpp"

namespace scabo::analysis {

/// Whether any body has a tolerance.
bool wants_refinement(const model::Model& model);

/// Throws InputError for contacts whose two sides cannot be refined alike.
void check_refinable(const model::Model& model, const mesh::Mesh& mesh);

/// solve_static() with the error of every increment estimated.
StaticSolution solve_with_error(model::Model model, mesh::Mesh mesh, const Options& options);

/// solve_static() on the first mesh that satisfies eq. (1); its increments are reported when it is found. If no mesh
/// within the limits does, the outcome is not_converged, with the results of the last mesh.
StaticSolution solve_refined(model::Model model, const Options& options, const RefinementLimits& limits = {});

// Steps that goal.hpp shares.

/// The analysis with `options` on the mesh of a solution with boundary elements one order higher, except the frozen
/// ones (frozen_elements.hpp); nothing, with the reason in `why`, if that has no solution.
std::optional<StaticSolution> solve_wider(const StaticSolution& solution, bool frozen_at_singular_places,
                                          const Options& options, std::string& why);
/// Replaces `near` places by the position of their nodes on this mesh, so that they refer to the same point on the next
/// mesh.
void hold_near_places(model::Model& model, const mesh::Mesh& mesh);
/// Options for a solve that reports nothing but its stages, as `what: stage`.
Options quiet(const Options& options, const std::string& what);
/// Reports a complete solution as if its increments were computed one by one.
void replay(StaticSolution& solution, const Options& options);

}  // namespace scabo::analysis
