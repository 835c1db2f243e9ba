// Bonded: the two points stay together as they are at the start, g = g_0 and u_t = 0, whatever the force.
#pragma once

#include <limits>

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class Bonded : public Law {
 public:
  Limits limits(const PairHistory&) const override {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    return {0.0, unlimited, unlimited};
  }
  bool keeps_gap() const override { return true; }
};

}  // namespace scabo::contact
