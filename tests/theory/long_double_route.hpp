// The stiffness of a bounded super-element in 64-bit significands (long double), as an oracle for what double loses:
// the coefficient matrices integrated anew, the translations taken out, one ring doubled until nothing couples. Plain
// and slow.
#pragma once

#include "scabo/element/facet/coefficient_matrices.hpp"

namespace scabo::test::oracle {

using Real = long double;
using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

struct Coefficients {
  Dense E0, E1, E2;
};

Coefficients coefficients(const element::Ring& ring, const element::Elasticity& elasticity, double thickness);

/// K, n x n.
Dense stiffness(const Coefficients& of);
Dense stiffness(const element::Ring& ring, const element::Elasticity& D, double thickness);

}  // namespace scabo::test::oracle
