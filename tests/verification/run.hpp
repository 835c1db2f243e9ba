// Runs a model given as text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/model/read_model.hpp"

namespace scabo::verification {

inline analysis::StaticSolution run(const std::string& text, const std::vector<std::string>& settings = {}) {
  std::vector<model::Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(model::parse_override(setting));
  return analysis::solve_static(model::parse_model(text, "test.yaml", overrides));
}

/// The last increment, which must have been solved and certified.
inline const analysis::IncrementResult& last(const analysis::StaticSolution& solution) {
  EXPECT_EQ(solution.outcome, analysis::Outcome::solved) << solution.reason;
  const analysis::IncrementResult& increment = solution.increments.back();
  EXPECT_TRUE(increment.converged) << increment.reason;
  EXPECT_LE(increment.certificate.worst(), 1e-10);
  return increment;
}

}  // namespace scabo::verification
