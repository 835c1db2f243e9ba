// `growth` of a step: which cracks grow, by which criterion, against which toughness, and until when.
//
// Under cycles of load `law` and its constants take the place of a toughness, and `between` has the factors.
//
// `scale` names the loads and supports that the load factor multiplies; by default those whose factor the step changes.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/input/reading.hpp"
#include "scabo/input/suggestions.hpp"

namespace scabo::input {

namespace {

constexpr const char* growth_example = "{toughness: {K_Ic: 1e6}, step: 0.01}";
constexpr const char* fatigue_example = "{law: paris, C: 1e-28, m: 3, between: [{pull: 0.1}, {pull: 1}], step: 0.01}";

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

/// A number, or one for each of the materials that are named.
Toughness read_toughness(Reading& reading, const Value& value) {
  Toughness toughness;
  if (value.node->kind != Node::Kind::map) {
    toughness.of_all = number_or_unread(reading, value);
    return toughness;
  }
  const std::vector<Material>& materials = reading.model.materials;
  toughness.of_material.resize(materials.size());
  for (const MapEntry& entry : value.node->entries) {
    const Value number{entry.value, value.path + "." + entry.key};
    const auto named = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material& material) { return material.name == entry.key; });
    if (named != materials.end()) {
      toughness.of_material[static_cast<std::size_t>(named - materials.begin())] = number_or_unread(reading, number);
      continue;
    }
    std::vector<std::string> known;
    for (const Material& material : materials) known.push_back(material.name);
    reading.report.error(
        number, fmt::format("there is no material named {}{}", quoted_name(entry.key), suggestion(entry.key, known)));
  }
  return toughness;
}

void read_toughness(Reading& reading, const Value& value, GrowthStep& growth) {
  const MapReader map(reading.report, value, {"K_Ic", "G_c"}, "{K_Ic: 1e6}");
  if (const auto K_Ic = map.get("K_Ic")) growth.K_Ic = read_toughness(reading, *K_Ic);
  if (const auto G_c = map.get("G_c")) growth.G_c = read_toughness(reading, *G_c);
  if (!map.is_map() || !map.all_known()) growth.K_Ic = Toughness{unread, {}};
}

void read_until(Reading& reading, const Value& value, GrowthStep& growth) {
  const MapReader map(reading.report, value, {"length", "tip", "load_factor", "steps", "break"}, "{length: 0.5}");
  if (const auto length = map.get("length")) growth.length = number_or_unread(reading, length);
  if (const auto tip = map.get("tip")) growth.tip = read_vector(reading.report, *tip).value_or(Vec2::Constant(unread));
  if (const auto factor = map.get("load_factor")) growth.load_factor = number_or_unread(reading, factor);
  if (const auto steps = map.get("steps"))
    growth.steps = static_cast<int>(read_integer(reading.report, *steps, limits::growth_steps).value_or(1));
  if (const auto broken = map.get("break")) growth.broken = read_flag(reading.report, *broken).value_or(false);
}

void report_unknown(Reading& reading, const Value& at, const std::string& name) {
  if (reading.own_support_names.contains(name)) return;  // it could not be read
  std::vector<std::string> known = reading.load_names;
  known.insert(known.end(), reading.own_support_names.begin(), reading.own_support_names.end());
  reading.report.error(
      at, fmt::format("there is no load or named support called {}{}", quoted_name(name), suggestion(name, known)));
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
    } else {
      report_unknown(reading, item, *name);
    }
  }
}

/// Number of a load or support in the model by its name, -1 where the model has it but it could not be read, or none.
std::optional<int> find(const Index& index, const std::string& name) {
  const auto found = index.find(name);
  return found == index.end() ? std::nullopt : std::optional(found->second);
}

/// Factors at one end of the cycles, in place of those of the step.
void read_end_of_cycle(Reading& reading, const Value& value, const Index& supports, std::size_t end,
                       LoadCycles& cycles) {
  if (value.node->kind != Node::Kind::map) {
    reading.report.error(value,
                         fmt::format("must be a map of factors, as in {{pull: 0.1}}, not {}", describe(*value.node)));
    return;
  }
  for (const MapEntry& entry : value.node->entries) {
    const Value factor{entry.value, value.path + "." + entry.key};
    if (const auto load = find(reading.index_of_load, entry.key)) {
      const double number = read_number(reading.report, factor).value_or(unread);
      if (*load >= 0) cycles.loads[end][static_cast<std::size_t>(*load)] = number;
    } else if (const auto support = find(supports, entry.key)) {
      cycles.supports[end][static_cast<std::size_t>(*support)] = read_number(reading.report, factor).value_or(unread);
    } else {
      report_unknown(reading, factor, entry.key);
    }
  }
}

void read_cycles(Reading& reading, const MapReader& map, const Index& supports, const Step& step, GrowthStep& growth) {
  const auto law = map.get("law");
  if (!law) {
    for (const char* key : {"C", "m", "gamma", "K_c", "between"})
      map.refuse(key, fmt::format("is for cycles of load, which need a 'law', as in {}", fatigue_example));
    return;
  }
  LoadCycles& cycles = growth.cycles.emplace();
  cycles.C = cycles.m = unread;
  const auto choice = read_choice(reading.report, *law, {"paris", "forman", "walker"}, {});
  if (choice && *choice == "forman") cycles.law = FatigueLaw::forman;
  if (choice && *choice == "walker") cycles.law = FatigueLaw::walker;
  cycles.C = number_or_unread(reading, map.need("C"));
  cycles.m = number_or_unread(reading, map.need("m"));
  if (const auto gamma = map.get("gamma")) cycles.gamma = number_or_unread(reading, gamma);
  if (const auto K_c = map.get("K_c")) cycles.K_c = number_or_unread(reading, K_c);
  if (!choice) cycles.gamma = cycles.K_c = std::nullopt;
  cycles.loads = {std::vector<double>(step.load_factors.size(), unread), step.load_factors};
  cycles.supports = {step.support_factors, step.support_factors};
  map.refuse("scale", "has no meaning under cycles of load: 'between' has their factors");
  const auto between = map.need("between");
  if (!between) return;
  const auto ends = read_list(reading.report, *between, "[{pull: 0.1}, {pull: 1}]");
  if (!ends) return;
  if (ends->size() != 2) {
    reading.report.error(*between,
                         "must have two entries, factors at the lowest and at the highest load, as in "
                         "[{pull: 0.1}, {pull: 1}]");
    return;
  }
  cycles.loads[0] = step.load_factors;
  for (const std::size_t end : {0u, 1u}) read_end_of_cycle(reading, (*ends)[end], supports, end, cycles);
}

std::vector<char> changed(const std::vector<double>& from, const std::vector<double>& to) {
  std::vector<char> which(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) which[i] = to[i] != from[i];
  return which;
}

}  // namespace

void read_growth(Reading& reading, const Value& value, const Index& supports, const Step& before, Step& step) {
  const MapReader map(reading.report, value,
                      {"criterion", "distance", "toughness", "step", "cracks", "scale", "until", "law", "C", "m",
                       "gamma", "K_c", "between"},
                      growth_example);
  GrowthStep growth;
  growth.step = unread;
  if (!map.is_map()) return;
  if (const auto criterion = map.get("criterion")) {
    const auto choice =
        read_choice(reading.report, *criterion,
                    {"hoop_stress", "energy_release", "strain_energy_density", "zero_K_II", "straight"}, {});
    if (choice && *choice == "energy_release") growth.criterion = GrowthCriterion::energy_release;
    if (choice && *choice == "strain_energy_density") growth.criterion = GrowthCriterion::strain_energy_density;
    if (choice && *choice == "straight") growth.criterion = GrowthCriterion::straight;
    if (choice && *choice == "zero_K_II") growth.criterion = GrowthCriterion::zero_K_II;
  }
  if (const auto distance = map.get("distance")) growth.distance = number_or_unread(reading, distance);
  read_cycles(reading, map, supports, step, growth);
  if (const auto toughness = growth.cycles ? map.get("toughness") : map.need("toughness"))
    read_toughness(reading, *toughness, growth);
  else if (!growth.cycles)
    growth.K_Ic = Toughness{unread, {}};
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
