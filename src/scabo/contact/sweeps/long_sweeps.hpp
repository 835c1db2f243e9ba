// Many thousands of sweeps (gauss_seidel.hpp) with extrapolation between rounds of twenty, for problems whose W is rank
// deficient: stacks of rigid bodies, where forces travel from body to body and their states settle late.
//
// A round of twenty sweeps is the map p -> S(p) whose fixed point is sought: what it has not damped are few slow modes,
// and with the last eight changes of p and of f = S(p) - p (Anderson, J. ACM 12 (1965) 547; type II)
//
//     p+ = S(p) - sum_j gamma_j dS_j,   gamma = argmin | f - sum_j gamma_j df_j |
//
// is tried. Where the natural map after the next round is larger than that of S(p), S(p) is taken back and the changes
// are forgotten. Rigid bodies are swept by their joints (joint_sweeps.hpp).
#pragma once

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/sweeps/gauss_seidel.hpp"

namespace scabo::contact {

class LongSweeps {
 public:
  /// Keeps a reference to `problem`: as for GaussSeidel. From the forces `p`.
  LongSweeps(const Problem& problem, Vector p);

  /// Goes on where it ended before, until `accepts` says yes to forces and motions (true), the deadline has passed, or
  /// `most` sweeps are done in all; up to four times as many where the second half of them, or the last 500, halved the
  /// least natural map.
  bool run(int most, const IsSolution& accepts, const Deadline& deadline = {});

  const Vector& p() const { return best_; }      ///< accepted, or of the least natural map
  double natural_map() const { return least_; }  ///< the least one met after a round
  int sweeps() const { return sweeps_; }
  int extrapolations() const { return extrapolations_; }  ///< that were kept

 private:
  void remember(const Vector& before);
  bool extrapolate();
  void forget() { count_ = next_ = 0, has_last_ = false; }

  const Problem& problem_;
  Measure measure_;
  GaussSeidel iteration_;
  Vector p_, round_, best_;  // round_: S(p), to go back to
  Matrix changes_f_, changes_p_;
  Vector last_f_, last_p_;
  double map_of_round_ = 0.0, least_ = 0.0, halved_ = 0.0;
  int sweeps_ = 0, gained_ = 0, extrapolations_ = 0, count_ = 0, next_ = 0;
  bool has_last_ = false, extrapolated_ = false;
};

}  // namespace scabo::contact
