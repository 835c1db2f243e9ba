// Coulomb's law: |p_t| <= mu (p_n)+, p_n >= 0. mu = 0: frictionless.
#pragma once

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class Coulomb : public Law {
 public:
  explicit Coulomb(double mu) : mu_(mu) {}
  Limits limits(const PairHistory&) const override { return {mu_, 0.0, 0.0}; }

 private:
  double mu_;  // >= 0
};

}  // namespace scabo::contact
