// Validation of steps and of their factors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scabo/model/checking.hpp"
#include "scabo/model/time_steps.hpp"

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

void check_curves(Checking& checking) {
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < checking.model.curves.size(); ++i) {
    const Curve& curve = checking.model.curves[i];
    const std::string path = path_of("curves", curve.name, i);
    checking.enter(curve.source);
    check_name(checking, path, curve.name, "curve", names);
    if (const auto* sine = std::get_if<CurveSine>(&curve.kind)) {
      checking.number(path, "sine.amplitude", sine->amplitude);
      checking.number(path, "sine.mean", sine->mean);
      if (!(sine->turns >= 0.0 && std::isfinite(sine->turns)))
        checking.error(path, "sine", "begins at turns that are not 0 or more");
      if (checking.positive(path, "sine.periods", sine->periods) && sine->periods > 10'000.0)
        checking.error(
            path, "sine.periods",
            fmt::format("must be at most 10000, not {}: use a step with 'cycles'", number_text(sine->periods)));
      continue;
    }
    const auto& points = std::get<CurveTable>(curve.kind).points;
    if (points.empty()) checking.error(path, "", "has no point: give two or more");
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::string key = fmt::format("table.{}", k);
      if (!checking.number(path, key, points[k].at) || !checking.number(path, key, points[k].value)) return;
      if (k > 0 && !(points[k].at > points[k - 1].at) &&
          !(points[k].at == points[k - 1].at && is_dynamic(checking.model))) {
        checking.error(path, key, "positions must be ascending: a factor cannot jump");
        break;
      }
    }
  }
}

/// Factors that follow curves begin where they are at the end of the step before.
void check_beginnings(Checking& checking, const std::string& path, const Step& step, const Step* before) {
  const Model& model = checking.model;
  const auto check = [&](const std::vector<int>& curves, const std::vector<double> Step::*factors, bool support) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      if (curves[i] < 0) continue;
      if (static_cast<std::size_t>(curves[i]) >= model.curves.size()) {
        checking.error(path, "loads", "refers to a curve that does not exist");
        return;
      }
      const Curve& curve = model.curves[static_cast<std::size_t>(curves[i])];
      if (support && curve.record) continue;  // as check_records_of_supports() says
      const auto* table = std::get_if<CurveTable>(&curve.kind);
      if (table != nullptr && table->points.empty()) return;
      const auto together = [](const CurveTable::Point& a, const CurveTable::Point& b) { return a.at == b.at; };
      const bool jumps = table != nullptr && std::adjacent_find(table->points.begin(), table->points.end(), together) !=
                                                 table->points.end();
      if (jumps && is_dynamic(model))  // otherwise it is the curve that is wrong
        checking.error(path, "loads",
                       fmt::format("curve '{}' jumps, which a factor can only in a step in time", curve.name));
      if (jumps) return;
      const double here = before ? (before->*factors)[i] : 0.0, begin = value_of(curve, 0.0),
                   end = value_of(curve, 1.0);
      const std::string& name = support ? model.supports[i].name : model.loads[i].name;
      constexpr double rounding = 1e-9;
      if (std::abs(begin - here) > rounding * std::max(1.0, std::abs(begin)))
        checking.error(path, "loads." + name,
                       fmt::format("curve '{}' begins at {}, but the factor of '{}' is {} there: a factor cannot jump; "
                                   "add a step before that brings it there, or begin the curve at {}",
                                   curve.name, number_text(begin), name, number_text(here), number_text(here)));
      if ((step.*factors)[i] != end)
        checking.error(path, "loads." + name, fmt::format("is not that at the end of curve '{}'", curve.name));
    }
  };
  check(step.load_curves, &Step::load_factors, false);
  check(step.support_curves, &Step::support_factors, true);
}

/// A record moves supports in time.
void check_records_of_supports(Checking& checking, const std::string& path, const Step& step) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < step.support_factors.size(); ++i) {
    const int curve = support_curve(step, i);
    if (curve < 0 || static_cast<std::size_t>(curve) >= model.curves.size()) continue;
    const Curve& of = model.curves[static_cast<std::size_t>(curve)];
    if (of.record && !step.dynamic)
      checking.error(
          path, "loads." + model.supports[i].name,
          fmt::format("curve '{}' is a record in seconds, which moves a support only in a step in time: make "
                      "it one, 'dynamic: {{duration: ...}}'",
                      of.name));
  }
}

/// A support whose factor is `here` follows its curve from there on, without jumps.
void check_curve_of_support(Checking& checking, const std::string& path, const Step& step, std::size_t i, double here) {
  const Model& model = checking.model;
  const auto index = static_cast<std::size_t>(support_curve(step, i));
  if (index >= model.curves.size()) return;
  const Curve& curve = model.curves[index];
  const auto* table = std::get_if<CurveTable>(&curve.kind);
  if (table != nullptr && table->points.empty()) return;
  const std::string& name = model.supports[i].name;
  const double begin = displacement_at(curve, 0.0, step.dynamic->duration);
  double largest = std::max(1.0, std::abs(begin));
  if (curve.record)
    for (const double u : curve.record->displacement) largest = std::max(largest, std::abs(u));
  constexpr double rounding = 1e-9;
  if (std::abs(begin - here) > rounding * largest)
    checking.error(path, "loads." + name,
                   fmt::format("curve '{}' begins at {}, but the factor of support '{}' is {} there: a support cannot "
                               "jump; begin the curve at {}",
                               curve.name, number_text(begin), name, number_text(here), number_text(here)));
  if (table == nullptr || curve.record) return;
  for (std::size_t k = 1; k < table->points.size(); ++k)
    if (table->points[k].at == table->points[k - 1].at && table->points[k].value != table->points[k - 1].value)
      checking.error(
          path, "loads." + name,
          fmt::format("curve '{}' jumps, which support '{}' cannot: give the jump a duration", curve.name, name));
}

/// A time step that the user gives is not longer than what happens within it.
void check_step_resolves_curves(Checking& checking, const std::string& path, const Step& step) {
  const DynamicStep& dynamic = *step.dynamic;
  constexpr double most_lost = 0.5;
  for (const std::size_t index : curves_in_time(step)) {
    if (index >= checking.model.curves.size()) continue;
    const Curve& curve = checking.model.curves[index];
    const double lost = part_averaged_away(curve, dynamic.duration, *dynamic.step);
    if (lost <= most_lost) continue;
    checking.error(
        path, "dynamic.step",
        fmt::format("{} is longer than what happens in curve '{}', of which steps of that length average "
                    "away {:.0f} %: give at most {:.2g}, which keeps 99 %",
                    number_text(*dynamic.step), curve.name, 100.0 * lost, resolving_step(curve, dynamic.duration)));
    return;
  }
}

/// In time curves may begin anywhere, but supports do not jump.
void check_dynamic_step(Checking& checking, const std::string& path, const Step& step, const Step* before) {
  const Model& model = checking.model;
  const DynamicStep& dynamic = *step.dynamic;
  const bool known = checking.positive(path, "dynamic.duration", dynamic.duration);
  if (dynamic.step && checking.positive(path, "dynamic.step", *dynamic.step) && known &&
      *dynamic.step > dynamic.duration)
    checking.error(path, "dynamic.step",
                   fmt::format("must be at most the duration, {}, not {}", number_text(dynamic.duration),
                               number_text(*dynamic.step)));
  else if (dynamic.step && known && dynamic.duration > limits::time_steps * *dynamic.step)
    checking.error(path, "dynamic.step",
                   fmt::format("must be at least {:.3g}, so that there are at most {:.0e} time steps, not {}",
                               dynamic.duration / limits::time_steps, limits::time_steps, number_text(*dynamic.step)));
  else if (dynamic.step && known && *dynamic.step > 0.0)
    check_step_resolves_curves(checking, path, step);
  if (step.automatic)
    checking.error(path, "increments",
                   "of a step in time must be a number: that of the times at which results are written; its time steps "
                   "are divided by themselves where that is needed");
  for (std::size_t i = 0; i < step.support_factors.size(); ++i) {
    const double here = before ? before->support_factors[i] : 0.0;
    const Support& support = model.supports[i];
    const bool moves = support.rotation.value_or(0.0) != 0.0 || support.displacement[0].value_or(0.0) != 0.0 ||
                       support.displacement[1].value_or(0.0) != 0.0;
    if (moves && known && support_curve(step, i) >= 0) check_curve_of_support(checking, path, step, i, here);
    if (!moves || support_curve(step, i) >= 0 || step.support_factors[i] == here) continue;
    checking.error(path, "loads." + support.name,
                   fmt::format("support '{}' would jump at the begin of a step in time: let its factor follow a curve, "
                               "or bring it there in a step before",
                               support.name));
  }
}

/// What a model with steps in time cannot have.
void check_with_steps_in_time(Checking& checking) {
  const Model& model = checking.model;
  if (!is_dynamic(model) || model.analysis.type == AnalysisType::modal) return;
  std::size_t first = 0;
  while (!model.steps[first].dynamic) ++first;
  const auto refuse = [&](const Source& at, const std::string& path, std::string message) {
    checking.enter(at);
    checking.error(path, "", std::move(message));
  };
  for (std::size_t i = first; i < model.steps.size(); ++i)
    if (!model.steps[i].dynamic)
      refuse(model.steps[i].source, path_of("steps", model.steps[i].source, i),
             "is quasi-static and comes after a step in time: put it before, or make it a step in time of its own");
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    const std::string path = path_of("bodies", body.name, b);
    if (body.added >= static_cast<int>(first) && body.added > 0)
      refuse(body.source, path, "is added in a step in time: bodies come in the quasi-static steps before it");
    if (body.removed >= static_cast<int>(first))
      refuse(body.source, path, "is removed in a step in time: bodies go in the quasi-static steps before it");
    if (body.mesh.tolerance)
      refuse(body.source, path + ".mesh",
             "has a tolerance, for which steps in time are not repeated on finer meshes: "
             "give 'size', and halve it to compare");
  }
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const std::string path = path_of_joint("contacts", contact.source, contact.name, c);
    if (contact.large_slip)
      refuse(contact.source, path, "has large slip, which steps in time do not have: leave 'slip' out");
    if (contact.fit_in >= static_cast<int>(first))
      refuse(contact.source, path, "has its interference in a step in time: let it grow in a quasi-static step before");
  }
  if (model.tolerance || model.output.error || !model.output.error_of.empty())
    refuse(
        {}, model.tolerance ? "tolerance" : "output",
        "an error bar needs finer meshes, on which steps in time are not repeated: leave it out, and halve 'size' and "
        "'step' to compare");
  for (const HistoryItem& item : model.output.history)
    if (std::holds_alternative<EdgeResultant>(item.of))
      refuse(
          item.source, "output.history." + item.name,
          "is the sum over an edge, which steps in time do not have, as inertia acts there too: ask for a section, a "
          "contact or a reaction");
  if (model.output.discrete_problems)
    refuse({}, "output.discrete_problems", "is for quasi-static increments: leave it out with steps in time");
  if (model.solver.uniqueness)
    refuse({}, "solver.uniqueness", "is a question to quasi-static increments: leave it out with steps in time");
}

/// A run that ended in motion goes on in time.
void check_goes_on(Checking& checking) {
  const Model& model = checking.model;
  if (!model.restart || !model.restart->motion) return;
  for (std::size_t i = 0; i < model.steps.size(); ++i) {
    if (model.steps[i].dynamic) continue;
    checking.enter(model.steps[i].source);
    checking.error(path_of("steps", model.steps[i].source, i), "",
                   "is quasi-static, but the run that this one starts from ended in motion: make it a step in time, "
                   "'dynamic: {duration: ...}'");
  }
  for (std::size_t i = 0; i < model.initial.size(); ++i) {
    checking.enter(model.initial[i].source);
    checking.error(path_of("initial", model.initial[i].source, i), "",
                   "has no effect: bodies go on with the velocities at the end of the run that this one starts from");
  }
}

/// What the first step of a restart follows.
std::optional<Step> end_of_other_run(const Model& model) {
  if (!model.restart) return {};
  Step end;
  end.load_factors = model.restart->load_factors;
  end.support_factors = model.restart->support_factors;
  return end;
}

/// Where some step changes coefficients of friction.
void check_friction_of_step(Checking& checking, const std::string& path, const Step& step) {
  const Model& model = checking.model;
  if (step.friction.size() != model.contacts.size() || step.backward_friction.size() != step.friction.size() ||
      step.cohesion.size() != step.friction.size()) {
    checking.error(path, "friction", "must give a coefficient for every contact");
    return;
  }
  constexpr double largest = 1e6;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    if (!has_one_coefficient(model.contacts[c])) continue;
    const std::string key = "friction." + model.contacts[c].name;
    const auto check = [&](const std::string& of, double coefficient) {
      if (checking.not_negative(path, of, coefficient) && coefficient > largest)
        checking.error(path, of,
                       fmt::format("a coefficient of friction must be at most 1e6, not {}", number_text(coefficient)));
    };
    const bool directional = step.friction[c] != step.backward_friction[c] &&
                             !(std::isnan(step.friction[c]) && std::isnan(step.backward_friction[c]));
    check(directional ? key + ".forward" : key, step.friction[c]);
    if (directional) check(key + ".backward", step.backward_friction[c]);
  }
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

bool has_large_slip(const std::vector<Contact>& contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](const Contact& contact) { return contact.large_slip; });
}

bool has_one_coefficient(const Contact& contact) {
  return !contact.bond && !contact.shear_strength && !contact.dynamic_friction && contact.friction_along.empty();
}

std::vector<double> coefficients_of(const Step& step) {
  std::vector<double> coefficients = step.friction;
  coefficients.insert(coefficients.end(), step.backward_friction.begin(), step.backward_friction.end());
  coefficients.insert(coefficients.end(), step.cohesion.begin(), step.cohesion.end());
  return coefficients;
}

std::vector<double> corners_of(const Step& step, const std::vector<Curve>& curves) {
  std::vector<double> corners;
  if (step.dynamic) return corners;  // time steps are not equal parts of a load
  for (const std::vector<int>* of : {&step.load_curves, &step.support_curves})
    for (const int curve : *of)
      if (curve >= 0)
        for (const double corner : corners_of(curves[static_cast<std::size_t>(curve)])) corners.push_back(corner);
  std::sort(corners.begin(), corners.end());
  constexpr double rounding = 1e-9;
  corners.erase(std::unique(corners.begin(), corners.end(), [](double a, double b) { return b - a <= rounding; }),
                corners.end());
  return corners;
}

int expected_increments(const Step& step) {
  constexpr int growth_steps = 20;  // unless the user says how many
  if (step.growth) return step.growth->steps.value_or(growth_steps) + 1;
  if (step.limit) return static_cast<int>(std::ceil(2.0 - std::log2(step.limit->relative)));
  return step.automatic ? static_cast<int>(std::ceil(2.0 / step.automatic->largest)) : step.increments;
}

void check_steps(Checking& checking) {
  const Model& model = checking.model;
  check_curves(checking);
  if (model.restart && (model.restart->load_factors.size() != model.loads.size() ||
                        model.restart->support_factors.size() != model.supports.size())) {
    checking.enter(model.restart->source);
    checking.error("restart", "", "must have a factor for every load and support");
    checking.gaps.steps = true;
  }
  if (checking.gaps.steps) return;
  if (model.steps.empty() && model.analysis.type != AnalysisType::modal) {
    checking.enter({});
    checking.error("steps", "", "contains no step: give at least one");
    checking.gaps.steps = true;
  }
  const bool has_friction =
      std::any_of(model.steps.begin(), model.steps.end(), [](const Step& of) { return !of.friction.empty(); });
  const std::optional<Step> restarted = end_of_other_run(model);
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
        !check_factors(checking, path, step.support_factors, model.supports.size(), "supports")) {
      checking.gaps.steps = true;
      return;
    }
    const auto as_many = [](const std::vector<int>& curves, const std::vector<double>& of) {
      return curves.empty() || curves.size() == of.size();
    };
    if (!as_many(step.load_curves, step.load_factors) || !as_many(step.support_curves, step.support_factors)) {
      checking.error(path, "loads", "must have a curve or none for every factor");
      checking.gaps.steps = true;
      return;
    }
    const Step* const before = i > 0 ? &model.steps[i - 1] : restarted ? &*restarted : nullptr;
    check_records_of_supports(checking, path, step);
    if (step.dynamic)
      check_dynamic_step(checking, path, step, before);
    else
      check_beginnings(checking, path, step, before);
    if (has_friction && !checking.gaps.conditions) check_friction_of_step(checking, path, step);
  }
  check_with_steps_in_time(checking);
  check_goes_on(checking);
}

void check_initial(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.initial.size(); ++i) {
    const InitialVelocity& initial = model.initial[i];
    const std::string path = path_of("initial", initial.source, i);
    checking.enter(initial.source);
    if (!is_dynamic(model) && !checking.gaps.steps)
      checking.error(path, "", "has no effect: no step is one in time (steps: [{dynamic: {duration: ...}}])");
    checking.vector(path, "velocity", initial.velocity);
    checking.number(path, "rotation", initial.rotation);
    if (!checking.is_body(initial.body)) {
      if (!checking.gaps.bodies && !checking.gaps.places)
        checking.error(path, "on", "refers to a body that does not exist");
    } else if (checking.body(initial.body).outside) {
      checking.error(path, "on", "an unbounded body has no velocity as a whole");
    }
  }
}

void check_never_applied(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    if (std::any_of(model.steps.begin(), model.steps.end(),
                    [&](const Step& s) { return s.load_factors[i] != 0.0 || load_curve(s, i) >= 0; }) ||
        (model.restart && model.restart->load_factors.at(i) != 0.0))
      continue;
    checking.enter(load.source);
    checking.error_of_key(
        path_of_load(load, i), "",
        fmt::format("{} '{}' is never applied: name it in a step",
                    std::holds_alternative<AtRest>(load.kind) ? "the displacement at rest of springs" : "load",
                    load.name));
  }
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Support& support = model.supports[i];
    if (!checking.support[i]) continue;
    if (std::any_of(model.steps.begin(), model.steps.end(),
                    [&](const Step& s) { return s.support_factors[i] != 0.0 || support_curve(s, i) >= 0; }) ||
        (model.restart && model.restart->support_factors.at(i) != 0.0))
      continue;
    checking.enter(support.source);
    checking.error(path_of("supports", support.source, i), "",
                   fmt::format("the displacement of support '{}' is never applied: name it in a step", support.name));
  }
}

}  // namespace scabo::model
