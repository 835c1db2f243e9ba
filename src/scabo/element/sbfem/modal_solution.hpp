// Solution in the interior of a super-element: u(xi) = xi^S u(1), by the n x n real Schur form.
//
// xi u,xi = S u with S = E0^-1 (K - E1') is half the size of the usual eigenvalue problem in [u; q]. It is used in its
// real Schur form, so that repeated, defective and ill-conditioned exponents cause no difficulty. In each symmetry
// block, with v = U psi and S = U T U' (super_element.hpp for v, a, A, R):
//
//     xi psi,xi = T psi + sum of xi^j w                  w: loads inside                                    (1)
//     u = R (a0 + sum of xi^j b) + Phi psi               Phi = U + R A U T^-1                               (2)
//     xi u,xi = Phi (T psi + sum of xi^j w) + R sum of j xi^j b                                             (3)
//
// Loads (super_element.hpp). The domain of size xi is in equilibrium, q = K u - xi^j h, with the equivalent nodal load
// h,
//     (S' + j) h = S' c + g                                                                                 (4)
// (reciprocity; without c, h = int_0^1 xi^(j-1) (xi^S)' g dxi), so xi u,xi = S u + xi^j E0^-1 (c - h). S' + j is never
// singular, and a power that is an exponent makes a Jordan block of the system (1): no resonance has to be handled.
//
// Unbounded domain: exponents have negative real parts, xi >= 1, and u contains R C F ln xi + V F as in
// plane/stiffness.hpp, eq. (5).
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "scabo/element/sbfem/super_element.hpp"
#include "scabo/linalg/schur_exponential.hpp"

namespace scabo::element {

struct ModalBlock {
  linalg::SchurExponential modes;  // of S, (n_k - m) x (n_k - m)
  Matrix Phi;                      // n_k x (n_k - m), in the coordinates of the symmetry block
};

struct ModalSolution {
  std::vector<ModalBlock> blocks;               ///< one for each of SuperElementSolution::blocks
  std::vector<std::complex<double>> exponents;  ///< all n, in ascending real part; exactly 0 for the two translations
  /// Power of xi with which the slowest mode decays towards the scaling centre, slightly less if it oscillates; at most
  /// 1. Below 1, strains are infinite at the scaling centre. (Unbounded domain: power of 1/xi.)
  double slowest = 1.0;
};

/// Modes of the internal level of a super-element (internal_level.hpp).
struct InternalModes {
  struct Group {
    Eigen::SparseMatrix<double> T;  ///< n x n_k
    Matrix R;                       ///< n_k x m
    ModalBlock modal;
    Matrix start;  ///< their coordinates at xi = 1 by T'w
    Matrix still;  ///< m x n_k: translation of the whole inside by T'w
  };
  std::vector<Group> groups;
};

/// What the inside of a super-element moves besides following its boundary: - phi(xi) w.
struct InternalMotion {
  std::shared_ptr<const InternalModes> modes;  ///< null: nothing
  Vector w;
  Vector velocity = {};  ///< of w; empty: not in time
};

/// Symmetry blocks are distributed over `threads` threads.
ModalSolution modal_solution(const SuperElementSolution& solution, int threads = 1);

/// h of eq. (4) for all loads together: the equivalent nodal forces (n).
Vector equivalent_load(const SuperElementSolution& solution, const std::vector<RadialLoad>& loads);

/// Work of the loads `one` on the motion that the loads `other` cause inside while the boundary is held (symmetric):
/// sum_ij (h_i - c_i)' E0^-1 (h_j - c_j) / (i + j).
double work_inside(const SuperElementSolution& solution, const std::vector<RadialLoad>& one,
                   const std::vector<RadialLoad>& other);

/// Interior field of given boundary displacements, decomposed into modes, including the part caused by loads inside.
class RadialField {
 public:
  /// `u`: boundary displacements (n) under `loads`. Keeps references to both solutions.
  RadialField(const SuperElementSolution& solution, const ModalSolution& modal, const Vector& u,
              const std::vector<RadialLoad>& loads = {}, const InternalMotion& inside = {});

  struct Values {
    Vector u;       ///< displacement of the ring at xi (n)
    Vector u_xi;    ///< u,xi
    Vector u_part;  ///< (u - R a) / xi, for the circumferential part of the strain: B2 R = 0
  };
  /// 0 <= xi <= 1. At the centre the values are limits, and infinite values are not a number. Unbounded domain: xi >=
  /// 1.
  Values at(double xi) const;
  std::vector<Values> at(const std::vector<double>& xis) const;  ///< cheaper than one by one

 private:
  Values centre() const;
  struct Translation {
    double power = 0.0;
    Vector b;  // eq. (2)
  };
  struct Part {
    const Eigen::SparseMatrix<double>* T = nullptr;
    const Matrix* R = nullptr;
    const ModalBlock* modal = nullptr;
    Vector c;                               // modal coordinates at xi = 1
    std::vector<linalg::Forcing> w;         // eq. (1)
    Vector a0;                              // eq. (2)
    std::vector<Translation> translations;  // eq. (2)
    Vector constant, growth;                // unbounded: V F, C F
  };
  /// Phi psi and its derivative times xi, both over xi^shift, of a block at s = ln xi.
  void add(std::size_t block, const Vector& moving, const Vector& slope, double xi, double s, double shift,
           Values& values) const;
  void set_loads(const Block& block, const ModalBlock& modes, const std::vector<RadialLoad>& loads, Part& part) const;
  const SuperElementSolution& solution_;
  std::shared_ptr<const InternalModes> inside_;
  std::vector<Part> parts_;  // one for each block, then for each group of the inside
  double slowest_ = 1.0;     // of modes and loads
};

}  // namespace scabo::element
