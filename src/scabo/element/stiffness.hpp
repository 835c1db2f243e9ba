// Static stiffness of a bounded super-element by ring doubling.
//
// Rings are doubled (ring_doubling.hpp, eqs. 1 and 2) after the translations have been removed.
//
// The translations R (E1' R = 0, E2 R = 0) carry no force, R'q = 0, and are removed first. With M = R'E0R, G = M^-1
// R'E0, H = M^-1 R'E1' and u = R a + v, where v = 0 in as many rows J as there are translations,
//
//     xi a,xi = -(G xi v,xi + H v)                                                                          (3)
//     E0 -> P'E0P,  E1 -> E1P,  E2 -> E2 - H'MH,   P = 1 - RG, without rows and columns J                   (4)
//
// They are restored exactly: the rows J of K follow from K R = 0.
//
// Unbounded domain (outside the ring, xi >= 1): -K11 replaces K22, and S has the exponents with negative real part.
// Loads on it need not be in equilibrium: their resultant, R'q = F for every xi, adds
//
//     v = v_h + V F,  V = -E2^-1 H',   xi a,xi = A v_h + C F,  C = M^-1 - H V                               (5)
//
// so that a grows with ln xi and the displacement is defined only up to a translation proportional to F. The stiffness
// computed here is that of a domain whose mean displacement over a circle around the scaling centre vanishes (for F =
// 0: at infinity, for any circle). Its radius is far times the largest distance of the ring from the centre. A bar is
// the mean over the angle, r the distance of the ring over the largest one:
//
//     a = A S^-1 v_h - (C (ln(far) - bar(ln r)) + N) F,
//     sym N = sym bar(V),  skew N = -skew V'(E1'V + G_I')                                                  (6)
//
// V depends on the rows J, as a does; with bar(V), (6) does not. The skew part of N is the one for which Betti's
// theorem holds, so that K is symmetric; where a line of symmetry makes the mean fulfil it, it is that of bar(V).
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "scabo/element/coefficient_matrices.hpp"

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

/// Solves the super-element. Throws IllPosed if the boundary is not entirely visible from the centre, an elasticity is
/// not positive definite, or too much precision is lost: a ring is not positive definite to working precision, the
/// Riccati residual remains above 1e-9, K resists rotation, or K is not positive definite apart from rigid motions.
/// Symmetry blocks are distributed over `threads` threads.
SuperElementSolution solve_super_element(const Ring& ring, const Elasticity& D, double thickness, int threads = 1,
                                         const Domain& domain = {});

/// Imposes K r = 0 for the rotation r, which is known exactly and which short elements beside long ones violate,
///
///     K <- (1 - w r') K (1 - r w'),  w = D r / (r'D r),  D = diag K,  t'D r = 0 for the translations t          (7)
///
/// so that every row is changed in proportion to its own size (with D = 1 the residual of stiff sectors would be moved
/// to a soft one: 1e-8 of its stiffness where moduli differ by 1e6) and K t = 0 is preserved. `K`: of a bounded
/// super-element (n x n); its lower triangle is read, both are written. Throws IllPosed if K violates K r = 0 by 1e-8:
/// accuracy has been lost.
void take_rotation_out(const Ring& ring, Matrix& K);

}  // namespace scabo::element
