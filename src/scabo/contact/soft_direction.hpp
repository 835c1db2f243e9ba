// The direction of Newton's method near a solution of a plane problem of many bodies: H(z) + A d = 0, with a little on
// the diagonal of A.
//
// Close to a solution a wall may be nearly a mechanism: most joints slip, and one wrong state lets a block go. The
// exact direction is then a thousand times too long. And where three bodies meet in a point, one motion of its three
// pairs follows from the other two: rows of pairs that are taken to stick all at once may contradict each other. The
// matrix therefore has a tenth of |H| over the largest force, from 1e-6 to 1e-2 (of 1 / r), on its rows of motions, and
// a tenth of that with the opposite sign, for a motion that moves one component of one pair by 1, on its rows of
// balance: what is not determined moves little. It is not taken back: an error is left, which the next step takes, and
// as it shrinks with |H| convergence stays fast (Yamashita and Fukushima, Computing Suppl. 15 (2001) 239).
//
//     presses:  r_n (W dp + G da)_n = -H_n        open:   dp_n = -H_n
//     sticks:   r_t (W dp + G da)_t = -H_t        slips:  dp_t - e mu dp_n = -H_t        G'dp = -H_R
//
// A body that all its pairs let slide is held before, by the pair that will stick (sliding_bodies.hpp).
//
// A factorisation costs as much as some thirty solves, and from one step to the next few pairs change their state. Each
// of them changes two rows, so that GMRES with the factor of an earlier step for a preconditioner needs at most two
// products for each. Only where that takes too many is there another factorisation.
#pragma once

#include <optional>
#include <vector>

#include "scabo/contact/b_differentiable.hpp"
#include "scabo/contact/joint_order.hpp"
#include "scabo/contact/sliding_bodies.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

class SoftDirection {
 public:
  /// Of Coulomb's law in the plane with W sparse and rigid motions. Keeps a reference.
  explicit SoftDirection(const BDifferentiableEquations& equations);

  /// d = [dp; da] at forces p, for the branches of `at`; of pairs that are tied, for those that hold least. False where
  /// there is none.
  bool find(const Residual& at, const Vector& p, Vector& d);

  int factorisations() const { return factorisations_; }
  /// Whether the last direction came by the factor of an earlier one.
  bool reused() const { return reused_; }
  /// The next direction has a factor of its own.
  void forget_factor() { held_.clear(); }

 private:
  using State = PairState;
  struct Unknown {
    int row = 0;         ///< of W
    double slope = 0.0;  ///< of the tangential force that follows it
  };
  static std::vector<State> states_of(const Residual& at);
  bool asks_for_motion(const std::vector<State>& states, Eigen::Index row) const;
  bool reuse_factor(const std::vector<State>& states, const Vector& right, Vector& d);
  void apply(const std::vector<State>& states, const Vector& x, Vector& image);
  bool factorise();
  void solve(const Vector& right, Vector& x);

  const BDifferentiableEquations& equations_;
  SlidingBodies sliding_;
  double raise_ = 0.0;        ///< on the rows of motions
  Vector size_, hold_;        ///< of the columns of G, squared; on the rows of balance
  std::vector<int> staying_;  ///< motions, in the last step
  std::vector<State> held_;   ///< of the factor; empty: none
  std::vector<Unknown> unknowns_;
  Eigen::SparseMatrix<double> A_;
  linalg::SparseGeneralSolver factor_;
  std::optional<JointOrder> joint_order_;
  Vector motion_, reduced_, y_, left_, more_;
  int factorisations_ = 0;
  bool reused_ = false;
};

}  // namespace scabo::contact
