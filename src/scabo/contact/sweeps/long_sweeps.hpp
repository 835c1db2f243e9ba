// Many thousands of sweeps (gauss_seidel.hpp) with extrapolation between rounds of twenty, for problems whose W is rank
// deficient: stacks of rigid bodies, where forces travel from body to body and their states settle late.
//
// A round of twenty sweeps is the map p -> S(p) whose fixed point is sought: what it has not damped are few slow modes,
// and with the last eight changes an extrapolation (extrapolation.hpp)
// is tried. Where the natural map after the next round is larger than that of S(p), S(p) is taken back and the changes
// are forgotten. Sweeps in one order may end in a cycle, in which a few pairs go around between their states; where
// these do not settle, others follow in orders drawn anew for every sweep, without extrapolation. The draws are the
// same in every run.
#pragma once

#include <cmath>
#include <optional>

#include "scabo/contact/deadline.hpp"
#include "scabo/contact/extrapolation.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/sweeps/gauss_seidel.hpp"

namespace scabo::contact {

class LongSweeps {
 public:
  /// Keeps a reference to `problem`: as for GaussSeidel. From the forces `p`.
  LongSweeps(const Problem& problem, Vector p);

  /// Until `accepts` says yes to forces and motions (true), the deadline has passed, or `most` sweeps of either kind
  /// are done; fewer where neither their second half nor the last `patience` halved the natural map.
  bool run(int most, const IsSolution& accepts, const Deadline& deadline = {});

  const Vector& p() const { return best_; }      ///< accepted, or of the least natural map
  double natural_map() const { return least_; }  ///< the least one met after a round
  int sweeps() const { return sweeps_; }

 private:
  struct Round {
    Vector p;
    double map;
  };
  bool settles(int most, const IsSolution& accepts, const Deadline& deadline);
  bool round(const Deadline& deadline);

  const Problem& problem_;
  const Measure measure_;
  std::unique_ptr<GaussSeidel> iteration_;
  Extrapolation changes_;
  Vector p_, best_;
  std::optional<Round> round_;  // S(p) where p_ is extrapolated, to go back to
  double least_ = HUGE_VAL;
  int sweeps_ = 0;
  bool random_ = false;  // orders
  std::minstd_rand engine_;
};

}  // namespace scabo::contact
