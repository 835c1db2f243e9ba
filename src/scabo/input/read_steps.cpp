// `steps`: the factors of loads and prescribed displacements at the end of every step.
// A factor may follow one of the `curves` within its step.
//
// A step without `loads` takes everything to factor 1. A step with `loads` takes the named loads to the given factors
// and leaves the others at their values of the previous step (0 before the first step). Prescribed displacements
// without a name of their own go to 1 in the first step.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "scabo/input/curves.hpp"
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
  if (const auto& restart = reading.model.restart) {
    step.load_factors = restart->load_factors;
    step.support_factors = restart->support_factors;
  }
  return step;
}

void apply_everything(Step& step) {
  std::fill(step.load_factors.begin(), step.load_factors.end(), 1.0);
  std::fill(step.support_factors.begin(), step.support_factors.end(), 1.0);
}

constexpr int no_curve = -1;

/// A number, or the curve that the factor follows and its value at the end.
struct Factor {
  double value = 0.0;
  int curve = no_curve;
};

/// The piece of a curve over several steps that belongs to `step`, as a curve of its own; reports if there is none.
std::optional<int> piece_for(Reading& reading, int curve, CurveOver& over, const Step& step, const Value& value) {
  const Curve whole = reading.model.curves[static_cast<std::size_t>(curve)];
  // A sine that is wrong is reported once, as a whole.
  const auto* sine = std::get_if<CurveSine>(&whole.kind);
  const bool wrong = sine && !(sine->periods > 0.0 && sine->periods <= 10'000.0);
  const auto found = over.number.find(step.name);
  if (found == over.number.end()) {
    reading.report.error(value, fmt::format("curve '{}' does not run over step '{}': name the step in its 'over'",
                                            whole.name, step.name));
    return {};
  }
  const auto number = static_cast<std::size_t>(found->second);
  CurveOver::Part& part = over.parts[number];
  if (wrong) part.piece = curve;
  if (part.piece >= 0) return part.piece;
  Curve piece = piece_of(whole, number > 0 ? over.parts[number - 1].end : 0.0, part.end);
  piece.name = fmt::format("{}_{}", whole.name, step.name);
  while (reading.index_of_curve.contains(piece.name)) piece.name += "_";
  part.piece = static_cast<int>(reading.model.curves.size());
  reading.model.curves.push_back(std::move(piece));
  return part.piece;
}

/// Index of the curve with this name; nothing if there is none, which is reported.
std::optional<int> read_curve_name(Reading& reading, const Value& value) {
  const std::string& name = value.node->text;
  const auto found = reading.index_of_curve.find(name);
  if (found != reading.index_of_curve.end()) return found->second;
  if (!reading.curves_known) return {};
  std::vector<std::string> known;
  for (const Curve& curve : reading.model.curves) known.push_back(curve.name);
  reading.report.error(value, fmt::format("must be a number or the name of a curve, not {}{}", quoted_name(name),
                                          known.empty() ? "; the model has no curves" : suggestion(name, known)));
  return {};
}

std::optional<Factor> read_factor(Reading& reading, const Step& step, const Value& value) {
  const Node& node = *value.node;
  const bool word = node.kind == Node::Kind::scalar && !node.unreadable && model::is_name(node.text);
  if (!word) {
    const auto number = read_number(reading.report, value);
    return number ? std::optional(Factor{*number, no_curve}) : std::nullopt;
  }
  const auto found = read_curve_name(reading, value);
  if (!found) return {};
  int curve = *found;
  const auto over = reading.curves_over.find(curve);
  if (step.dynamic) {
    if (over == reading.curves_over.end())
      return Factor{value_at(reading.model.curves[static_cast<std::size_t>(curve)], step.dynamic->duration,
                             step.dynamic->duration),
                    curve};
    reading.report.error(value,
                         "runs over several steps, which a curve in a step in time cannot: its table is in "
                         "seconds from the begin of its step");
    return {};
  }
  if (over != reading.curves_over.end()) {
    const auto piece = piece_for(reading, curve, over->second, step, value);
    if (!piece) return {};
    curve = *piece;
  }
  return Factor{value_of(reading.model.curves[static_cast<std::size_t>(curve)], 1.0), curve};
}

/// Takes one load or support to a factor; reports an unknown name.
void set_factor(Reading& reading, const Index& supports, Step& step, const MapEntry& entry, const Value& value,
                const Source& at) {
  const auto factor = read_factor(reading, step, value);
  const auto load = reading.index_of_load.find(entry.key);
  if (load != reading.index_of_load.end() && load->second >= 0) {
    const auto i = static_cast<std::size_t>(load->second);
    if (!factor) return;
    step.load_factors[i] = factor->value;
    if (factor->curve == no_curve) return;
    step.load_curves.resize(step.load_factors.size(), no_curve);
    step.load_curves[i] = factor->curve;
    return;
  }
  if (const auto found = supports.find(entry.key); found != supports.end()) {
    const Curve* const curve =
        factor && factor->curve != no_curve ? &reading.model.curves[static_cast<std::size_t>(factor->curve)] : nullptr;
    const auto i = static_cast<std::size_t>(found->second);
    if (is_fixed(reading.model.supports[i])) {
      reading.report.error(at,
                           fmt::format("support '{}' is fixed, so that a factor has no effect: remove it", entry.key));
    } else if (factor) {
      const bool by_record = curve && curve->record && step.dynamic;
      step.support_factors[i] =
          by_record ? displacement_at(*curve, step.dynamic->duration, step.dynamic->duration) : factor->value;
      if (!curve) return;
      step.support_curves.resize(step.support_factors.size(), no_curve);
      step.support_curves[i] = factor->curve;
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
  if (value.node->unreadable) return;
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

/// `dynamic: {duration: 10, step: 0.005, ground: {x: quake}}`.
void read_dynamic(Reading& reading, const Value& value, Step& step) {
  const MapReader map(reading.report, value, {"duration", "step", "ground"}, "{duration: 10, step: 0.005}");
  DynamicStep dynamic;
  dynamic.duration = number_or_unread(reading, map.need("duration"));
  if (const auto given = map.get("step")) dynamic.step = number_or_unread(reading, given);
  if (const auto ground = map.get("ground")) {
    const MapReader components(reading.report, *ground, {"x", "y"}, "{x: quake}");
    constexpr const char* names[2] = {"x", "y"};
    for (std::size_t k = 0; k < 2; ++k)
      if (const auto curve = components.get(names[k])) {
        if (curve->node->kind != Node::Kind::scalar)
          reading.report.error(*curve, "must be the name of a curve: the acceleration of the ground");
        else
          dynamic.ground[k] = read_curve_name(reading, *curve).value_or(no_curve);
      }
  }
  constexpr int times_of_results = 100;  // unless the user says how many
  step.increments = times_of_results;
  step.dynamic = dynamic;
}

/// Whether a body or support is put in place or taken away, or a bar tightened, in the step of this name.
bool has_stage(const Reading& reading, const std::string& step) {
  const auto named = [&](const std::optional<Value>& value) { return value && value->node->text == step; };
  const auto begins_or_ends = [&](const auto& of) { return named(of.added) || named(of.removed); };
  return std::any_of(reading.bodies.begin(), reading.bodies.end(), begins_or_ends) ||
         std::any_of(reading.stages_of_supports.begin(), reading.stages_of_supports.end(), begins_or_ends) ||
         std::any_of(reading.steps_of_bars.begin(), reading.steps_of_bars.end(),
                     [&](const auto& of) { return of.second.node->text == step; });
}

void read_loads_of_step(Reading& reading, const Index& supports, const MapReader& map, Step& step, std::size_t number) {
  const auto loads = map.get("loads");
  if (!loads && number > 1 && (map.has("friction") || has_stage(reading, step.name))) return;  // they stay as they are
  if (!loads) {
    apply_everything(step);
    return;
  }
  for (std::size_t i = 0; number == 1 && i < step.support_factors.size(); ++i) {
    if (!reading.support_is_named[i]) step.support_factors[i] = 1.0;
  }
  read_factors(reading, supports, step, *loads);
  divide_at_corners(reading.model.curves, step);
}

/// The step that follows one that ends with the factors of `before`.
Step read_step(Reading& reading, const Index& supports, const Value& value, const Step& before, std::size_t number) {
  const MapReader map(reading.report, value,
                      {"name", "dynamic", "growth", "limit", "reduce", "increments", "loads", "friction", "cycles"},
                      "{name: press, increments: 10, loads: {tip: 1.0}}");
  Step step = before;
  step.name = fmt::format("step_{}", number);
  step.increments = 1;
  step.automatic.reset();
  step.dynamic.reset();
  step.growth.reset();
  step.limit.reset();
  step.ends.clear();
  step.load_curves.clear();
  step.support_curves.clear();
  step.source = value.source();
  if (const auto name = map.get("name")) {
    const auto text = read_text(reading.report, *name);
    if (text && check_name(reading.report, name->source(), *text)) step.name = *text;
  }
  if (const auto dynamic = map.get("dynamic"))
    read_dynamic(reading, *dynamic, step);
  else if (reading.all_dynamic)
    reading.report.error(
        value, "needs 'dynamic', as in dynamic: {duration: 10}: every step of a dynamic analysis is one in time");
  if (read_limit(reading, map, step)) return step;
  if (const auto increments = map.get("increments")) read_increments(reading, *increments, step);
  if (const auto friction = map.get("friction"))
    read_friction_of_step(reading.report, *friction, reading.model.contacts, reading.conditions_known, step);
  read_loads_of_step(reading, supports, map, step, number);
  if (const auto growth = map.get("growth")) read_growth(reading, *growth, supports, before, step);
  return step;
}

void tell_of_unused_curves(Reading& reading) {
  std::vector<bool> used(reading.model.curves.size(), false);
  for (const Step& step : reading.model.steps)
    for (const std::vector<int>* of : {&step.load_curves, &step.support_curves})
      for (const int curve : *of)
        if (curve >= 0) used[static_cast<std::size_t>(curve)] = true;
  for (const Step& step : reading.model.steps)
    if (step.dynamic)
      for (const int curve : step.dynamic->ground)
        if (curve >= 0) used[static_cast<std::size_t>(curve)] = true;
  for (std::size_t c = 0; c < used.size(); ++c)
    if (!used[c] && !reading.curves_over.contains(static_cast<int>(c)))
      reading.model.warnings.push_back(
          {WarningKind::input, "curves." + reading.model.curves[c].name,
           fmt::format("curve '{}' has no effect: no step uses it", reading.model.curves[c].name)});
}

/// The steps of a curve that runs over several of them exist, follow each other, and use it. `names`: of all steps as
/// written, with how often they run.
void check_curves_over(Reading& reading, const std::vector<std::pair<std::string, long>>& names) {
  std::vector<std::string> known;
  std::unordered_map<std::string, std::size_t> numbers;
  for (const auto& [name, cycles] : names) {
    numbers.emplace(name, known.size());
    known.push_back(name);
  }
  for (const auto& [curve, over] : reading.curves_over) {
    const std::string& of = reading.model.curves[static_cast<std::size_t>(curve)].name;
    std::optional<std::size_t> before;
    for (const CurveOver::Part& part : over.parts) {
      const auto found = numbers.find(part.step);
      const std::size_t index = found == numbers.end() ? known.size() : found->second;
      std::string wrong;
      if (found == numbers.end())
        wrong = fmt::format("there is no step named {}{}", quoted_name(part.step), suggestion(part.step, known));
      else if (names[index].second > 1)
        wrong = fmt::format("step '{}' is run in cycles, and a curve over several steps runs once: leave out 'cycles'",
                            part.step);
      else if (before && index != *before + 1)
        wrong = fmt::format("step '{}' does not follow step '{}': name all steps from the first to the last, in order",
                            part.step, known[*before]);
      else if (part.piece < 0)
        wrong = fmt::format("no factor follows curve '{}' in step '{}': name the curve in the 'loads' of the step", of,
                            part.step);
      if (!wrong.empty()) {
        reading.report.error(part.source, wrong);
        break;
      }
      before = index;
    }
  }
}

}  // namespace

void divide_at_corners(const std::vector<Curve>& curves, Step& step) {
  const std::vector<double> corners = corners_of(step, curves);
  if (step.automatic || step.dynamic || corners.empty()) return;
  std::vector<double> ends = corners;
  for (int k = 1; k <= step.increments; ++k) ends.push_back(static_cast<double>(k) / step.increments);
  std::sort(ends.begin(), ends.end());
  constexpr double rounding = 1e-9;
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a <= rounding; }), ends.end());
  ends.back() = 1.0;
  if (static_cast<int>(ends.size()) == step.increments) return;
  step.increments = static_cast<int>(ends.size());
  step.ends = std::move(ends);
}

long read_cycles(Report& report, const Value& value, const Step& step) {
  if (value.node->kind != Node::Kind::map) return 1;
  const MapEntry* entry = value.node->find("cycles");
  if (entry == nullptr || entry->value->kind == Node::Kind::null) return 1;
  const Value cycles{entry->value, value.path + ".cycles"};
  const long count = read_integer(report, cycles, limits::cycles).value_or(1);
  if (count > 1 && !step.dynamic && step.load_curves.empty() && step.support_curves.empty()) {
    report.error(cycles,
                 "repeats a step in which no factor follows a curve, so that nothing would change: give "
                 "'loads' a curve that ends where it begins");
    return 1;
  }
  return count;
}

void read_friction_of_step(Report& report, const Value& value, const std::vector<Contact>& contacts, bool all_known,
                           Step& step) {
  if (step.friction.empty()) add_coefficients(contacts, step);
  std::vector<std::string> known;
  for (const Contact& contact : contacts) known.push_back(contact.name);
  for (const Entry& entry : read_named(report, value, "coefficients", "{joint: 0.3}")) {
    const auto coefficients = read_coefficients(report, entry.value);
    const auto found = std::find(known.begin(), known.end(), entry.key);
    if (found == known.end()) {
      if (all_known)
        report.error(entry.key_source, fmt::format("there is no contact named {}{}", quoted_name(entry.key),
                                                   suggestion(entry.key, known)));
      continue;
    }
    const auto c = static_cast<std::size_t>(found - known.begin());
    if (!has_one_coefficient(contacts[c]))
      report.error(entry.key_source,
                   fmt::format("contact '{}' has no single coefficient of friction that a step could change: "
                               "give it 'friction' as one number, or as one for each direction",
                               entry.key));
    else if (coefficients)
      std::tie(step.friction[c], step.backward_friction[c]) = *coefficients;
  }
}

void add_coefficients(const std::vector<Contact>& contacts, Step& step) {
  for (const Contact& contact : contacts) {
    step.friction.push_back(contact.friction);
    step.backward_friction.push_back(contact.backward_friction.value_or(contact.friction));
    step.cohesion.push_back(contact.lasting_cohesion);
  }
}

void read_steps(Reading& reading, const std::optional<Value>& value) {
  const std::size_t before = reading.report.count();
  Step step = start(reading);
  // A fixed support is the same at any factor.
  for (std::size_t i = 0; i < step.support_factors.size(); ++i) {
    if (is_fixed(reading.model.supports[i])) step.support_factors[i] = 1.0;
  }
  const auto items = value ? read_list(reading.report, *value, "[{name: press, increments: 10}]")
                           : std::optional(std::vector<Value>{});
  if (!items) return;
  if (items->empty() && reading.all_dynamic) {
    reading.report.error(Source{0, 0, "steps"},
                         "is missing: a dynamic analysis needs steps with 'dynamic: {duration: ...}'");
    return;
  }
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
  std::vector<std::pair<std::string, long>> names;
  for (std::size_t i = 0; i < items->size(); ++i) {
    step = read_step(reading, supports, (*items)[i], step, i + 1);
    const long cycles = read_cycles(reading.report, (*items)[i], step);
    names.emplace_back(step.name, cycles);
    if (factors * (reading.model.steps.size() + static_cast<std::size_t>(cycles)) > most_factors) {
      reading.report.error((*items)[i],
                           "needs more factors of loads and supports than can be stored: use fewer cycles");
      return;
    }
    for (long k = 1; k <= cycles; ++k) {
      Step copy = step;
      if (cycles > 1) copy.name = fmt::format("{}_{}", step.name, k);
      reading.model.steps.push_back(std::move(copy));
    }
  }
  tell_of_unused_curves(reading);
  if (reading.report.count() == before) check_curves_over(reading, names);
  // A coefficient that a later step changes is, before it, that of the contact.
  const auto& steps = reading.model.steps;
  if (std::none_of(steps.begin(), steps.end(), [](const Step& of) { return !of.friction.empty(); })) return;
  for (Step& of : reading.model.steps)
    if (of.friction.empty()) add_coefficients(reading.model.contacts, of);
}

}  // namespace scabo::input
