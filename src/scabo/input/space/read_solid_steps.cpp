// `curves` and `steps` of models in space.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/curves.hpp"
#include "scabo/input/space/space_reader.hpp"
#include "scabo/input/suggestions.hpp"
#include "scabo/model/limits.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

void SpaceReader::curves(const Value& value) {
  constexpr double most_periods = 10'000.0;
  const std::size_t before = report_.count();
  for (const Entry& entry :
       read_named(report_, value, "curves", "{cycle: {table: [[0, 0], [1, 1], [3, -1], [4, 0]]}}")) {
    const MapReader map(report_, entry.value, {"table", "ramp", "sine"}, "{sine: {amplitude: 1, periods: 3}}",
                        only_in_the_plane({"record", "over"}));
    if (!map.is_map()) continue;
    if (int{map.has("table")} + int{map.has("ramp")} + int{map.has("sine")} != 1) {
      if (map.all_known()) report_.error(entry.value, "needs exactly one of table, ramp and sine");
      continue;
    }
    Curve curve{entry.key, CurveTable{{{0.0, 0.0}}}, entry.key_source};
    if (const auto kind = read_curve_kind(report_, map)) curve.kind = *kind;
    if (const auto* sine = std::get_if<CurveSine>(&curve.kind);
        sine && !(sine->periods > 0.0 && sine->periods <= most_periods))
      report_.error(entry.value, fmt::format("'periods' must be more than 0 and at most {:g}", most_periods));
    model_.curves.push_back(std::move(curve));
  }
  curves_known_ = report_.count() == before;
}

void SpaceReader::factor(const Entry& entry, Step& step) {
  std::vector<std::string> known;
  double* value = nullptr;
  int* curve = nullptr;
  for (std::size_t i = 0; i < model_.loads.size(); ++i) {
    known.push_back(model_.loads[i].name);
    if (known.back() == entry.key) value = &step.load_factors[i], curve = &step.load_curves[i];
  }
  for (std::size_t i = 0; i < model_.supports.size(); ++i) {
    if (!model_.supports[i].named) continue;
    known.push_back(model_.supports[i].name);
    if (known.back() == entry.key) value = &step.support_factors[i], curve = &step.support_curves[i];
  }
  if (value == nullptr)
    return report_.error(entry.key_source, fmt::format("there is no load or named support called {}{}",
                                                       quoted_name(entry.key), suggestion(entry.key, known)));
  const Node& node = *entry.value.node;
  if (node.kind != Node::Kind::scalar || node.unreadable || !is_name(node.text)) {
    *value = read_number(report_, entry.value).value_or(0.0);
    return;
  }
  known.clear();
  for (std::size_t i = 0; i < model_.curves.size(); ++i) {
    known.push_back(model_.curves[i].name);
    if (known.back() == node.text) *curve = static_cast<int>(i);
  }
  if (*curve < 0 && curves_known_)
    report_.error(entry.value, fmt::format("must be a number or the name of a curve, not {}{}", quoted_name(node.text),
                                           known.empty() ? "; the model has no curves" : suggestion(node.text, known)));
  if (*curve >= 0) *value = value_of(model_.curves[static_cast<std::size_t>(*curve)], 1.0);
}

void SpaceReader::friction(const Value& value, Step& step) {
  constexpr double largest = 1e6;
  const std::size_t before = report_.count();
  const std::vector<Contact> contacts = laws();
  read_friction_of_step(report_, value, contacts, true, step);
  if (report_.count() > before) return;
  for (const Entry& entry : read_named(report_, value, "coefficients", "{joint: 0.3}")) {
    const auto found =
        std::find_if(contacts.begin(), contacts.end(), [&](const Contact& of) { return of.name == entry.key; });
    const auto c = static_cast<std::size_t>(found - contacts.begin());
    if (model_.contacts[c].friction_axes)
      report_.error(entry.value,
                    "the friction of this contact differs along two directions and stays as it is: leave it out");
    else if (entry.value.node->kind == Node::Kind::map)
      report_.error(entry.value, "must be a number: in space friction does not depend on the direction of slip");
    else if (!(step.friction[c] >= 0.0 && step.friction[c] <= largest))
      report_.error(entry.value,
                    fmt::format("a coefficient of friction must be from 0 to 1e6, not {}", entry.value.node->text));
  }
}

/// Of all contacts; those of ties have no name.
std::vector<Contact> SpaceReader::laws() const {
  std::vector<Contact> laws;
  for (const SpaceContact& contact : model_.contacts) laws.push_back(contact.law);
  return laws;
}

/// The step that follows one that ends with the factors of `before`.
Step SpaceReader::step(const Value& value, const Step& before, std::size_t number) {
  const MapReader map(report_, value, {"name", "increments", "loads", "friction", "cycles"},
                      "{name: press, increments: 10}", only_in_the_plane({"dynamic", "growth", "limit", "reduce"}));
  Step step;
  step.load_factors = before.load_factors;
  step.support_factors = before.support_factors;
  step.load_curves.assign(step.load_factors.size(), -1);
  step.support_curves.assign(step.support_factors.size(), -1);
  step.name = fmt::format("step_{}", number);
  step.source = value.source();
  if (!map.is_map()) return step;
  if (const auto name = map.get("name")) {
    const auto text = read_text(report_, *name);
    if (text && check_name(report_, name->source(), *text)) step.name = *text;
  }
  if (const auto increments = map.get("increments"))
    step.increments = static_cast<int>(read_integer(report_, *increments, limits::increments).value_or(1));
  step.friction = before.friction;
  step.backward_friction = before.backward_friction;
  step.cohesion = before.cohesion;
  if (const auto friction = map.get("friction")) this->friction(*friction, step);
  if (const auto loads = map.get("loads")) {
    for (std::size_t i = 0; i < model_.supports.size(); ++i)
      if (!model_.supports[i].named) step.support_factors[i] = 1.0;
    for (const Entry& entry : read_named(report_, *loads, "factors", "{tip: 1.0}")) factor(entry, step);
    divide_at_corners(model_.curves, step);
  } else if (number == 1 || (!map.has("friction") && !has_stage(step.name))) {  // else they stay as they are
    std::fill(step.load_factors.begin(), step.load_factors.end(), 1.0);
    std::fill(step.support_factors.begin(), step.support_factors.end(), 1.0);
  }
  return step;
}

void SpaceReader::steps(const std::optional<Value>& value) {
  const auto items =
      value ? read_list(report_, *value, "[{name: press, increments: 10}]") : std::optional(std::vector<Value>{});
  Step last;
  last.load_factors.assign(model_.loads.size(), 0.0);
  last.support_factors.assign(model_.supports.size(), 0.0);
  if (model_.restart) {
    last.load_factors = model_.restart->load_factors;
    last.support_factors = model_.restart->support_factors;
  }
  for (const Value& item : items.value_or(std::vector<Value>{})) {
    last = step(item, last, model_.steps.size() + 1);
    const bool follows =
        std::any_of(last.load_curves.begin(), last.load_curves.end(), [](int c) { return c >= 0; }) ||
        std::any_of(last.support_curves.begin(), last.support_curves.end(), [](int c) { return c >= 0; });
    if (!follows) last.load_curves.clear(), last.support_curves.clear();
    const long cycles = read_cycles(report_, item, last);
    for (long k = 1; k <= cycles; ++k) {
      Step copy = last;
      if (cycles > 1) copy.name = fmt::format("{}_{}", last.name, k);
      for (const Step& other : model_.steps)
        if (other.name == copy.name) report_.error(item, fmt::format("two steps are called '{}'", copy.name));
      model_.steps.push_back(std::move(copy));
    }
  }
  // A coefficient that a later step changes is, before it, that of the contact.
  if (std::any_of(model_.steps.begin(), model_.steps.end(), [](const Step& of) { return !of.friction.empty(); }))
    for (Step& of : model_.steps)
      if (of.friction.empty()) add_coefficients(laws(), of);
  if (!model_.steps.empty() || !items) return;
  last.name = "step_1";
  std::fill(last.load_factors.begin(), last.load_factors.end(), 1.0);
  std::fill(last.support_factors.begin(), last.support_factors.end(), 1.0);
  model_.steps.push_back(last);
}

/// Its index; -1 after a mistake.
int SpaceReader::step_named(const Value& value) const {
  std::vector<std::string> known;
  for (const Step& step : model_.steps) known.push_back(step.name);
  const auto text = read_text(report_, value);
  if (!text) return -1;
  const auto found = std::find(known.begin(), known.end(), *text);
  if (found != known.end()) return static_cast<int>(found - known.begin());
  report_.error(value, fmt::format("there is no step named {}{}", quoted_name(*text), suggestion(*text, known)));
  return -1;
}

void SpaceReader::find_fits() {
  for (const auto& [contact, value] : fits_) model_.contacts[contact].fit_in = step_named(value);
}

void SpaceReader::find_tightened() {
  for (const auto& [body, value] : tightened_) {
    auto& preload = model_.bodies[body].preload;
    if (preload && preload->step < 0)
      report_.error(value, tightened_already("bolt", model_.bodies[body].name, *end_));
    else if (const int step = step_named(value); step >= 0 && preload)
      preload->step = step;
  }
  for (const auto& [bar, value] : tightened_bars_)
    if (model_.bars[bar].tightened < 0)
      report_.error(value, tightened_already("bar", model_.bars[bar].name, *end_));
    else
      model_.bars[bar].tightened = step_named(value);
}

}  // namespace scabo::input
