// Tresca's law: the bound of the tangential force is prescribed and independent of pressure, |p_t| <= k A, p_n >= 0.
// Slip does not reduce it. It also acts on open pairs, because the bound does not depend on p_n; it is therefore meant
// for the parts of a joint that stay closed.
#pragma once

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class Tresca : public Law {
 public:
  explicit Tresca(double shear_strength) : k_(shear_strength) {}
  Limits limits(const PairHistory&) const override { return {0.0, k_, 0.0}; }

 private:
  double k_;  // force / length^2, >= 0
};

}  // namespace scabo::contact
