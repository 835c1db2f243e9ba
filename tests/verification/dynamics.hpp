// What tests of steps in time share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "run.hpp"

namespace scabo::verification {

/// What every step in time promises.
inline void expect_balanced(const analysis::StaticSolution& solution) {
  ASSERT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  double largest = 0.0;
  for (const analysis::IncrementResult& at : solution.increments) {
    if (!at.time) continue;
    const analysis::Energy& energy = at.energy;
    largest = std::max(largest, energy.kinetic + energy.elastic);
    EXPECT_LT(at.certificate.worst(), 1e-10);
    EXPECT_LT(at.certificate.energy_balance, 1e-9);
    EXPECT_NEAR(energy.kinetic + energy.elastic + energy.friction + energy.damping + energy.impact + energy.projection +
                    energy.massless,
                energy.external, 1e-9 * largest);
  }
}

}  // namespace scabo::verification
