// Validation of steps and of their factors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

bool check_factors(Checking& checking, const std::string& path, const std::vector<double>& factors, std::size_t count,
                   const char* of) {
  if (factors.size() != count) {
    checking.error(path, "",
                   fmt::format("gives {} factors for {} {}: one for each is needed", factors.size(), count, of));
    return false;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (!checking.number(path, "loads", factors[i])) return false;
  return true;
}

void check_automatic(Checking& checking, const std::string& path, const AutomaticIncrements& automatic) {
  const auto part = [&](const char* key, double value) {
    if (!checking.number(path, key, value)) return false;
    if (value >= limits::smallest_increment && value <= 1.0) return true;
    checking.error(path, key,
                   fmt::format("must be a part of the step, from {:g} to 1, not {}", limits::smallest_increment,
                               number_text(value)),
                   number_text(value));
    return false;
  };
  const bool largest = part("largest", automatic.largest), smallest = part("smallest", automatic.smallest),
             first = part("first", automatic.first);
  if (largest && smallest && automatic.smallest > automatic.largest) {
    checking.error(path, "smallest",
                   fmt::format("must be at most 'largest', {}, not {}", number_text(automatic.largest),
                               number_text(automatic.smallest)));
    return;
  }
  if (largest && smallest && first && (automatic.first > automatic.largest || automatic.first < automatic.smallest))
    checking.error(
        path, "first",
        fmt::format("must be between 'smallest', {}, and 'largest', {}, not {}", number_text(automatic.smallest),
                    number_text(automatic.largest), number_text(automatic.first)));
}

/// Only a program gives these.
void check_ends(Checking& checking, const std::string& path, const Step& step) {
  if (step.ends.empty()) return;
  const bool ascending =
      std::adjacent_find(step.ends.begin(), step.ends.end(), std::greater_equal<>()) == step.ends.end();
  if (static_cast<int>(step.ends.size()) != step.increments || !ascending || !(step.ends.front() > 0.0) ||
      step.ends.back() != 1.0)
    checking.error(path, "", "gives ends of increments that are not as many as its increments, ascending, up to 1");
}

}  // namespace

int expected_increments(const Step& step) {
  return step.automatic ? static_cast<int>(std::ceil(2.0 / step.automatic->largest)) : step.increments;
}

void check_steps(Checking& checking) {
  const Model& model = checking.model;
  if (checking.gaps.steps) return;
  if (model.steps.empty() && model.analysis.type != AnalysisType::modal) {
    checking.enter({});
    checking.error("steps", "", "contains no step: give at least one");
    checking.gaps.steps = true;
  }
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < model.steps.size(); ++i) {
    const Step& step = model.steps[i];
    const std::string path = path_of("steps", step.source, i);
    checking.enter(step.source);
    if (!is_name(step.name))
      checking.error(path, "name",
                     fmt::format("'{}' is not a valid name: use letters, digits, _ and -, and begin with "
                                 "a letter or _",
                                 step.name));
    else if (!names.insert(step.name).second)
      checking.error(path, "", fmt::format("another step is already named '{}': rename one of them", step.name));
    if (step.automatic)
      check_automatic(checking, path + ".increments", *step.automatic);
    else if (checking.whole(path, "increments", step.increments, limits::increments))
      check_ends(checking, path, step);
    if (!check_factors(checking, path, step.load_factors, model.loads.size(), "loads") ||
        !check_factors(checking, path, step.support_factors, model.supports.size(), "supports"))
      checking.gaps.steps = true;
  }
}

void check_never_applied(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    if (std::any_of(model.steps.begin(), model.steps.end(), [&](const Step& s) { return s.load_factors[i] != 0.0; }))
      continue;
    checking.enter(load.source);
    checking.error_of_key(path_of("loads", load.name, i), "",
                          fmt::format("load '{}' is never applied: name it in a step", load.name));
  }
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Support& support = model.supports[i];
    if (!checking.support[i]) continue;
    if (std::any_of(model.steps.begin(), model.steps.end(), [&](const Step& s) { return s.support_factors[i] != 0.0; }))
      continue;
    checking.enter(support.source);
    checking.error(path_of("supports", support.source, i), "",
                   fmt::format("the displacement of support '{}' is never applied: name it in a step", support.name));
  }
}

}  // namespace scabo::model
