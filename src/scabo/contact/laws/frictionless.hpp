// Unilateral contact without friction: p_n >= 0, p_t = 0.
#pragma once

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class Frictionless : public Law {
 public:
  Limits limits(const PairHistory&) const override { return {}; }
};

}  // namespace scabo::contact
