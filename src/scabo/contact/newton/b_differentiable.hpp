// The B-differentiable equations H(z) = 0 of a discrete contact problem, z = [p; a], and their directional derivative
// (Pang, Math. Oper. Res. 15 (1990) 311; Christensen, Klarbring, Pang, Stromberg, Int. J. Numer. Meth. Engng 42 (1998)
// 145). All components of H are forces: lengths enter as r u with r = 1 / W_ii; one r for both tangents of a pair.
//
//     H2 = min(r u_n, p_n + c_t)                                                             (Zhu 2017, eq. 7)
//     H3 = p_t - lambda p_t(r), p_t(r) = p_t - r u_t, lambda = min(b / |p_t(r)|, 1)          (eq. 8)
//     HR = G' p + f
//
// with the bound b = c + mu (p_n)+. In the plane p_t has one component, in space two; otherwise the equations are the
// same, and the plane is treated as space with a zero second component. lambda p_t(r) is the projection of p_t(r) onto
// the disc of radius b. With e = p_t(r) / |p_t(r)|, dg = r du_n, dt = dp_t - r du_t and db = mu dp_n, mu (dp_n)+ or 0
// for p_n >, =, < 0:
//
//     H2'  dg where r u_n < p_n + c_t, dp_n where >, min(dg, dp_n) at the tie
//     H3'  dp_t - dt                                    stick, |p_t(r)| < b
//          dp_t - dt + max(e'dt - db, 0) e              its edge, |p_t(r)| = b > 0
//          dp_t - db e - lambda (dt - (e'dt) e)         slip, |p_t(r)| > b
//          dp_t                                         free, b = 0 and p_n < 0 or mu = 0
//          dp_t - P_db(dt)                              tip of the cone, b = 0 and p_t(r) = 0: the law itself, again
//     HR'  G' dp
//
// In the plane mu may differ by direction (problem.hpp): it is then that of the sign of p_t(r), at the tip of the cone
// that of the sign of dt, where one of the two may be 0 (dp_t - dt, or dp_t). Where b = 0 on one side only, p_t(r) = 0
// lies on the edge of that side.
#pragma once

#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// The branch of a pair at a point, and the branch that is followed where several meet.
struct Branch {
  enum class Tangent { free, stick, slip };
  bool contact = false;  ///< the minimum is r u_n
  Tangent tangent = Tangent::free;
  bool normal_tie = false;    ///< both arguments of min are equal within rounding
  bool edge = false;          ///< |p_t(r)| = b > 0 within rounding, or p_t(r) = 0 and b = 0 on one side only
  bool tip = false;           ///< p_t(r) = 0 and b = 0
  bool bound_tie = false;     ///< p_n = 0, where b has two slopes
  double slope = 0.0;         ///< db / dp_n on the branch followed
  double lambda = 1.0;        ///< slip: b / |p_t(r)|
  Vec2 along = Vec2::Zero();  ///< slip, edge: e

  bool tied() const { return normal_tie || edge || tip || bound_tie; }
  bool same_branch(const Branch& other) const {
    return contact == other.contact && tangent == other.tangent && slope == other.slope &&
           (tangent != Tangent::slip || along == other.along);
  }
};

/// H and related quantities at one point; memory is reused from point to point.
struct Residual {
  Vector motion;                 // dN, u
  Vector along;                  // dN, change of u along the direction that was found last
  Vector H;                      // dN + m: [H2, H3] of every pair, HR
  std::vector<Branch> branches;  // N
  double merit() const { return 0.5 * H.squaredNorm(); }
  double largest() const { return H.size() > 0 ? H.lpNorm<Eigen::Infinity>() : 0.0; }
};

class BDifferentiableEquations {
 public:
  /// Keeps a reference to `problem`.
  BDifferentiableEquations(const Problem& problem, double r_factor);

  const Problem& problem() const { return problem_; }
  const Vector& r() const { return r_; }  // dN

  /// Puts pairs whose forces, bound and motions are all below `level` (a force) on the branch of pairs that are closed
  /// and stick, with H on it; those in `at` are the branches of their errors. Their number.
  int stick_below(double level, const Vector& p, Residual& at) const;

  void evaluate(const Vector& p, const Vector& a, Residual& at) const;
  Residual residual(const Vector& p, const Vector& a) const;
  /// The same for known motions (`at.motion`).
  void evaluate_at_motion(const Vector& p, Residual& at) const;

  /// Change of the motions along d = [dp; da]: W dp + G da.
  void motion_along(const Vector& d, Vector& change) const;

  /// H'(z; d), exact also at ties: it does not depend on the branches followed there.
  Vector derivative(const Residual& at, const Vector& d) const;

  /// At ties: follows the branches that d, with the motions `at.along`, takes from now on. The number that changes.
  int follow(Residual& at, const Vector& d) const;

  /// Coefficient of friction of pair `i` on the branch followed.
  double followed_mu(Eigen::Index i, const Branch& branch) const;

 private:
  const Problem& problem_;
  Vector r_;                // dN
  double largest_q_ = 0.0;  // as a force
};

}  // namespace scabo::contact
