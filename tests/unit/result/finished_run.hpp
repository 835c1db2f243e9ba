// A run of two converged increments and one that is not, as its results directory sees it.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "scabo/result/results_directory.hpp"
#include "unit/result/solutions.hpp"

namespace scabo::result {

using namespace scabo::test;
using Json = nlohmann::ordered_json;

inline const Mat2 small_gradient = (Mat2() << 1e-4, 0.0, 0.0, -2e-4).finished();

inline analysis::ContactResult contact_result() {
  analysis::ContactResult contact;
  contact.name = "joint, left";
  analysis::PairResult open, slip;
  open.pair = 1;
  open.position = {0.1, 1.0};
  open.gap = 1e-4;
  open.state = contact::ContactState::open;
  slip.pair = 2;
  slip.position = {0.2, 1.0};
  slip.slip = -0.3;
  slip.normal_force = 100.0;
  slip.tangential_force = 1.0 / 3.0;
  slip.pressure = 4e5;
  slip.shear = -2.5;
  slip.state = contact::ContactState::slip;
  slip.displacement_a = {1.5, 2.5};
  slip.displacement_b = {3.5, 4.5};
  contact.pairs = {open, slip};
  contact.normal_force = 100.0;
  contact.tangential_force = 1.0 / 3.0;
  contact.open = contact.slip = 1;
  contact.max_gap = 1e-4;
  contact.max_pressure = 4e5;
  contact.first_in_contact = contact.last_in_contact = 2;
  return contact;
}

inline analysis::StaticSolution two_bodies() {
  auto model = model_of(
      {elastic("upper", rectangle({0.0, 1.0}, {1.0, 1.0}), 0.5), finite_elements("lower", {0.0, 0.0}, {1.0, 1.0}, 0.5)},
      model::Plane::stress);
  model.supports.resize(2);
  model.supports[0].name = "lower.bottom";
  model.supports[1].name = "upper.top";
  return solution_of(model);
}

inline analysis::IncrementResult increment_number(const analysis::StaticSolution& solution, int number) {
  auto increment = increment_of(solution, linear_field(small_gradient));
  increment.increment = number;
  increment.reached = 0.25 * number;
  increment.factors = {{"tip", 0.25 * number}};
  increment.newton_iterations = 3;
  increment.residual = 1e-15;
  increment.contacts = {contact_result()};
  increment.reactions = {{1.0, -2.0}, {0.1, 0.2}};
  increment.certificate.penetration = 3e-13;
  increment.energy = {5.0, 4.0, 1.0};
  return increment;
}

inline std::vector<std::string> names_in(const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path)) names.push_back(entry.path().filename().string());
  return names;
}

inline std::vector<std::string> keys_of(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  return keys;
}

/// A run of two converged increments and one that is not.
class FinishedRun {
 public:
  explicit FinishedRun(const std::filesystem::path& path) : solution(two_bodies()), directory(path, solution.model) {
    for (const int number : {1, 2}) add(increment_number(solution, number));
    analysis::IncrementResult failed;
    failed.step = 1;
    failed.step_name = "press";
    failed.increment = 3;
    failed.residual = std::numeric_limits<double>::quiet_NaN();
    failed.newton_iterations = 50;
    failed.reason = "the line search found no descent";
    add(failed);
    solution.outcome = analysis::Outcome::not_converged;
    solution.reason = "step press, increment 3: the line search found no descent";
    solution.warnings = {{WarningKind::few_pairs, "joint", "a first warning"}};
    solution.timing.total = 1.25;
    directory.finish(solution);
  }

  analysis::StaticSolution solution;
  ResultsDirectory directory;

 private:
  void add(analysis::IncrementResult increment) {
    solution.increments.push_back(std::move(increment));
    directory.add(solution, solution.increments.back());
  }
};

class Results : public testing::Test {
 protected:
  TemporaryDirectory holder_;
  std::filesystem::path path_ = holder_.path() / "deep" / "out";
};

}  // namespace scabo::result
