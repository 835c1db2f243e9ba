// `growth` of a step: which cracks grow, by which criterion, against which toughness, and until when.
//
// `scale` names the loads and supports that the load factor multiplies; by default those whose factor the step changes.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr const char* growth_example = "{toughness: {K_Ic: 1e6}, step: 0.01}";

/// `beam.notch`, or one of its ends, `beam.notch.start` or `beam.notch.end`.
std::optional<GrowingCrack> read_growing_crack(Reading& reading, const Value& value) {
  const auto text = read_text(reading.report, value);
  if (!text) return {};
  std::vector<std::string> known;
  for (std::size_t b = 0; b < reading.model.bodies.size(); ++b) {
    const Body& body = reading.model.bodies[b];
    for (std::size_t c = 0; c < body.cracks.size(); ++c) {
      const std::string name = body.name + "." + body.cracks[c].name;
      GrowingCrack crack{static_cast<int>(b), static_cast<int>(c), true, true, value.source()};
      if (*text == name) return crack;
      if (*text == name + ".start") return crack.at_end = false, crack;
      if (*text == name + ".end") return crack.at_start = false, crack;
      known.push_back(name);
    }
  }
  if (reading.bodies_known)
    reading.report.error(value, fmt::format("there is no crack named {}{}; a crack is named with its body, as in "
                                            "plate.flaw, and one of its ends as in plate.flaw.end",
                                            quoted_name(*text), suggestion(*text, known)));
  return {};
}

void read_toughness(Reading& reading, const Value& value, GrowthStep& growth) {
  const MapReader map(reading.report, value, {"K_Ic", "G_c"}, "{K_Ic: 1e6}");
  if (const auto K_Ic = map.get("K_Ic")) growth.K_Ic = number_or_unread(reading, K_Ic);
  if (const auto G_c = map.get("G_c")) growth.G_c = number_or_unread(reading, G_c);
  if (!map.is_map() || !map.all_known()) growth.K_Ic = unread;
}

void read_until(Reading& reading, const Value& value, GrowthStep& growth) {
  const MapReader map(reading.report, value, {"length", "tip", "load_factor", "steps"}, "{length: 0.5}");
  if (const auto length = map.get("length")) growth.length = number_or_unread(reading, length);
  if (const auto tip = map.get("tip")) growth.tip = read_vector(reading.report, *tip).value_or(Vec2::Constant(unread));
  if (const auto factor = map.get("load_factor")) growth.load_factor = number_or_unread(reading, factor);
  if (const auto steps = map.get("steps"))
    growth.steps = static_cast<int>(read_integer(reading.report, *steps, limits::growth_steps).value_or(1));
}

void read_scale(Reading& reading, const Value& value, const Index& supports, GrowthStep& growth) {
  const auto names = read_list(reading.report, value, "[pull]");
  for (const Value& item : names.value_or(std::vector<Value>{})) {
    const auto name = read_text(reading.report, item);
    if (!name) continue;
    if (const auto load = reading.index_of_load.find(*name); load != reading.index_of_load.end()) {
      if (load->second >= 0) growth.loads[static_cast<std::size_t>(load->second)] = 1;
    } else if (const auto support = supports.find(*name); support != supports.end()) {
      growth.supports[static_cast<std::size_t>(support->second)] = 1;
    } else if (!reading.own_support_names.contains(*name)) {
      std::vector<std::string> known = reading.load_names;
      known.insert(known.end(), reading.own_support_names.begin(), reading.own_support_names.end());
      reading.report.error(item, fmt::format("there is no load or named support called {}{}", quoted_name(*name),
                                             suggestion(*name, known)));
    }
  }
}

std::vector<char> changed(const std::vector<double>& from, const std::vector<double>& to) {
  std::vector<char> which(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) which[i] = to[i] != from[i];
  return which;
}

}  // namespace

void read_growth(Reading& reading, const Value& value, const Index& supports, const Step& before, Step& step) {
  const MapReader map(reading.report, value, {"criterion", "toughness", "step", "cracks", "scale", "until"},
                      growth_example,
                      {{"law", "growth under cycles of load comes later, and under a load needs 'toughness'"},
                       {"between", "growth under cycles of load comes later, and under a load needs 'toughness'"}});
  GrowthStep growth;
  growth.step = unread;
  if (!map.is_map()) return;
  if (const auto criterion = map.get("criterion")) {
    const auto choice = read_choice(reading.report, *criterion,
                                    {"hoop_stress", "energy_release", "strain_energy_density", "zero_K_II"}, {});
    if (choice && *choice == "energy_release") growth.criterion = GrowthCriterion::energy_release;
    if (choice && *choice == "strain_energy_density") growth.criterion = GrowthCriterion::strain_energy_density;
    if (choice && *choice == "zero_K_II") growth.criterion = GrowthCriterion::zero_K_II;
  }
  if (const auto toughness = map.need("toughness"))
    read_toughness(reading, *toughness, growth);
  else
    growth.K_Ic = unread;
  growth.step = number_or_unread(reading, map.need("step"));
  if (const auto cracks = map.get("cracks"))
    for (const Value& item : read_list(reading.report, *cracks, "[plate.flaw]").value_or(std::vector<Value>{}))
      if (const auto crack = read_growing_crack(reading, item)) growth.cracks.push_back(*crack);
  growth.loads = changed(before.load_factors, step.load_factors);
  growth.supports = changed(before.support_factors, step.support_factors);
  if (const auto scale = map.get("scale")) {
    std::fill(growth.loads.begin(), growth.loads.end(), 0);
    std::fill(growth.supports.begin(), growth.supports.end(), 0);
    read_scale(reading, *scale, supports, growth);
  }
  if (const auto until = map.get("until")) read_until(reading, *until, growth);
  step.growth = std::move(growth);
}

}  // namespace scabo::input
