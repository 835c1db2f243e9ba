// A law of contact: the admissible forces of a pair, from its parameters and its history
// (docs/methods/20_contact_laws.md).
//
// The discrete problem has one set of admissible forces for a pair (contact/problem.hpp),
//
//     p_n >= -tau_t A,   |p_t| <= c A + mu (p_n)+                    A: tributary area of the pair
//
// and a law says which mu, c, tau_t hold now, and what a solution makes of the history: laws whose strength
// falls (a joint that breaks, friction that falls once slip begins) are solved again within the increment
// until nothing changes (laws/evolution.hpp). Laws never change; histories are values.
#pragma once

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// What a pair has been through up to an accepted state.
struct PairHistory {
  double slip = 0.0;     ///< length slid in contact, to and fro, >= 0
  bool broken = false;   ///< cohesion and tensile strength are lost
  bool slipped = false;  ///< static friction has been overcome
  bool operator==(const PairHistory&) const = default;
};

/// What a pair can carry.
struct Limits {
  double mu = 0.0;        ///< coefficient of friction
  double cohesion = 0.0;  ///< c, force / length^2; infinity: it cannot slip
  double tension = 0.0;   ///< tau_t, force / length^2; infinity: it cannot open
  bool operator==(const Limits&) const = default;
};

/// How a pair ended in a solution.
struct PairEnd {
  bool opened = false;  ///< gap > 0
  bool slid = false;    ///< |slip increment| > 0 in contact
  double slip = 0.0;    ///< |slip increment|, length; 0 unless `slid`
};

class Law {
 public:
  virtual ~Law() = default;
  virtual Limits limits(const PairHistory& history) const = 0;
  /// The history after an increment that ended so. Of the marks (broken, slipped) those of `history` stay.
  virtual PairHistory after(PairHistory history, const PairEnd& end) const {
    history.slip += end.slip;
    return history;
  }
  /// Whether the limits depend on the history.
  virtual bool remembers() const { return false; }
  /// Whether the pair starts and stays as it is, whatever its gap: bonded.
  virtual bool keeps_gap() const { return false; }
};

}  // namespace scabo::contact
