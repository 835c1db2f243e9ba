#include "scabo/convert/write_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scabo/model/wording.hpp"

namespace scabo::convert {

namespace {

using model::number_text;

std::string curve_for(const std::vector<std::pair<double, double>>& table, std::vector<NamedCurve>& curves) {
  for (const NamedCurve& known : curves)
    if (known.table == table) return known.name;
  curves.push_back({fmt::format("curve_{}", curves.size() + 1), table});
  return curves.back().name;
}

std::string increments_of(const DeckStep& step, bool counted) {
  if (step.at_once) return "1";
  if (counted)
    return fmt::format("{}", static_cast<int>(std::clamp(std::ceil(step.period / step.first - 1e-6), 1.0, 1000.0)));
  const double first = step.first / step.period,
               largest = std::min(1.0, step.largest > 0.0 ? step.largest / step.period : 1.0);
  if (step.equal) {
    const double count = std::round(step.period / step.first);
    if (std::abs(count * step.first - step.period) < 1e-6 * step.period)
      return fmt::format("{}", static_cast<int>(std::clamp(count, 1.0, 100000.0)));
    return fmt::format("{{first: {0}, smallest: {0}, largest: {0}}}", number_text(std::max(first, 1e-6)));
  }
  if (first >= 1.0) return "1";
  const double most = std::max(largest, 1e-6), least = std::clamp(step.smallest / step.period, 1e-6, most);
  return fmt::format("{{first: {}, smallest: {}, largest: {}}}", number_text(std::clamp(first, least, most)),
                     number_text(least), number_text(most));
}

/// `, friction: {touch: 0.2}`, if a coefficient changes.
std::string friction_of(const DeckStep& step, const ModelParts& parts) {
  std::vector<std::string> values;
  for (const auto& [interaction, coefficient] : step.friction) {
    const auto [first, end] = parts.contacts_of.equal_range(interaction);
    for (auto contact = first; contact != end; ++contact)
      values.push_back(fmt::format("{}: {}", contact->second, number_text(coefficient)));
  }
  return values.empty() ? "" : fmt::format(", friction: {{{}}}", fmt::join(values, ", "));
}

}  // namespace

std::vector<std::string> names_of_steps(const std::vector<DeckStep>& steps) {
  std::vector<std::string> texts;
  UniqueNames names;
  for (std::size_t s = 0; s < steps.size(); ++s)
    texts.push_back(yaml_word(names.take(steps[s].name.empty() ? fmt::format("step_{}", s + 1) : steps[s].name)));
  return texts;
}

std::string steps_text(const std::vector<DeckStep>& steps, const std::vector<Driven>& all, ModelParts& parts,
                       bool counted) {
  std::string text;
  const std::vector<std::string> names = names_of_steps(steps);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    std::vector<std::string> factors;
    const std::string friction = friction_of(steps[s], parts);
    bool plain = steps.size() == 1 && friction.empty();  // everything goes to 1, which needs no word
    for (const Driven& driven : all) {
      const Leg& leg = driven.factors[s];
      const double before = s > 0 ? driven.factors[s - 1].end : 0.0;
      plain = plain && leg.table.empty() && leg.end == 1.0;
      if (leg.table.empty() && leg.end == before) continue;
      factors.push_back(fmt::format("{}: {}", yaml_word(driven.name),
                                    leg.table.empty() ? number_text(leg.end) : curve_for(leg.table, parts.curves)));
    }
    if (factors.empty() && !plain && !all.empty())
      factors.push_back(fmt::format("{}: {}", yaml_word(all.front().name), number_text(all.front().factors[s].end)));
    text += fmt::format("  - {{name: {}, increments: {}{}{}}}\n", names[s], increments_of(steps[s], counted), friction,
                        plain || factors.empty() ? "" : fmt::format(", loads: {{{}}}", fmt::join(factors, ", ")));
  }
  return text;
}

}  // namespace scabo::convert
