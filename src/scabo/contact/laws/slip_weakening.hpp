// Coulomb's law with a coefficient that decreases with the accumulated slip s in contact:
//
//     mu(s) = mu_s - (mu_s - mu_d) min(s / L, 1)          L > 0
//     mu    = mu_s until slip begins, mu_d afterwards     L = 0
//
// Linear slip weakening: Ida, J. Geophys. Res. 77 (1972) 3796.
// There is no healing.
#pragma once

#include <algorithm>

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class SlipWeakening : public Law {
 public:
  SlipWeakening(double mu_s, double mu_d, double distance) : static_(mu_s), dynamic_(mu_d), distance_(distance) {}

  Limits limits(const PairHistory& history) const override {
    if (distance_ == 0.0) return {history.slipped ? dynamic_ : static_, 0.0, 0.0};
    return {static_ - (static_ - dynamic_) * std::min(history.slip / distance_, 1.0), 0.0, 0.0};
  }
  PairHistory after(PairHistory history, const PairEnd& end) const override {
    history.slip += end.slip;
    if (distance_ == 0.0 && end.slid) history.slipped = true;
    return history;
  }
  bool remembers() const override { return dynamic_ < static_; }

 private:
  double static_, dynamic_;  // 0 <= dynamic <= static
  double distance_;          // length, >= 0
};

}  // namespace scabo::contact
