// Bonded: the two points keep their initial relative position, g = g_0 and u_t = 0, under any force.
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
