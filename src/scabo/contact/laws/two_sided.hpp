// A pair that keeps its normal motion, u_n = 0, under any normal force, pull and push alike, and has no tangential
// force: the stiffness of a bar along its direction (system/bars.hpp).
#pragma once

#include <limits>

#include "scabo/contact/laws/law.hpp"

namespace scabo::contact {

class TwoSided : public Law {
 public:
  Limits limits(const PairHistory&) const override { return {0.0, 0.0, std::numeric_limits<double>::infinity()}; }
};

}  // namespace scabo::contact
