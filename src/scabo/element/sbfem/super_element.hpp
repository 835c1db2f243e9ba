// The solution of a super-element, bounded or unbounded, and the loads inside it: matrices and vectors of the scaled
// boundary equation alone, without coordinates.
//
// Loads inside are powers of xi:
//
//     q = E0 xi u,xi + E1' u - xi^j c,     xi q,xi = E1 xi u,xi + E2 u - xi^j g                              (1)
//
// Any power j > 0 is allowed, whether or not it is a whole number or an exponent of the super-element: see
// equivalent_load() in modal_solution.hpp.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::element {

/// Solution of one symmetry block (the whole super-element if there is no symmetry). Within a block, u = E v + R a: v
/// are the rows I, a the m translations of the block.
struct Block {
  Eigen::SparseMatrix<double> T;  // n x n_k: boundary displacement u = sum of T u_k over the blocks
  std::vector<int> I, J;          // rows of v, removed rows; |I| + |J| = n_k
  Matrix R;                       // n_k x m: the translations in this block, scaled so that R_J = 1
  Matrix E0;                      // n_k x n_k, with the translations
  Matrix S;                       // (n_k - m) x (n_k - m): xi v,xi = S v
  Matrix A;                       // m x (n_k - m): xi a,xi = A v                                          (3)
  Matrix V, C;                    // unbounded: (n_k - m) x m, m x m                                       (5)

  // Columns of displacements, u = E v + R a, so that v = Q u, a = u_J; of forces, the transposed of both.
  Matrix join(const Matrix& v, const Matrix& a) const;  ///< E v + R a
  Matrix v_of(const Matrix& u) const;                   ///< Q u = u_I - R_I u_J
  Matrix a_of(const Matrix& u) const { return u(J, Eigen::all); }
  Matrix on_v(const Matrix& f) const { return f(I, Eigen::all); }   ///< E'f
  Matrix on_a(const Matrix& f) const { return R.transpose() * f; }  ///< R'f
  Matrix from_v(const Matrix& f_v) const;                           ///< Q'f_v
};

/// The domain of a ring: inside it, or outside it to infinity.
struct Domain {
  bool unbounded = false;
  double far = 1e3;  ///< radius of the circle over the largest distance of the ring, > 1, eq. (6)
  bool operator==(const Domain&) const = default;
};

/// Stiffness of a super-element, and the data from which its interior is recovered.
struct SuperElementSolution {
  Matrix K;  // n x n, force / length per unit displacement of the boundary nodes; symmetric
  std::vector<Block> blocks;
  Domain domain;
  int doublings = 0;      ///< largest number over the blocks
  double residual = 0.0;  ///< of the Riccati equation, RiccatiResidual::size, largest over the blocks
  double rounding = 0.0;  ///< estimated error of an entry of K, over the root of the product of its diagonal entries
};

/// A load inside, eq. (1).
struct RadialLoad {
  double power = 0.0;  ///< j > 0
  Vector g;            // n, force
  Vector c;            // n, force; empty: 0
};

}  // namespace scabo::element
