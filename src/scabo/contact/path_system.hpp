// The equations of one piece of a path of solutions (path.hpp), the point reached on it and its direction.
//
// With the states of all pairs the point z = [p; a] at t, and its direction z' by t, solve the same linear system,
//
//     contact:  (W p + G a)_n = -(q + t dq)_n       open:  p_n = 0
//     sticks:   (W p + G a)_t = -(q + t dq)_t       slips: p_t + side mu p_n = 0
//     G'p - h a = -(f + t df)
//
// where W has the softness on its diagonal and h holds the bodies. It is factorised for some states; others replace
// rows of it (linalg/replaced_rows).
#pragma once

#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "scabo/contact/joint_order.hpp"
#include "scabo/contact/path.hpp"
#include "scabo/contact/problem.hpp"
#include "scabo/linalg/replaced_rows.hpp"

namespace scabo::contact {

/// What the rows of a pair ask for: its normal row u_n = 0 or p_n = 0, its tangential row u_t = 0 (stick) or p_t + side
/// mu p_n = 0, where side is the sign of the slip and mu the coefficient against slip of this sign.
struct PathState {
  bool contact = true;
  int side = 0;  ///< 0: stick
  bool operator==(const PathState&) const = default;
};

class PathSystem {
 public:
  PathSystem(const Problem& problem, const PathStart& start, const PathOptions& options);

  Eigen::Index pairs() const { return N_; }
  const std::vector<PathState>& states() const { return states_; }
  const PathState& state(Eigen::Index pair) const { return states_[static_cast<std::size_t>(pair)]; }
  double mu_of(Eigen::Index pair, int side) const { return problem_.mu_against(pair, -side); }
  bool may_stick(Eigen::Index pair) const { return problem_.largest_mu(pair) > 0.0; }

  // The point: forces and rigid motions, motions of the pairs; and what of it changes along the piece, by `dt`.
  const Vector& z() const { return z_; }
  const Vector& motion() const { return motion_; }
  double t() const { return t_; }
  const Vector& dz() const { return dz_; }
  const Vector& d_motion() const { return d_motion_; }
  double dt() const { return dt_; }
  Vector forces() const { return z_.head(2 * N_); }
  Vector rigid_motions() const { return z_.tail(m_); }

  void advance(double step);
  /// Goes along the piece the other way, or faster.
  void turn(double factor);

  /// Of the states at hand, and the point. False where the matrix is singular.
  [[nodiscard]] bool factorise();
  /// The point without what rounding has added from piece to piece.
  [[nodiscard]] bool place();
  /// The direction, with dt = 1. False where it is not finite.
  [[nodiscard]] bool find_direction();
  /// The point of the states at hand and this t, by one solve from the one at hand. False where it is not finite.
  [[nodiscard]] bool correct();
  /// Whether the point meets the equations of the states at hand.
  bool is_exact() const;

  /// Pairs take other states.
  struct Change {
    Eigen::Index pair = 0;
    PathState state;
  };
  void change(const std::vector<Change>& changes);
  /// Rows that were replaced since the factorisation, and how many may be.
  int replaced_rows() const { return static_cast<int>(matrix_.rows().size()); }
  int capacity() const { return capacity_; }
  /// Whether directions have lacked more of the equations than refinement gives back.
  bool inexact() const { return inexact_; }
  /// The sign of the determinant, over that of the matrix factorised.
  int sign() const { return matrix_.sign(); }
  double operations_of_solve() const { return matrix_.operations_of_solve(); }

  /// Forces within the cones and motions that agree with them, for the states at hand and next to the point at hand, in
  /// its place; t is 1 again, what is missing to the problem are dq and df. `margin`, `pressure` as of PathStart.
  void begin_again(double margin, double pressure);
  /// From u = q + (W + s) p + G a to u = q + W p + s (p - p_now) + G a: a path once more, with hardly any change.
  /// Returns the motions that go, over the size of all. What holds the bodies is loosened by this factor.
  double take_softness_back(double loosened);

  /// What a step that is taken back restores.
  struct Point {
    std::vector<PathState> states;
    Vector z, motion;
    double t = 1.0;
  };
  Point point() const { return {states_, z_, motion_, t_}; }
  void go_to(const Point& point);
  /// This point, of a problem without softness that the point at hand has come from, with what holds the bodies times
  /// `hold`; t is 1 again, what is missing are dq and df.
  void begin_at(const Point& point, double hold);

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  void take_states(const PathStart& start);
  bool asks_for_motion(const std::vector<PathState>& states, Eigen::Index row) const;
  linalg::ReplacedRows::Row row_of(const std::vector<PathState>& states, Eigen::Index row) const;
  linalg::ReplacedRows::Row difference_of(Eigen::Index row) const;
  double right_of(const std::vector<PathState>& states, Eigen::Index row) const;
  Vector left_of(const Vector& z, const Vector& motion, const Vector& balance) const;
  Vector left_of_point() const;
  void find_what_is_missing();
  void find_slope();
  void find_motion();
  void find_d_motion();

  const Problem& problem_;
  Eigen::Index N_, m_, n_;
  double softness_;
  int capacity_;
  SparseRows W_, G_;
  Sparse W_columns_, G_columns_;
  Vector soft_, hold_, q_, f_, centre_, centre_a_, dq_, df_, z_, motion_, slope_, dz_, d_motion_;
  double t_ = 1.0, dt_ = -1.0;
  std::vector<PathState> states_, base_;
  linalg::ReplacedRows matrix_;  // of the states `base_`, with the rows of `states_`
  std::optional<JointOrder> joint_order_;
  std::function<linalg::OrderedBlocks(const std::vector<int>& kept)> blocks_;  // empty where W is dense
  bool inexact_ = false, refines_;
  std::minstd_rand random_{7};
};

}  // namespace scabo::contact
