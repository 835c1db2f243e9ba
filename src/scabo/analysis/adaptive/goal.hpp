// Error bars of single numbers, and refinement until the bar of one number is below a tolerance.
//
// A number J of the results is compared with J on richer meshes, contact included: the same elements with one order
// more (R1), elements of half the size with one order more (R2) and, unless the last two agree, elements of half the
// size with two orders more (R3). With R the last of them,
//
//     bar = 2 |R - J|,  and not less than the last change |R - R'| where that exceeds |R - J|                  (1)
//
// R2 is taken for the exact number up to a ratio r of the two errors, |R - J| = |1 - r| |J_exact - J|: at singular
// corners r is 0.2 to 0.35, elsewhere smaller, so that the bar is between 1.3 and 3 times the error. The last two
// agree if they differ by at most half of |R - J|; if they do not, J may be right by chance, and R3 decides.
//
// Meshes of half the size are made anew from the outline, so that arcs count. Finite elements become super-elements of
// the next orders. Cells of files and images keep their size; their orders are raised three times.
//
// Refinement for one number marks by the error of the displacement and of the dual problem (quantities.hpp, eq. 2):
// the share of a part is the product of the two in the energy norm (Mommer and Stevenson 2009), of the last
// increment. What is done with marked parts is as in adaptive.hpp; elements beside point forces are refined like
// others.
#pragma once

#include "scabo/analysis/adaptive/adaptive.hpp"

namespace scabo::analysis {

/// Whether any number gets an error bar.
bool wants_bars(const model::Model& model);

/// Throws InputError for numbers that the mesh does not have (quantities.hpp).
void check_bars(const model::Model& model, const mesh::Mesh& mesh);

/// solve_static() with the bars of the requested numbers in every increment, IncrementResult::quantities. With
/// Model::tolerance, on the first mesh on which the bar of the number in the last increment is as small as wanted; if
/// no mesh within the limits reaches it, the outcome is not_converged, with the results of the last mesh.
StaticSolution solve_with_bars(model::Model model, mesh::Mesh mesh, const Options& options,
                               const RefinementLimits& limits = {});

}  // namespace scabo::analysis
