// Common parts of the other solvers of a discrete contact problem. They exist for comparison and as
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
// with cohesion c and tensile strength T: (p_n + T) replaces p_n in the first row, and c + mu (p_n)+ is the bound. r_n
// = 1/W_nn, r_t = 1/mean of W_tt for each pair: one r for both tangents, so that the cone remains circular.
#pragma once

#include <string>
#include <vector>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/solution.hpp"

namespace scabo::compare {

using namespace contact;  // the problem, its solution and its judge

/// Motions or forces of one pair, [n, t] or [n, t1, t2]. Capacity of four for whole vector registers.
using Local = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
using LocalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

struct Control {
  double small = 1e-12;  ///< force: the solver ends when the largest residual is below this
  int iterations = 50;   ///< number of Newton iterations; each solver states how it uses it
  Deadline deadline;     ///< no iteration begins after it
};

struct End {
  Vector p, a;             ///< best point: forces (dN), rigid motions (m)
  bool converged = false;  ///< residual <= small
  int iterations = 0;
  double residual = 0.0;  ///< largest, force
  std::string reason;     ///< why it did not converge
  std::vector<Iteration> trace;
};

/// Law of pair i: mu, cohesion and tension (0 if the problem has none).
struct PairLaw {
  double mu = 0.0, cohesion = 0.0, tension = 0.0;
  double bound(double p_n) const { return cohesion + mu * std::max(p_n, 0.0); }
};
PairLaw pair_law(const Problem& problem, Eigen::Index i);

/// r_n and r_t of every pair, 2 x N. Where W_ii is nearly 0, those of the mean.
Matrix pair_stiffness(const Problem& problem);

/// The residual vector above, dN + m: G'p + f at the end.
Vector residual_of(const Problem& problem, const Matrix& r, const Vector& p, const Vector& a);
double largest(const Vector& v);

/// State of every pair from its forces and motions, to count the changes in a trace: open 0, stick 1, slip 2.
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

}  // namespace scabo::compare
