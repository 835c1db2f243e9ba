// `steps`: the factors of loads and prescribed displacements at the end of every step.
//
// A step without `loads` takes everything to factor 1. A step with `loads` takes the named loads to the given factors
// and leaves the others at their values of the previous step (0 before the first step). Prescribed displacements
// without a name of their own go to 1 in the first step.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/numbers.hpp"
#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr std::size_t most_factors = 20'000'000;

bool is_fixed(const Support& support) {
  return support.rotation.value_or(0.0) == 0.0 &&
         std::all_of(support.displacement.begin(), support.displacement.end(),
                     [](const std::optional<double>& u) { return !u || *u == 0.0; });
}

/// Factors before the first step: nothing is applied yet.
Step start(const Reading& reading) {
  Step step;
  step.load_factors.assign(reading.model.loads.size(), 0.0);
  step.support_factors.assign(reading.model.supports.size(), 0.0);
  return step;
}

void apply_everything(Step& step) {
  std::fill(step.load_factors.begin(), step.load_factors.end(), 1.0);
  std::fill(step.support_factors.begin(), step.support_factors.end(), 1.0);
}

/// Takes one load or support to `factor`; reports an unknown name.
void set_factor(Reading& reading, const Index& supports, Step& step, const MapEntry& entry, const Value& value,
                const Source& at) {
  const auto factor = read_number(reading.report, value);
  const auto load = reading.index_of_load.find(entry.key);
  if (load != reading.index_of_load.end() && load->second >= 0) {
    if (factor) step.load_factors[static_cast<std::size_t>(load->second)] = *factor;
    return;
  }
  if (const auto found = supports.find(entry.key); found != supports.end()) {
    const auto i = static_cast<std::size_t>(found->second);
    if (is_fixed(reading.model.supports[i])) {
      reading.report.error(at,
                           fmt::format("support '{}' is fixed, so that a factor has no effect: remove it", entry.key));
    } else if (factor) {
      step.support_factors[i] = *factor;
    }
    return;
  }
  const bool broken = load != reading.index_of_load.end() || reading.own_support_names.contains(entry.key);
  if (broken) return;
  if (reading.report.full()) {
    reading.report.error(at, "");  // counted
    return;
  }
  std::vector<std::string> known = reading.load_names;
  known.insert(known.end(), reading.own_support_names.begin(), reading.own_support_names.end());
  reading.report.error(at, fmt::format("there is no load or named support called {}{}", quoted_name(entry.key),
                                       suggestion(entry.key, known)));
}

void read_factors(Reading& reading, const Index& supports, Step& step, const Value& value) {
  if (value.node->kind != Node::Kind::map) {
    reading.report.error(value,
                         fmt::format("must be a map of factors, as in {{tip: 1.0}}, not {}", describe(*value.node)));
    return;
  }
  for (const MapEntry& entry : value.node->entries) {
    const Value factor{entry.value, value.path + "." + entry.key};
    Source at = factor.source();
    if (at.line > 0) at = {entry.line, entry.column, factor.path};
    set_factor(reading, supports, step, entry, factor, at);
  }
}

/// `increments: 10`, `increments: auto`, or `increments: {largest: 0.1}`.
void read_increments(Reading& reading, const Value& value, Step& step) {
  const bool is_map = value.node->kind == Node::Kind::map;
  if (!is_map && value.node->kind == Node::Kind::scalar && value.node->text == "auto") {
    step.automatic.emplace();
    return;
  }
  if (!is_map) {
    if (value.node->kind != Node::Kind::scalar || std::holds_alternative<std::string>(parse_number(value.node->text))) {
      reading.report.error(value, fmt::format("must be a whole number, auto, or limits of the size of an increment, as "
                                              "in {{largest: 0.1}}, not {}",
                                              describe(*value.node)));
      return;
    }
    step.increments = static_cast<int>(read_integer(reading.report, value, limits::increments).value_or(1));
    return;
  }
  const MapReader map(reading.report, value, {"first", "largest", "smallest"}, "{largest: 0.25, smallest: 1e-4}");
  AutomaticIncrements automatic;
  const auto read = [&](const char* key, double& to) {
    if (const auto given = map.get(key)) to = read_number(reading.report, *given).value_or(unread);
  };
  read("largest", automatic.largest);
  read("smallest", automatic.smallest);
  if (automatic.largest >= limits::smallest_increment) {  // a mistake is told once, not of what follows from it
    if (!map.has("smallest")) automatic.smallest = std::min(automatic.smallest, automatic.largest);
    if (!map.has("first")) automatic.first = std::min(std::max(automatic.first, automatic.smallest), automatic.largest);
  }
  read("first", automatic.first);
  step.automatic = automatic;
}

/// The step that follows one that ends with the factors of `before`.
Step read_step(Reading& reading, const Index& supports, const Value& value, const Step& before, std::size_t number) {
  const MapReader map(reading.report, value, {"name", "increments", "loads"},
                      "{name: press, increments: 10, loads: {tip: 1.0}}");
  Step step = before;
  step.name = fmt::format("step_{}", number);
  step.increments = 1;
  step.automatic.reset();
  step.source = value.source();
  if (const auto name = map.get("name")) {
    const auto text = read_text(reading.report, *name);
    if (text && check_name(reading.report, name->source(), *text)) step.name = *text;
  }
  if (const auto increments = map.get("increments")) read_increments(reading, *increments, step);
  const auto loads = map.get("loads");
  if (!loads) {
    apply_everything(step);
    return step;
  }
  for (std::size_t i = 0; number == 1 && i < step.support_factors.size(); ++i) {
    if (!reading.support_is_named[i]) step.support_factors[i] = 1.0;
  }
  read_factors(reading, supports, step, *loads);
  return step;
}

}  // namespace

void read_steps(Reading& reading, const std::optional<Value>& value) {
  Step step = start(reading);
  // A fixed support is the same at any factor.
  for (std::size_t i = 0; i < step.support_factors.size(); ++i) {
    if (is_fixed(reading.model.supports[i])) step.support_factors[i] = 1.0;
  }
  const auto items = value ? read_list(reading.report, *value, "[{name: press, increments: 10}]")
                           : std::optional(std::vector<Value>{});
  if (!items) return;
  if (items->empty()) {
    step.name = "step_1";
    step.source = value ? value->source() : Source{};
    apply_everything(step);
    reading.model.steps.push_back(step);
    return;
  }
  const std::size_t factors = reading.model.loads.size() + reading.model.supports.size();
  if (factors * items->size() > most_factors) {
    reading.report.error(*value, fmt::format("{} steps of {} loads and supports need more than the {} factors that can "
                                             "be stored: use fewer steps, or combine loads",
                                             items->size(), factors, most_factors));
    return;
  }
  Index supports;  // those with a name given by the user
  for (std::size_t i = 0; i < reading.model.supports.size(); ++i)
    if (reading.support_is_named[i]) supports.emplace(reading.model.supports[i].name, static_cast<int>(i));
  for (std::size_t i = 0; i < items->size(); ++i) {
    step = read_step(reading, supports, (*items)[i], step, i + 1);
    reading.model.steps.push_back(step);
  }
}

}  // namespace scabo::input
