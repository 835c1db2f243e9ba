// The B-differentiable equations H(z) = 0 of a discrete contact problem, z = [p; a], and the damped Newton method on
// them (Pang, Math. Oper. Res. 15 (1990) 311; Christensen, Klarbring, Pang, Stromberg, Int. J. Numer. Meth. Engng 42
// (1998) 145). All components of H are forces: lengths enter as r g and r ds with r = 1 / W_ii.
//
//     H2 = min(r g, p_n)                                                          (Zhu 2017, eq. 7)
//     H3 = p_t - lambda p_t(r), p_t(r) = p_t - r ds, lambda = min(mu (p_n)+ / |p_t(r)|, 1)   (eq. 8)
//     HR = G' p + f
//
// The direction d solves H(z) + H'(z; d) = 0 on the branch on which z lies, a linear system; a line search on
// theta = 1/2 |H|^2 damps it. At a tie of branches the other branch is taken when the first gives no descent; where
// neither does, a few full steps are tried and the best point is kept.
#pragma once

#include <optional>
#include <vector>

#include "scabo/contact/solution.hpp"

namespace scabo::contact {

/// Branch of the normal and of the tangential equation of one pair.
struct Branch {
  bool contact = false;  ///< min taken by r g
  enum class Tangent { free, stick, slip } tangent = Tangent::free;  ///< lambda = 0, = 1, between
  double sign = 0.0;     ///< slip: sign of p_t(r)
  bool normal_tie = false, tangent_tie = false;
  bool operator==(const Branch& other) const {
    return contact == other.contact && tangent == other.tangent && sign == other.sign;
  }
};

struct Residual {
  Vector H;  // 2N + m: [H2, H3] of every pair, HR
  std::vector<Branch> branches;
  double merit() const { return 0.5 * H.squaredNorm(); }
};

struct NewtonEnd {
  Vector p, a;  ///< the best point
  bool converged = false;
  bool singular = false;  ///< a direction did not exist: forces cannot balance on the branch
  int iterations = 0;
  double residual = 0.0;  ///< largest |H|
  std::vector<Iteration> trace;
};

class BDifferentiableEquations {
 public:
  /// Keeps a reference to `problem`.
  BDifferentiableEquations(const Problem& problem, double r_factor);

  Residual residual(const Vector& p, const Vector& a) const;

  /// d = [dp; da] with H + H'(z; d) = 0 on the branches of `at`; nothing when there is none.
  std::optional<Vector> direction(const Residual& at) const;

  /// Damped Newton from (p, a) until the largest |H| is below `small`.
  NewtonEnd newton(Vector p, Vector a, double small, int iterations) const;

 private:
  /// `at` with the other branch wherever two meet.
  Residual other_branch(const Residual& at) const;
  bool line_search(const Vector& d, Vector& p, Vector& a, Residual& at) const;

  const Problem& problem_;
  Vector r_;  // 2N
};

}  // namespace scabo::contact
