// Resultants of stress over a line through bodies (model::Section).
//
//     force = t int sigma n ds,   moment = t int (x - x_0) x (sigma n) ds                        t: thickness
//
// The line is divided where it crosses sides of cells and rays from scaling centres to the ends of boundary elements:
// between them stress is smooth, and Gauss's rule is exact for polynomials of degree 15. What remains is the error of
// the stress itself: the sums balance the loads to the accuracy of the mesh, not to rounding.
#pragma once

#include <vector>

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/analysis/state/results.hpp"
#include "scabo/mesh/plane/output_points.hpp"

namespace scabo::result {

/// A point of the quadrature.
struct SectionPoint {
  mesh::OutputPoint at;
  Vec2 normal = Vec2::Zero();  ///< n
  Vec2 arm = Vec2::Zero();     ///< x - x_0
  double weight = 0.0;         ///< length times thickness
};

/// Points on a line, in the elastic bodies that it cuts or in one of them. Throws InputError if it cuts none, or if it
/// lies along the border of two bodies.
std::vector<SectionPoint> points_of_section(const analysis::Discretisation& discretisation,
                                            const model::HistoryItem& item, const model::Section& section);

}  // namespace scabo::result
