// Static stiffness of a bounded super-element by ring doubling.
//
// Rings are doubled (ring_doubling.hpp, eqs. 1 and 2) after the translations have been taken out.
//
// The translations R (E1' R = 0, E2 R = 0) carry no force, R'q = 0, and are taken out first: with M = R'E0R,
// G = M^-1 R'E0, H = M^-1 R'E1' and u = R a + v, v = 0 in as many rows J as there are translations,
//
//     xi a,xi = -(G xi v,xi + H v)                                                                          (3)
//     E0 -> P'E0P,  E1 -> E1P,  E2 -> E2 - H'MH,   P = 1 - RG, without rows and columns J                   (4)
//
// and they are put back exactly: K of the rows J follows from K R = 0.
//
// Unbounded domain (outside the ring, xi >= 1): -K11 takes the place of K22, S has the exponents with negative real
// part. Loads on it need not be in equilibrium: their resultant, R'q = F for every xi, adds
//
//     v = v_h + V F,  V = -E2^-1 H',   xi a,xi = A v_h + C F,  C = M^-1 - H V                               (5)
//
// so that a grows with ln xi and the displacement is defined only up to a translation in proportion to F. The stiffness
// here is that of a domain whose translation vanishes at xi = far (for F = 0: at infinity, whatever far is),
//
//     a = A S^-1 v_h - C F ln(far)                                                                          (6)
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/element/coefficient_matrices.hpp"

namespace scabo::element {

/// What is known of one symmetry block (the whole super-element where there is no symmetry). Within a block,
/// u = E v + R a: v are the rows I, a the m translations of the block.
struct Block {
  Eigen::SparseMatrix<double> T;  // n x n_k: boundary displacement u = sum of T u_k over the blocks
  std::vector<int> I, J;          // rows of v, rows taken out; |I| + |J| = n_k
  Matrix R;                       // n_k x m: the translations in this block, scaled so that R_J = 1
  Matrix E0;                      // n_k x n_k, not deflated
  Matrix S;                       // (n_k - m) x (n_k - m): xi v,xi = S v
  Matrix A;                       // m x (n_k - m): xi a,xi = A v                                          (3)
  Matrix V, C;                    // unbounded: (n_k - m) x m, m x m                                       (5)
};

/// The domain that a ring belongs to: inside it, or outside to infinity.
struct Domain {
  bool unbounded = false;
  double far = 1e3;  ///< > 1, eq. (6)
  bool operator==(const Domain&) const = default;
};

/// Stiffness of a super-element and what its interior is recovered from.
struct SuperElementSolution {
  Matrix K;  // n x n, force / length per unit displacement of the boundary nodes; symmetric
  std::vector<Block> blocks;
  Domain domain;
  int doublings = 0;      ///< largest number over the blocks
  double residual = 0.0;  ///< of the Riccati equation, RiccatiResidual::size, largest over the blocks
  double rounding = 0.0;  ///< estimated error of an entry of K, over the root of the product of its diagonal entries
};

/// Solves the super-element. Throws IllPosed where the centre does not see the boundary, an elasticity is not positive
/// definite, or so many digits were lost that, to working precision, a ring is not, the Riccati residual stays above
/// 1e-9, K resists rotation or is not positive definite but for rigid motions. Symmetry blocks are shared out among
/// `threads` threads.
SuperElementSolution solve_super_element(const Ring& ring, const Elasticity& D, double thickness, int threads = 1,
                                         const Domain& domain = {});

}  // namespace scabo::element
