// Coulomb's law with a coefficient that decreases with the accumulated slip s in contact:
//
//     mu(s) = mu_s - (mu_s - mu_d) min(s / L, 1)          L > 0
//     mu    = mu_s until slip begins, mu_d afterwards     L = 0
//
// Linear slip weakening: Ida, J. Geophys. Res. 77 (1972) 3796.
// There is no healing. Forward and backward slip may have coefficients of their own; both fall with all slip, of either
// direction.
#pragma once

#include <algorithm>

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class SlipWeakening : public Law {
 public:
  /// Coefficients against slip of one direction, 0 <= dynamic <= static.
  struct Fall {
    double at_rest = 0.0, sliding = 0.0;
    bool operator==(const Fall&) const = default;
  };

  SlipWeakening(double mu_s, double mu_d, double distance)
      : SlipWeakening(Fall{mu_s, mu_d}, Fall{mu_s, mu_d}, distance) {}
  SlipWeakening(const Fall& forward, const Fall& backward, double distance)
      : forward_(forward), backward_(backward), distance_(distance) {}

  Limits limits(const PairHistory& history) const override {
    Limits limits{coefficient(forward_, history), 0.0, 0.0};
    if (!(backward_ == forward_)) limits.mu_backward = coefficient(backward_, history);
    return limits;
  }
  PairHistory after(PairHistory history, const PairEnd& end) const override {
    history.slip += end.slip;
    if (distance_ == 0.0 && end.slid) history.slipped = true;
    return history;
  }
  bool remembers() const override {
    return forward_.sliding < forward_.at_rest || backward_.sliding < backward_.at_rest;
  }

 private:
  double coefficient(const Fall& fall, const PairHistory& history) const {
    if (distance_ == 0.0) return history.slipped ? fall.sliding : fall.at_rest;
    return fall.at_rest - (fall.at_rest - fall.sliding) * std::min(history.slip / distance_, 1.0);
  }

  Fall forward_, backward_;
  double distance_;  // length, >= 0
};

}  // namespace scabo::contact
