// Steps that are referred to by their names: `added` and `removed` of bodies and supports, in which they are put in
// place and taken away, and `fit_in` of contacts, over which an interference grows.
#include <fmt/format.h>

#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

/// Steps by their names, the first of each name.
class NamedSteps {
 public:
  explicit NamedSteps(Reading& reading) : reading_(reading) {
    for (std::size_t i = 0; i < reading.model.steps.size(); ++i)
      numbers_.emplace(reading.model.steps[i].name, static_cast<int>(i));
  }

  /// The step that a value names; nothing if there is none.
  std::optional<int> operator()(const Value& value) const {
    const auto name = read_text(reading_.report, value);
    if (!name || !reading_.steps_known) return {};
    if (const auto found = numbers_.find(*name); found != numbers_.end()) return found->second;
    std::vector<std::string> known;
    for (const Step& step : reading_.model.steps)
      if (known.size() < 1000) known.push_back(step.name);
    reading_.report.error(value,
                          fmt::format("there is no step named {}{}", quoted_name(*name), suggestion(*name, known)));
    return {};
  }

 private:
  Reading& reading_;
  Index numbers_;
};

}  // namespace

std::optional<std::vector<BodyState>> read_stages(Reading& reading, const MapReader& map, const BodyState& state,
                                                  std::size_t copies, std::size_t rows) {
  std::vector<BodyState> states(std::max<std::size_t>(copies, 1), state);
  for (const char* key : {"added", "removed"}) {
    const auto value = map.get(key);
    if (!value) continue;
    const auto member = key == std::string_view("added") ? &BodyState::added : &BodyState::removed;
    if (value->node->kind != Node::Kind::sequence) {
      for (BodyState& of : states) of.*member = value;
      continue;
    }
    const std::size_t expected = rows > 0 ? rows : copies;
    const auto items = read_list(reading.report, *value, "[lift_1, lift_2]");
    if (!items) return {};
    if (expected == 0 || items->size() != expected) {
      reading.report.error(*value, expected == 0 ? std::string("must be the name of a step: only a body with 'repeat' "
                                                               "has a list, one step for each copy")
                                                 : fmt::format("gives {} steps for {} {}: one for each is needed",
                                                               items->size(), expected, rows > 0 ? "rows" : "copies"));
      return {};
    }
    const std::size_t of_each = states.size() / expected;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Value& item = (*items)[i / of_each];
      if (item.node->kind != Node::Kind::null) states[i].*member = item;
    }
  }
  return states;
}

void find_named_steps(Reading& reading) {
  const NamedSteps step_named(reading);
  for (std::size_t b = 0; b < reading.model.bodies.size(); ++b) {
    Body& body = reading.model.bodies[b];
    if (const auto& added = reading.bodies[b].added) body.added = step_named(*added).value_or(0);
    if (const auto& removed = reading.bodies[b].removed) body.removed = step_named(*removed).value_or(-1);
  }
  for (std::size_t i = 0; i < reading.model.supports.size(); ++i) {
    Support& support = reading.model.supports[i];
    if (const auto& added = reading.stages_of_supports[i].added) support.added = step_named(*added).value_or(0);
    if (const auto& removed = reading.stages_of_supports[i].removed)
      support.removed = step_named(*removed).value_or(-1);
  }
  for (const auto& [bar, name] : reading.steps_of_bars)
    reading.model.bars[bar].tightened = step_named(name).value_or(0);
  for (const auto& [entry, name] : reading.fits_of_contacts) {
    const int step = step_named(name).value_or(-1);
    for (const int contact : reading.contacts_of_entry[entry])
      reading.model.contacts[static_cast<std::size_t>(contact)].fit_in = step;
  }
}

}  // namespace scabo::input
