// The textbook solution of a bounded super-element, as an oracle: eigenvectors of the 2n x 2n matrix
//
//     Z = [[-E0^-1 E1', E0^-1], [E2 - E1 E0^-1 E1', E1 E0^-1]],   xi X,xi = Z X,   X = [u; q]
//
// of which the n - 2 of largest real part are taken and the two translations put in: K = Phi_q Phi_u^-1
// (Song, The Scaled Boundary Finite Element Method, 2018, section 3.2). It loses its digits as n grows: only
// for small n.
#pragma once

#include <complex>
#include <vector>

#include "scabo/element/facet/coefficient_matrices.hpp"

namespace scabo::test {

struct TextbookSolution {
  Matrix K;                                     // n x n
  std::vector<std::complex<double>> exponents;  // n, ascending real part
};

TextbookSolution textbook_route(const element::CoefficientMatrices& matrices);

}  // namespace scabo::test
