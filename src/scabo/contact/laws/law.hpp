// A contact law: the admissible forces of a pair, from its parameters and its history
// (docs/methods/20_contact_laws.md).
//
// In the discrete problem the admissible forces of a pair are (contact/problem.hpp)
//
//     p_n >= -tau_t A,   |p_t| <= c A + mu (p_n)+                    A: tributary area of the pair
//
// with two coefficients where friction differs by the direction of slip.
//
// A law gives the current mu, c and tau_t, and the history that follows from a solution. Laws whose strength decreases
// (a joint that breaks, friction that decreases once slip begins) are solved repeatedly within the increment until
// nothing changes (laws/evolution.hpp). Laws never change; histories are values.
#pragma once

#include <optional>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

/// History of a pair up to an accepted state.
struct PairHistory {
  double slip = 0.0;     ///< accumulated slip in contact, regardless of direction, length >= 0
  bool broken = false;   ///< cohesion and tensile strength are lost, for good or while the pair is open
  bool slipped = false;  ///< static friction has been overcome
  bool operator==(const PairHistory&) const = default;
};

/// Strength of a pair.
struct Limits {
  double mu = 0.0;        ///< coefficient of friction
  double cohesion = 0.0;  ///< c, force / length^2; infinity: it cannot slip
  double tension = 0.0;   ///< tau_t, force / length^2; infinity: it cannot open
  /// Against backward slip, where it differs; `mu` is then that against forward slip.
  std::optional<double> mu_backward = std::nullopt;
  bool operator==(const Limits&) const = default;
};

/// State of a pair in a solution.
struct PairEnd {
  bool opened = false;  ///< gap > 0
  bool slid = false;    ///< |slip increment| > 0 in contact
  double slip = 0.0;    ///< |slip increment|, length; 0 unless `slid`
};

class Law {
 public:
  virtual ~Law() = default;
  virtual Limits limits(const PairHistory& history) const = 0;
  /// The history after an increment with this end state. The flags (broken, slipped) of `history` are kept.
  virtual PairHistory after(PairHistory history, const PairEnd& end) const {
    history.slip += end.slip;
    return history;
  }
  /// Whether the limits depend on the history.
  virtual bool remembers() const { return false; }
  /// Whether a strength that is lost where the pair opens comes back where it closes.
  virtual bool recovers() const { return false; }
  /// Whether the pair keeps its initial gap, whatever it is (bonded).
  virtual bool keeps_gap() const { return false; }
};

}  // namespace scabo::contact
