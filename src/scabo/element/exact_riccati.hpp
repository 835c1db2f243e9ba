// Improved accuracy of K where the sectors of a super-element differ in stiffness by orders of magnitude.
//
// In that case the Riccati equation (riccati.hpp) is solved only to rounding of its largest terms, which soft exponents
// amplify to errors of up to 1e-6 of the stiffness of the soft sectors. Here its residual is computed with the 64-bit
// significands of long double, from coefficient matrices whose translations were removed with the same precision;
// Newton's steps stay in double. The remaining error is that of rounding the coefficient matrices themselves to double.
// The cost is some 5 n^3 operations at a tenth of their usual speed, and two or three steps.
#pragma once

#include <vector>

#include "scabo/element/ring_doubling.hpp"

namespace scabo::element {

/// Elasticity::contrast() above which the correction is made, and the largest number of rows of a block for which it is
/// made (500: about two seconds).
inline constexpr double great_contrast = 1e3;
inline constexpr int most_exact_rows = 500;

/// E0, E1, E2 (n x n) of a bounded domain, and its translations R (n x m), which are removed from the rows J; I are the
/// remaining rows.
struct WithTranslations {
  const Matrix &E0, &E1, &E2, &R;
  const std::vector<int>& I;
};

/// Corrects K and S of `ring`. Throws IllPosed if E0 is not positive definite.
void correct_last_digits(const WithTranslations& of, RingStiffness& ring);

}  // namespace scabo::element
