// Runs a model given as text.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"
#include "support/recorded_checks.hpp"

namespace scabo::verification {

/// A solution that has super-elements (empty ones for finite elements). Throws otherwise: what evaluates a run reads
/// them, and a test whose run ended before they existed fails with this sentence.
inline analysis::StaticSolution with_super_elements(analysis::StaticSolution solution) {
  if (solution.cells.empty())
    throw std::runtime_error("the run ended before its super-elements existed; " + solution.reason);
  return solution;
}

inline analysis::StaticSolution run(const std::string& text, const std::vector<std::string>& settings = {}) {
  test::record_model(text, settings);
  std::vector<input::Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(input::parse_override(setting));
  return with_super_elements(analysis::solve_static(input::parse_model(text, "test.yaml", overrides)));
}

/// Increment `index`, which must have converged: what does not exist is thrown as a sentence, so that a test whose run
/// failed fails, and does not read past the end of what there is.
inline const analysis::IncrementResult& increment_at(const analysis::StaticSolution& solution, std::size_t index) {
  if (index >= solution.increments.size())
    throw std::runtime_error("the run has " + std::to_string(solution.increments.size()) +
                             " increments, and none of number " + std::to_string(index + 1) + "; " + solution.reason);
  const analysis::IncrementResult& increment = solution.increments[index];
  if (!increment.converged)
    throw std::runtime_error("increment " + std::to_string(index + 1) + " did not converge: " + increment.reason);
  return increment;
}

/// The only contact of an increment, or its first.
inline const analysis::ContactResult& contact_of(const analysis::IncrementResult& increment, std::size_t index = 0) {
  if (index >= increment.contacts.size())
    throw std::runtime_error("the increment has no such contact; " + increment.reason);
  return increment.contacts[index];
}

/// The last increment of a run that was solved and certified. Throws otherwise, which ends the test as failed.
inline const analysis::IncrementResult& last(const analysis::StaticSolution& solution) {
  if (solution.outcome != analysis::Outcome::solved || solution.increments.empty())
    throw std::runtime_error("the run was not solved: " + solution.reason);
  const analysis::IncrementResult& increment = increment_at(solution, solution.increments.size() - 1);
  EXPECT_LE(increment.certificate.worst(), 1e-10);
  return increment;
}

}  // namespace scabo::verification
