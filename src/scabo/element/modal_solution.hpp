// The interior of a super-element: u(xi) = xi^S u(1), by the n x n real Schur form.
//
// xi u,xi = S u with S = E0^-1 (K - E1') is half the size of the usual problem in [u; q]. It is used in its real Schur
// form, so that repeated, defective and ill-conditioned exponents do no harm. In each symmetry block, with v = U psi
// and S = U T U' (stiffness.hpp for v, a, A, R):
//
//     xi psi,xi = T psi - xi^2 w                        w: the body force, 0 without                        (1)
//     u = R (a0 + xi^2 b) + Phi psi                     Phi = U + R A U T^-1                                (2)
//     xi u,xi = Phi (T psi - xi^2 w) + 2 xi^2 R b                                                           (3)
//
// Body force: the inner domain of size xi is in equilibrium, q = K u - xi^2 h, with the equivalent nodal load
//     h = int_0^1 xi (xi^S)' F_b dxi = (S' + 2)^-1 F_b                                                      (4)
// (reciprocity), so xi u,xi = S u - xi^2 E0^-1 h. S' + 2 is never singular: no resonance has to be handled.
#pragma once

#include <complex>
#include <vector>

#include "scabo/element/stiffness.hpp"
#include "scabo/linalg/schur_exponential.hpp"

namespace scabo::element {

struct ModalBlock {
  linalg::SchurExponential modes;  // of S, (n_k - m) x (n_k - m)
  Matrix Phi;                      // n_k x (n_k - m), in the coordinates of the symmetry block
};

struct ModalSolution {
  std::vector<ModalBlock> blocks;                  ///< one for each of SuperElementSolution::blocks
  std::vector<std::complex<double>> exponents;     ///< all n, ascending real part; the two translations are 0 exactly
};

/// Symmetry blocks are shared out among `threads` threads.
ModalSolution modal_solution(const SuperElementSolution& solution, int threads = 1);

/// h of eq. (4): nodal forces equivalent to a body force; `F_b` = int N' b |J| deta times thickness (n).
Vector equivalent_body_load(const SuperElementSolution& solution, const Vector& F_b);

/// Boundary displacements, taken apart into modes, with the part that a body force adds inside.
class RadialField {
 public:
  /// `u`: boundary displacements (n); `F_b` as above, empty for none. Keeps references to both solutions.
  RadialField(const SuperElementSolution& solution, const ModalSolution& modal, const Vector& u, const Vector& F_b);

  struct Values {
    Vector u;      ///< displacement of the ring at xi (n)
    Vector u_xi;   ///< u,xi
    Vector u_part; ///< (u - R a) / xi, what the circumferential part of the strain needs: B2 R = 0
  };
  /// 0 <= xi <= 1; at the centre, the limit.
  Values at(double xi) const;

 private:
  struct Part {
    Vector c;       // modal coordinates at xi = 1
    Vector w;       // eq. (1)
    Vector a0, b;   // eq. (2)
  };
  const SuperElementSolution& solution_;
  const ModalSolution& modal_;
  std::vector<Part> parts_;
};

}  // namespace scabo::element
