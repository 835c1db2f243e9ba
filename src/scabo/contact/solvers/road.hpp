// Common parts of the other solvers of a discrete contact problem ("roads"). They exist for comparison and as
// alternatives where Newton on the B-differentiable equations fails; ../solvers.hpp lists and calls them.
//
// A solver receives the problem in forces: W and q times one stiffness, the inverse of the mean of W_ii, so that
// every unknown and every residual is a force. It returns the best point found and, if this is not accurate enough,
// the reason. It does not decide whether the problem is solved: ../solvers.cpp certifies.
//
// The residual of all these solvers is the largest component, a force, of
//
//     p_n - (p_n - r_n g)+                                     = min(r_n g, p_n)
//     p_t - P_D( p_t - r_t ds ),  D = { |p_t| <= mu (p_n)+ }    P: nearest point of the disk (2D: interval)
//
// with cohesion c and tensile strength T: (p_n + T) in the place of p_n in the first row, c + mu (p_n)+ as
// bound. r_n = 1/W_nn, r_t = 1/mean of W_tt for each pair: one r for both tangents, so that the cone stays
// round.
#pragma once

#include <string>
#include <vector>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::contact::solvers {

/// Parts of one pair: motions or forces [n, t] or [n, t1, t2]. Room for four: whole vector registers.
using Local = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
using LocalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

struct Control {
  double small = 1e-12;  ///< force: a largest residual below this is the end
  int iterations = 50;   ///< of Newton's kind; each road says what it makes of it
  Deadline deadline;     ///< no iteration begins after it
};

struct End {
  Vector p, a;             ///< best point: forces (dN), rigid motions (m)
  bool converged = false;  ///< residual <= small
  int iterations = 0;
  double residual = 0.0;  ///< largest, force
  std::string reason;     ///< where not converged: what happened
  std::vector<Iteration> trace;
};

/// Law of pair i with its numbers: mu, cohesion (0 where the problem has none), tension (likewise).
struct PairLaw {
  double mu = 0.0, cohesion = 0.0, tension = 0.0;
  double bound(double p_n) const { return cohesion + mu * std::max(p_n, 0.0); }
};
PairLaw pair_law(const Problem& problem, Eigen::Index i);

/// r_n and r_t of every pair, 2 x N. Where W_ii is nearly 0: of the mean.
Matrix pair_stiffness(const Problem& problem);

/// The vector of the residual above, dN + m: last G'p + f.
Vector residual_of(const Problem& problem, const Matrix& r, const Vector& p, const Vector& a);
double largest(const Vector& v);

/// State of every pair by its forces and motions, for the count of changes in a trace: open 0, stick 1,
/// slip 2.
std::vector<int> states_at(const Problem& problem, const Matrix& r, const Vector& p, const Vector& motion);
int changes(const std::vector<int>& before, const std::vector<int>& after);

/// Nearest point to `t` with |t| <= bound.
Local project_on_disk(const Local& t, double bound);

/// The best point so far, with its residual.
class Best {
 public:
  explicit Best(End& end) : end_(end) { end_.residual = HUGE_VAL; }
  void offer(const Vector& p, const Vector& a, double residual) {
    if (!(residual < end_.residual)) return;  // nan: no
    end_.p = p;
    end_.a = a;
    end_.residual = residual;
  }

 private:
  End& end_;
};

}  // namespace scabo::contact::solvers
