// Cracks that grow: what their tests look for in a solution.
#pragma once

#include <gtest/gtest.h>

#include "verification/run.hpp"

namespace scabo::verification {

/// The increment with the state of growth `index`, from 0.
inline const analysis::GrowthResult& growth_at(const analysis::StaticSolution& solution, std::size_t index) {
  const auto& growth = increment_at(solution, index).growth;
  if (!growth) throw std::runtime_error("the increment has no growing crack");
  return *growth;
}

inline const std::vector<Vec2>& path_of(const analysis::StaticSolution& solution) {
  if (!solution.grown || solution.grown->paths.empty()) throw std::runtime_error("no crack has grown");
  return solution.grown->paths.front().points;
}

/// Work is stored, taken by contacts or released, to rounding.
inline void expect_balance(const analysis::GrowthEnergy& energy) {
  EXPECT_NEAR(energy.external - energy.elastic - energy.contact - energy.released, 0.0,
              1e-9 * (std::abs(energy.external) + std::abs(energy.elastic)));
}

}  // namespace scabo::verification
