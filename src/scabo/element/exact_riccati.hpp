// The last digits of K where the sectors of a super-element differ by orders of magnitude.
//
// The Riccati equation (riccati.hpp) is then solved to rounding of its largest terms only, and soft exponents make of
// that up to 1e-6 of the stiffness of the soft sectors. Here its residual is found with the 64-bit significands of long
// double, from coefficient matrices whose translations were taken out with as many; Newton's steps stay in double. What
// is left is what rounding the coefficient matrices themselves to double makes of K. It costs some 5 n^3 operations at
// a tenth of their usual speed, and two or three steps.
#pragma once

#include <vector>

#include "scabo/element/ring_doubling.hpp"

namespace scabo::element {

/// Elasticity::contrast() above which the digits are worth their price, and rows of a block up to which (500: about two
/// seconds).
inline constexpr double great_contrast = 1e3;
inline constexpr int most_exact_rows = 500;

/// E0, E1, E2, n x n, of a bounded domain, and its translations R (n x m) that are taken out of the rows J: I are those
/// left.
struct WithTranslations {
  const Matrix &E0, &E1, &E2, &R;
  const std::vector<int>& I;
};

/// Corrects K and S of `ring`. Throws IllPosed when E0 is not positive definite.
void correct_last_digits(const WithTranslations& of, RingStiffness& ring);

}  // namespace scabo::element
