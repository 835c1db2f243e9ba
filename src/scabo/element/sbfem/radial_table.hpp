// A radial field at many xi: interpolated in s = ln xi from values that are computed when first needed.
//
// The field is a sum of e^(lambda s), Re lambda >= 0, and powers of the loads. If exponents are at most l, the
// polynomial through 28 Chebyshev points on intervals of width h = 8 / l represents every term to rounding: for
// e^(lambda s) the error is below 2 (l h / 4)^28 / 28! = 2e-21 of its largest value there. At a distance |s| from the
// boundary, terms with lambda |s| > 40 have decayed, so that intervals may grow: h = max(8 / l, |s| / 5). A grid of
// 10,000 points then costs some hundred exponentials.
#pragma once

#include <vector>

#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

class RadialTable {
 public:
  /// Keeps a reference to the field. `fastest`: upper bound of the moduli of the exponents.
  RadialTable(const RadialField& field, double fastest);

  /// RadialField::at(xi), 0 <= xi <= 1. Not safe for several threads at once.
  RadialField::Values at(double xi) const;

 private:
  struct Interval {
    double from = 0.0, to = 0.0;                      // s, from < to <= 0
    mutable std::vector<RadialField::Values> values;  // at the Chebyshev points; empty until needed
  };
  const RadialField& field_;
  std::vector<Interval> intervals_;  // descending
};

/// The largest modulus of all exponents.
double fastest_of(const ModalSolution& modal);

}  // namespace scabo::element
