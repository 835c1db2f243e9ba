// Forces of a stiffness K that resists no translation, from differences of displacements between nodes:
//
//     f_i = sum_j K_ij (u_j - u_i)                                                                                  (1)
//
// Its rows add up to zero for every translation, so that this is K u; but the rounding of K u is that of the
// displacements, eps |K| |u|, and that of (1) is that of their differences over an element, eps |K| h |grad u|: in a
// mesh of a million degrees of freedom a hundredth to a thousandth of it, at the price of a product in working
// precision. The differences themselves are exact to their last digit, also of displacements with twice the digits.
#pragma once

#include "scabo/linalg/twofold.hpp"

namespace scabo::system {

struct ForcesByDifferences {
  Vector forces;          ///< (1), as large as u
  double rounding = 0.0;  ///< largest of eps sum_j |K_ij| |u_j - u_i|: what rounding may leave in one of them
};

/// `K`: symmetric, two rows a node, compressed. `u`: two components a node.
ForcesByDifferences forces_by_differences(const linalg::SparseMatrix& K, const linalg::TwofoldVector& u);

}  // namespace scabo::system
