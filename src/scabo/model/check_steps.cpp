// Validation of steps and of their factors.
#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

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
    checking.whole(path, "increments", step.increments, limits::increments);
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
