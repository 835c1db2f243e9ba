// Interior points condensed to the boundary: the rows that map boundary displacements to displacement and strain at a
// point.
//
//     displacement = N u,   strain = B u,   u: displacements of the boundary nodes                            (1)
//
// N is 2 x n, B is 3 x n. In every symmetry block (stiffness.hpp; v = u_I - R_I u_J, a = u_J), with X = xi^(S - 1),
//
//     u(xi) = E xi X v + R (a + A S^-1 (xi X - 1) v),   u,xi = (E S + R A) X v,   u_part = (E + R A S^-1) X v  (2)
//
// A row r' of shape functions or strain matrices, transformed to the block (r_v: its rows I; r_a = R' r), therefore
// needs the product of X' with a few vectors: the same exponential, of the transposed matrix, by the Schur form of S'.
// Each point costs five of these products once, and then 5 n multiplications for every load case. N and B do not
// include the effect of loads inside the super-element: it is the field of those loads with u = 0 (RadialField).
//
// For bounded super-elements. Where exponents below 1 make strains infinite, B does not exist at xi = 0.
#pragma once

#include <vector>

#include "scabo/element/plane/interior_field.hpp"

namespace scabo::element {

struct PointOperator {
  Eigen::Matrix<double, 2, Eigen::Dynamic> N;  // 2 x n
  Eigen::Matrix<double, 3, Eigen::Dynamic> B;  // 3 x n, strain [xx, yy, gamma_xy]
};

class PointCondensation {
 public:
  /// Keeps references to both.
  PointCondensation(const Ring& ring, const SuperElementSolution& solution);

  PointOperator at(const ScaledPoint& point) const;
  /// The same for many points, distributed over `threads` threads.
  std::vector<PointOperator> at(const std::vector<ScaledPoint>& points, int threads) const;

 private:
  struct Adjoint {
    linalg::SchurExponential modes;  // of S'
    double slowest = 1.0;            // lower bound of the exponents of the block
    Matrix A_over_S;                 // A S^-1, m x (n_k - m)
  };
  const Ring& ring_;
  const SuperElementSolution& solution_;
  std::vector<Adjoint> adjoints_;  // one for each block
};

}  // namespace scabo::element
