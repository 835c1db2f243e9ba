// Coulomb's law: |p_t| <= mu (p_n)+, p_n >= 0. mu = 0: frictionless. Where the coefficient differs by the direction of
// slip, forward (u_t > 0) or backward:
//
//     -mu_f (p_n)+ <= p_t <= mu_b (p_n)+
#pragma once

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class Coulomb : public Law {
 public:
  explicit Coulomb(double mu) : mu_(mu) {}
  Coulomb(double forward, double backward) : mu_(forward) {
    if (backward != forward) backward_ = backward;
  }
  Limits limits(const PairHistory&) const override { return {mu_, 0.0, 0.0, backward_}; }

 private:
  double mu_;                       // >= 0
  std::optional<double> backward_;  // >= 0
};

}  // namespace scabo::contact
