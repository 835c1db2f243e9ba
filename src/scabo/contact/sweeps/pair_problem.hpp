// The problem of one pair: its force under Coulomb's law with cohesion and tensile strength, with all other forces
// fixed. Sweeps (gauss_seidel.hpp) solve it pair by pair.
//
// Its motion is free + W p, W its own block. The pair is open, p_n = -T, |p_t| <= C, if that gives u_n >= 0. Otherwise
// u_n = 0, and with the normal force eliminated u_t = A p_t + c,
//
//     A = W_tt - W_tn W_nt / W_nn,   c = free_t - W_tn free_n / W_nn
//
// Stick is p_t = -A^-1 c within the bound C + mu (p_n)+. In the plane slip has a closed form. In space it is u_t = -s
// p_t, s > 0, hence (A + s) p_t = -c; with N(s) = det(A + s) p_t
//
//     g(s) = |N| + mu / W_nn (free_n det(A + s) + W_nt N) - C det(A + s) = 0
//
// a quartic in s in another form, solved by Newton's method within a bracket from the previous s: one or two steps near
// the end of the sweeps. If p_n < 0 results, the bound is C alone, and mu = 0 in g. If no force satisfies the law
// (large mu, W not positive definite), p_n = -free_n / W_nn without friction.
#pragma once

#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

template <int d>
class PairProblem {
 public:
  /// Coefficients of friction: against forward slip (p_t < 0) and backward slip (p_t > 0); equal with d = 3.
  struct Friction {
    double forward = 0.0, backward = 0.0;
    double against(double p_t) const { return p_t > 0.0 ? backward : forward; }
  };

  /// `W`: d x d by columns, [normal, tangents]; kept.
  [[gnu::hot]] PairProblem(const double* W, Friction mu, double cohesion, double tension);

  /// `free`, `force`: d.
  [[gnu::hot]] void solve(const double* free, double* force);

  /// One step of a sweep: `force` (d) becomes the solution for a pair that moves by `motion` under its present force.
  /// `change` (d) is what that adds, and `largest` grows to its largest component; false, and nothing changed, where it
  /// adds nothing.
  [[gnu::hot]] bool step(const double* motion, double* force, double* change, double& largest);

 private:
  using Tangential = double[2][2];

  [[gnu::hot]] bool open(const double* free, double* force);
  [[gnu::hot]] bool stick(double a_n, const double* c, double* force) const;
  [[gnu::hot]] bool slip(double a_n, const double* c, Friction friction, double* force);
  [[gnu::hot]] void slide(const Tangential& A, double a_n, const double* c, double m, double* p_t);
  [[gnu::hot]] double normal(double a_n, const double* p_t) const;

  double W_[d * d];
  double inverse_;  // 1 / W_nn; 0 if no force moves the pair along its normal
  Friction mu_;
  double cohesion_, tension_;
  double nt_[2] = {0.0, 0.0}, tn_[2] = {0.0, 0.0};  // W_nt, W_tn / W_nn; in the plane the second tangent does not exist
  Tangential A_ = {{0.0, 0.0}, {0.0, 0.0}};
  double determinant_;  // of A; 0: singular
  double s_ = 0.0;      // of the previous solve; 0: none
};

extern template class PairProblem<2>;
extern template class PairProblem<3>;

/// Of all pairs of a problem with d components.
template <int d>
std::vector<PairProblem<d>> pair_problems(const Problem& problem);

}  // namespace scabo::contact
