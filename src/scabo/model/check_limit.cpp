// Validation of steps that look for a limit.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

bool any(const std::vector<char>& of) { return std::find(of.begin(), of.end(), 1) != of.end(); }

/// What the factor multiplies, beside the factors of the step before.
void check_scaled(Checking& checking, const std::string& path, const Step& step, const Step& before) {
  const Model& model = checking.model;
  const LimitStep& limit = *step.limit;
  if (limit.loads.size() != model.loads.size() || limit.friction.size() != model.contacts.size() ||
      limit.cohesion.size() != model.contacts.size())
    return checking.error(path, "", "must say of every load and contact whether the factor is theirs");
  if (any(limit.loads) == (any(limit.friction) || any(limit.cohesion)))
    return checking.error(path, "", "needs loads whose factor grows, or contacts whose strength is divided by it");
  const double first = first_factor(step);
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    if (limit.loads[i] && before.load_factors[i] != first)
      return checking.error(path, "of",
                            fmt::format("load '{}' begins with factor {:g} and another one with {:g}: bring all to "
                                        "the same factor in the step before",
                                        model.loads[i].name, before.load_factors[i], first));
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const double friction = before.friction.empty() ? contact.friction : before.friction[c];
    if (limit.friction[c] && !(friction > 0.0))
      checking.error(path, "friction", fmt::format("contact '{}' has no friction to be reduced", contact.name));
    if (limit.cohesion[c] && !(contact.lasting_cohesion > 0.0))
      checking.error(path, "cohesion", fmt::format("contact '{}' has no lasting cohesion to be reduced", contact.name));
  }
}

/// What does not go with such a step.
void check_beside_limit(Checking& checking, const std::string& path, std::size_t index) {
  const Model& model = checking.model;
  const auto refuse = [&](const Source& at, const std::string& where, std::string message) {
    checking.enter(at);
    checking.error(where, "", std::move(message));
  };
  const int number = static_cast<int>(index);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (number > 0 && (model.bodies[b].added == number || model.bodies[b].removed == number))
      refuse(model.bodies[b].source, path_of("bodies", model.bodies[b].name, b),
             "comes or goes in the step that looks for a limit: let it do so in a step before");
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const std::string where = path_of_joint("contacts", contact.source, contact.name, c);
    if (contact.fit_in == number)
      refuse(contact.source, where, "closes its interference in the step that looks for a limit: name a step before");
    if (contact.large_slip)
      refuse(contact.source, where, "slips far, for which no limit is looked for in this version: leave 'slip' out");
  }
  if (model.tolerance || model.output.error || !model.output.error_of.empty() ||
      std::any_of(model.bodies.begin(), model.bodies.end(),
                  [](const Body& body) { return body.mesh.tolerance.has_value(); }))
    refuse(model.steps[index].source, path,
           "does not go with error bars and tolerances: leave them out, and halve 'size' to compare limits");
}

}  // namespace

double first_factor(const Step& step) {
  for (std::size_t i = 0; i < step.limit->loads.size(); ++i)
    if (step.limit->loads[i]) return step.load_factors[i] - 1.0;
  return 1.0;
}

double limit_factor(const Step& step, double part) {
  return any(step.limit->loads) ? first_factor(step) + part : 1.0 / (1.0 - part);
}

double part_at_factor(const Step& step, double factor) {
  return any(step.limit->loads) ? factor - first_factor(step) : 1.0 - 1.0 / factor;
}

void check_limit_steps(Checking& checking) {
  const Model& model = checking.model;
  if (model.analysis.type == AnalysisType::modal || checking.gaps.steps) return;
  for (std::size_t i = 0; i < model.steps.size(); ++i) {
    const Step& step = model.steps[i];
    if (!step.limit) continue;
    const std::string path = path_of("steps", step.source, i);
    checking.enter(step.source);
    if (i + 1 != model.steps.size())
      checking.error(path, "", "is followed by another step: the last one looks for a limit");
    if (i == 0)
      checking.error(path, "", "needs a step before it, for the loads that stay: {name: weight, loads: {weight: 1}}");
    if (step.growth || is_dynamic(model))
      checking.error(path, "", "is quasi-static, and goes neither with steps in time nor with cracks that grow");
    if (step.automatic || step.increments != 1)
      checking.error(path, "increments", "is not for a limit, whose increments follow from its bracket: leave it out");
    if (!(step.limit->relative >= 1e-9 && step.limit->relative <= 0.5))
      checking.error(path, "relative", fmt::format("must be between 1e-9 and 0.5, not {:g}", step.limit->relative));
    if (i > 0 && !checking.gaps.conditions) check_scaled(checking, path, step, model.steps[i - 1]);
    check_beside_limit(checking, path, i);
  }
}

}  // namespace scabo::model
