// Cohesion and tensile strength until first failure, in addition to friction of any law, which remains afterwards:
//
//     p_n >= -tau_t A,   |p_t| <= c A + mu (p_n)+       until the pair opens or slips for the first time
//     p_n >= 0,          |p_t| <= mu (p_n)+             ever after
//
// The joint is brittle: it loses both strengths at once, and its forces are redistributed to its neighbours.
#pragma once

#include <memory>
#include <utility>

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class Cohesive : public Law {
 public:
  Cohesive(std::shared_ptr<const Law> friction, double cohesion, double tension)
      : friction_(std::move(friction)), cohesion_(cohesion), tension_(tension) {}

  Limits limits(const PairHistory& history) const override {
    Limits limits = friction_->limits(history);
    if (!history.broken) limits.cohesion = cohesion_, limits.tension = tension_;
    return limits;
  }
  PairHistory after(PairHistory history, const PairEnd& end) const override {
    if (history.broken) return friction_->after(history, end);
    history.slip += end.slip;
    history.broken = end.opened || end.slid;
    return history;
  }
  bool remembers() const override { return true; }

 private:
  std::shared_ptr<const Law> friction_;
  double cohesion_, tension_;  // force / length^2, >= 0
};

}  // namespace scabo::contact
