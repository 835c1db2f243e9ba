// The last digits of K where the sectors of a super-element differ by orders of magnitude, or it is slender.
//
// The Riccati equation (riccati.hpp) is solved to rounding of its largest terms only. Soft exponents make of that up to
// 1e-6 of the stiffness of soft sectors, and a slender body bends with (h / L)^3 of its largest terms. Here coefficient
// matrices, translations and residual are found with the 64-bit significands of long double; Newton's steps stay in
// double. It costs some 5 n^3 operations at a tenth of their usual speed, and two or three steps.
#pragma once

#include <vector>

#include "scabo/element/plane/stiffness.hpp"
#include "scabo/element/sbfem/ring_doubling.hpp"

namespace scabo::element {

/// Elasticity::contrast() and slenderness above which the digits are worth their price, and rows of a block up to which
/// (500: about two seconds).
inline constexpr double great_contrast = 1e3;
inline constexpr double great_slenderness = 50;  // largest distance of the boundary from the centre over the smallest
inline constexpr Eigen::Index most_exact_rows = 500, most_slender_rows = 1250;

/// Rows of a block up to which a bounded domain gets its last digits without being asked, 0 of most rings. `contrast`:
/// Elasticity::contrast().
Eigen::Index rows_with_last_digits(const Ring& ring, double contrast);

/// Corrects K and S of a block of a bounded domain, whose T, I, J are known. Returns the stiffness of the whole block,
/// the rows J of the translations included. Throws IllPosed when E0 is not positive definite.
Matrix correct_last_digits(const Ring& boundary, const Elasticity& D, double thickness, const Block& block,
                           RingStiffness& ring);

}  // namespace scabo::element
