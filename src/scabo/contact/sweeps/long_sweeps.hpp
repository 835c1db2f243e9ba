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

#include <cmath>
#include <optional>

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

 private:
  struct Round {
    Vector p;
    double map;
  };
  /// Changes of p and of f over the last rounds.
  class Changes {
   public:
    explicit Changes(Eigen::Index n);
    void remember(const Vector& before, const Vector& p);
    bool extrapolate(Vector& p) const;
    void forget() { count_ = next_ = 0, last_p_.resize(0); }

   private:
    Matrix f_, p_;
    Vector last_f_, last_p_;  // empty after forget()
    int count_ = 0, next_ = 0;
  };

  const Problem& problem_;
  const Measure measure_;
  GaussSeidel iteration_;
  Changes changes_;
  Vector p_, best_;
  std::optional<Round> round_;  // S(p) where p_ is extrapolated, to go back to
  double least_ = HUGE_VAL, halved_ = HUGE_VAL;
  int sweeps_ = 0, gained_ = 0;
};

}  // namespace scabo::contact
