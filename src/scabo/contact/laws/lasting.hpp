// Lasting cohesion, in addition to friction of any law (Mohr-Coulomb):
//
//     p_n >= 0,   |p_t| <= c A + mu p_n     while the pair is closed, however far it has slipped
//     p   = 0                               while it is open
#pragma once

#include <memory>
#include <utility>

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class LastingCohesion : public Law {
 public:
  LastingCohesion(std::shared_ptr<const Law> friction, double cohesion)
      : friction_(std::move(friction)), cohesion_(cohesion) {}

  Limits limits(const PairHistory& history) const override {
    Limits limits = friction_->limits(history);
    if (!history.broken) limits.cohesion = cohesion_;
    return limits;
  }
  PairHistory after(PairHistory history, const PairEnd& end) const override {
    history = friction_->after(history, end.opened ? PairEnd{.opened = true} : end);
    history.broken = end.opened;
    return history;
  }
  bool remembers() const override { return true; }
  bool recovers() const override { return true; }

 private:
  std::shared_ptr<const Law> friction_;
  double cohesion_;  // force / length^2, >= 0
};

}  // namespace scabo::contact
