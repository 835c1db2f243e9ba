// Gauss-Lobatto-Legendre basis: the polynomials of a boundary element of order p.
//
// Points eta_0 = -1 < ... < eta_p = 1 are the ends and the zeros of P_p', the derivative of Legendre's polynomial.
// Quadrature at these points is exact up to degree 2 p - 1.
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh {

struct LobattoBasis {
  explicit LobattoBasis(int order);

  std::vector<double> points;   ///< p + 1, ascending
  std::vector<double> weights;  ///< p + 1, sum 2
  Matrix derivative;            ///< (p + 1) x (p + 1): derivative(i, j) = N_j,eta at points[i]

  /// Shape functions at other points: at.size() x (p + 1), row k holds N_j(at[k]).
  Matrix shape_at(const std::vector<double>& at) const;
};

}  // namespace scabo::mesh
