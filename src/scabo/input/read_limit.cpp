// `limit` and `reduce` of a step: what its factor multiplies or divides, from the factors of the step before.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

/// One for each of `known`: whether it is named, in `push` or `[push, lift]`.
std::vector<char> read_which(Reading& reading, const std::optional<Value>& value, const std::vector<std::string>& known,
                             const char* what) {
  std::vector<char> which(known.size(), 0);
  if (!value) return which;
  std::vector<Value> items{*value};
  if (value->node->kind == Node::Kind::sequence)
    items = read_list(reading.report, *value, "[push]").value_or(std::vector<Value>{});
  for (const Value& item : items) {
    const auto name = read_text(reading.report, item);
    if (!name) continue;
    const auto found = std::find(known.begin(), known.end(), *name);
    if (found != known.end())
      which[static_cast<std::size_t>(found - known.begin())] = 1;
    else if (reading.conditions_known)
      reading.report.error(
          item, fmt::format("there is no {} named {}{}", what, quoted_name(*name), suggestion(*name, known)));
  }
  return which;
}

template <typename Things>
std::vector<std::string> names_of(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

/// The factor of these loads grows, by 1 to part 1.
void grow_loads(Step& step) {
  for (std::size_t i = 0; i < step.load_factors.size(); ++i) step.load_factors[i] += step.limit->loads[i];
}

/// Coefficients and cohesions of these contacts fall, to 0 at part 1.
void reduce_strength(Reading& reading, const Value& value, Step& step) {
  const std::vector<Contact>& contacts = reading.model.contacts;
  if (step.friction.empty()) add_coefficients(contacts, step);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!step.limit->friction[c] && !step.limit->cohesion[c]) continue;
    if (!has_one_coefficient(contacts[c]))
      reading.report.error(
          value, fmt::format("contact '{}' has no single coefficient of friction: its strength cannot be reduced",
                             contacts[c].name));
    if (step.limit->friction[c]) step.friction[c] = step.backward_friction[c] = 0.0;
    if (step.limit->cohesion[c]) step.cohesion[c] = 0.0;
  }
}

}  // namespace

bool read_limit(Reading& reading, const MapReader& step_map, Step& step) {
  const auto limit = step_map.get("limit"), reduce = step_map.get("reduce");
  if (!limit && !reduce) return false;
  if (limit && reduce) reading.report.error(*reduce, "does not go with 'limit': the loads grow, or the strength falls");
  const auto map = limit ? MapReader(reading.report, *limit, {"of", "relative"}, "{of: push, relative: 1e-3}")
                         : MapReader(reading.report, *reduce, {"friction", "cohesion", "relative"},
                                     "{friction: [base], cohesion: [base], relative: 1e-3}");
  const auto cohesion = limit ? std::nullopt : map.get("cohesion");
  const auto friction = limit ? std::nullopt : cohesion ? map.get("friction") : map.need("friction");
  LimitStep& found = step.limit.emplace();
  found.loads = read_which(reading, limit ? map.need("of") : std::nullopt, names_of(reading.model.loads), "load");
  found.friction = read_which(reading, friction, names_of(reading.model.contacts), "contact");
  found.cohesion = read_which(reading, cohesion, names_of(reading.model.contacts), "contact");
  if (const auto relative = map.get("relative")) found.relative = number_or_unread(reading, relative);
  if (limit)
    grow_loads(step);
  else
    reduce_strength(reading, *reduce, step);
  for (const char* other : {"loads", "friction", "cycles", "increments"})
    if (const auto given = step_map.get(other))
      reading.report.error(*given,
                           "is not for a step that looks for a limit, in which all else stays: use a step before it");
  return true;
}

}  // namespace scabo::input
