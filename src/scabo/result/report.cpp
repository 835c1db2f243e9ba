#include "scabo/result/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "scabo/analysis/diagnostics/mechanism.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/result/summary.hpp"
#include "scabo/result/version.hpp"

namespace scabo::result {

namespace {

std::string count(int number, std::string_view noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

const analysis::IncrementResult* last_converged(const analysis::StaticSolution& solution) {
  const auto& increments = solution.increments;
  const auto found = std::find_if(increments.rbegin(), increments.rend(), [](const auto& i) { return i.converged; });
  return found == increments.rend() ? nullptr : &*found;
}

std::string pairs_in_contact(const analysis::ContactResult& contact) {
  if (!contact.first_in_contact || !contact.last_in_contact) return "none";
  if (*contact.first_in_contact == *contact.last_in_contact) return fmt::format("P{}", *contact.first_in_contact);
  return fmt::format("P{} to P{}", *contact.first_in_contact, *contact.last_in_contact);
}

constexpr double rounding = 1e-12;

/// How far the rounding of coordinates changes shapes, relative to the size of a body: of a body at the origin 1e-15,
/// of one of 2 m at 500 km from it, as coordinates of a country are, 1e-9.
double rounding_of_shapes(const model::Model& model) {
  double largest = 0.0;
  for (const model::Body& body : model.bodies) {
    const geometry::Box box = geometry::box_of(body.outline);
    const double size = geometry::outline_size(body.outline);
    if (size > 0.0) largest = std::max(largest, box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff() / size);
  }
  return 16.0 * std::numeric_limits<double>::epsilon() * largest;
}

/// Smaller forces are rounding.
double force_level(const model::Model& model, const analysis::IncrementResult& increment) {
  const contact::Certificate& certificate = increment.certificate;
  return increment.largest_force *
         std::max({rounding, rounding_of_shapes(model), certificate.equilibrium, certificate.rigid_balance});
}

/// Smaller lengths are rounding.
double length_level(const analysis::IncrementResult& increment) {
  double motion = 0.0, place = 0.0;
  for (const Vector& u : increment.fields.displacements)
    if (u.size() > 0) motion = std::max(motion, u.lpNorm<Eigen::Infinity>());
  for (const analysis::ContactResult& contact : increment.contacts)
    for (const analysis::PairResult& pair : contact.pairs)
      place = std::max(place, pair.position.lpNorm<Eigen::Infinity>());
  return std::max(rounding * motion, 4.0 * std::numeric_limits<double>::epsilon() * place);
}

std::string shown(double value, double level, int digits = 6) {
  return fmt::format("{:.{}g}", std::abs(value) <= level ? 0.0 : value, digits);
}

/// Also 0 if the corresponding forces are rounding.
std::string shown_pressure(const analysis::ContactResult& contact, double level) {
  const bool pressed = std::any_of(contact.pairs.begin(), contact.pairs.end(), [&](const analysis::PairResult& pair) {
    return std::abs(pair.normal_force) > level;
  });
  return fmt::format("{:.4g}", pressed ? contact.max_pressure : 0.0);
}

}  // namespace

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = "  ";
    for (std::size_t i = 0; i < row.size(); ++i)
      line += i == 0 ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

std::string report_ground(const model::Model& model) {
  std::string text;
  for (const model::Step& step : model.steps)
    for (std::size_t k = 0; step.dynamic && k < 2; ++k) {
      if (step.dynamic->ground[k] < 0) continue;
      const model::Curve& curve = model.curves[static_cast<std::size_t>(step.dynamic->ground[k])];
      const model::GroundMotion motion = model::ground_motion(curve, step.dynamic->duration, step.dynamic->duration);
      text += fmt::format("ground along {} in step {} by {}", k == 0 ? 'x' : 'y', step.name, curve.name);
      if (curve.record) text += fmt::format(" ({} of {})", curve.record->of, curve.record->file);
      text += fmt::format(": acceleration {:.4g} at most, velocity {:.3g} and displacement {:.3g} at the end",
                          motion.largest, motion.velocity, motion.displacement);
      if (curve.record && curve.record->baseline)
        text += fmt::format("; baseline {:.4g} {:+.4g} t taken off", (*curve.record->baseline)[0],
                            (*curve.record->baseline)[1]);
      text += '\n';
    }
  return text;
}

std::string report_header(const model::Model& model, const ModelSizes& sizes) {
  std::string text = fmt::format("Scabo {}\n", version());
  if (!model.title.empty()) text += model.title + '\n';
  if (!model.file.empty()) text += fmt::format("Model: {}\n", model.file);
  const auto bodies = static_cast<int>(model.bodies.size());
  text += fmt::format("{}, {}, {}", bodies == 1 ? "1 body" : fmt::format("{} bodies", bodies),
                      count(sizes.nodes, "node"), fmt::format("{} degrees of freedom", sizes.dofs));
  if (sizes.super_elements > 0) text += ", " + count(sizes.super_elements, "super-element");
  if (sizes.finite_elements > 0) text += ", " + count(sizes.finite_elements, "finite element");
  text += ", " + count(sizes.contact_pairs, "contact pair") + '\n';
  if (model.analysis.revolved())
    text += fmt::format("bodies of revolution: forces are those of {}\n", model.analysis.forces_of());
  text += report_ground(model);
  for (const model::Contact& contact : model.contacts)
    text +=
        fmt::format("contact {}: {} on {}; {}\n", contact.name, contact.b.text, contact.a.text, describe_law(contact));
  return text + '\n';
}

std::string report_passes(const analysis::StaticSolution& solution) {
  if (solution.passes.empty()) return {};
  std::vector<std::vector<std::string>> rows = {{"pass", "dofs", "estimated error", "raised", "divided"}};
  for (const analysis::RefinementPass& pass : solution.passes)
    rows.push_back({fmt::format("{}", rows.size()), fmt::format("{}", pass.dofs), fmt::format("{:.3g}", pass.error),
                    fmt::format("{}", pass.raised), fmt::format("{}", pass.divided)});
  return table(rows) + "\n";
}

namespace {

/// Where growth has come to: the load or the cycles, and how far what it released is from the integral of G.
std::string report_state_of(const analysis::GrowthResult& growth) {
  if (growth.cycles) return fmt::format("{:.7g} cycles, ", *growth.cycles);
  std::string text = fmt::format("load factor {:.6g}, ", growth.load_factor);
  if (growth.energy)
    text += fmt::format("released {:.5g} (by G {:.5g}; remeshing {:.1e}), ", growth.energy->released,
                        growth.energy->integral, growth.energy->remeshing);
  return text;
}

}  // namespace

std::string report_increment(const model::Model& model, const analysis::IncrementResult& increment) {
  const model::Step& step = model.steps.at(static_cast<std::size_t>(increment.step - 1));
  std::string text =
      step.growth || step.limit ? fmt::format("step {}, increment {}:", increment.step_name, increment.increment)
      : step.automatic
          ? fmt::format("step {}, increment {}, {:.4g} % of the step:", increment.step_name, increment.increment,
                        100.0 * increment.reached)
          : fmt::format("step {}, increment {} of {}:", increment.step_name, increment.increment, step.increments);
  for (const auto& [name, factor] : increment.factors) text += fmt::format(" {} = {:.6g},", name, factor);
  if (increment.factors.empty())
    text += ' ';
  else
    text.back() = ';', text += ' ';
  if (increment.growth) text += report_state_of(*increment.growth);
  text += count(increment.newton_iterations, "iteration");
  if (increment.coarse_iterations > 0) text += fmt::format(" and {} on fewer pairs", increment.coarse_iterations);
  if (increment.halvings > 0) text += fmt::format(", halved {}", count(increment.halvings, "time"));
  if (increment.pairs_found && increment.pairs_found->times > 0)
    text += fmt::format(", pairs found anew {} (jump {:.2g})", count(increment.pairs_found->times, "time"),
                        increment.pairs_found->jump);
  text += fmt::format(", residual {:.2g}", increment.residual);
  if (increment.error) text += fmt::format(", estimated error {:.2g}", increment.error->relative);
  if (increment.converged) {
    text += fmt::format(", certificate {:.2g}", increment.certificate.worst());
    if (increment.time)
      text += fmt::format("; impact took {:.4g}, projection {:.4g} so far", increment.energy.impact,
                          increment.energy.projection);
    if (increment.uniqueness) {
      text += fmt::format(", unique: {}", increment.uniqueness->verdict);
      if (increment.uniqueness->others > 0)
        text += fmt::format(" ({}{})", count(increment.uniqueness->others, "other"),
                            increment.uniqueness->complete ? ", no more" : "");
    }
    return text + '\n';
  }
  for (const char* described_at_the_end : {"mechanism", "collapse"})
    if (increment.reason.starts_with(described_at_the_end)) return text + fmt::format("; {}\n", described_at_the_end);
  return text + fmt::format("; NOT CONVERGED: {}\n", increment.reason);
}

std::string describe_law(const model::Contact& contact) {
  if (contact.bond) return "bonded";
  if (contact.shear_strength) return fmt::format("shear strength {:g}", *contact.shear_strength);
  std::string text = fmt::format("friction {:g}", contact.friction);
  if (!contact.friction_along.empty()) {
    const auto [least, most] =
        std::minmax_element(contact.friction_along.begin(), contact.friction_along.end(),
                            [](const auto& a, const auto& b) { return a.friction < b.friction; });
    text = fmt::format("friction {:g} to {:g} along", least->friction, most->friction);
  } else if (contact.dynamic_friction) {
    if (contact.backward_friction)
      text = fmt::format("friction {:g} to {:g} forward, {:g} to {:g} backward", contact.friction,
                         *contact.dynamic_friction, *contact.backward_friction, *contact.backward_dynamic_friction);
    else
      text += contact.slip_distance > 0.0
                  ? fmt::format(", {:g} after {:g} of slip", *contact.dynamic_friction, contact.slip_distance)
                  : fmt::format(", {:g} once it slips", *contact.dynamic_friction);
  } else if (contact.backward_friction) {
    text = fmt::format("friction {:g} forward, {:g} backward", contact.friction, *contact.backward_friction);
  } else if (contact.friction == 0.0) {
    text = "frictionless";
  }
  if (contact.cohesion > 0.0) text += fmt::format(", cohesion {:g}", contact.cohesion);
  if (contact.lasting_cohesion > 0.0) text += fmt::format(", cohesion {:g} while closed", contact.lasting_cohesion);
  if (contact.tension > 0.0) text += fmt::format(", tension {:g}", contact.tension);
  return contact.cohesion > 0.0 ? text + " until failure" : text;
}

std::string report_contacts(const model::Model& model, const analysis::IncrementResult& increment) {
  if (increment.contacts.empty()) return {};
  const bool breaks = std::any_of(increment.contacts.begin(), increment.contacts.end(),
                                  [](const auto& contact) { return contact.broken.has_value(); });
  std::vector<std::vector<std::string>> rows = {{"contact", "normal force", "tangential force", "open", "stick", "slip",
                                                 "in contact", "max pressure", "max gap"}};
  const bool pores = std::any_of(increment.contacts.begin(), increment.contacts.end(),
                                 [](const auto& contact) { return contact.pore_force.has_value(); });
  if (breaks) rows.front().emplace_back("broken");
  if (pores) rows.front().emplace_back("pore force");
  const double force = force_level(model, increment), length = length_level(increment);
  for (const analysis::ContactResult& contact : increment.contacts) {
    const bool of_absent_body = !increment.absent.empty() && contact.open + contact.stick + contact.slip == 0;
    if (of_absent_body) continue;
    rows.push_back({contact.name, shown(contact.normal_force, force), shown(contact.tangential_force, force),
                    fmt::format("{}", contact.open), fmt::format("{}", contact.stick), fmt::format("{}", contact.slip),
                    pairs_in_contact(contact), shown_pressure(contact, force), shown(contact.max_gap, length, 4)});
    if (breaks) rows.back().push_back(contact.broken ? fmt::format("{}", *contact.broken) : "-");
    if (pores) rows.back().push_back(contact.pore_force ? shown(*contact.pore_force, force) : "-");
  }
  return table(rows);
}

std::string report_reactions(const model::Model& model, const analysis::IncrementResult& increment) {
  if (increment.reactions.empty()) return {};
  const double force = force_level(model, increment);
  std::vector<std::vector<std::string>> rows = {{"support", "reaction x", "reaction y"}};
  const bool moments = std::any_of(increment.moments.begin(), increment.moments.end(),
                                   [](const auto& moment) { return moment.has_value(); });
  if (moments) rows.front().emplace_back("moment");
  for (std::size_t i = 0; i < increment.reactions.size(); ++i) {
    rows.push_back(
        {model.supports[i].name, shown(increment.reactions[i].x(), force), shown(increment.reactions[i].y(), force)});
    if (moments)
      rows.back().push_back(increment.moments[i] ? fmt::format("{:.6g}", *increment.moments[i]) : std::string("-"));
  }
  return table(rows);
}

std::string report_springs(const model::Model& model, const analysis::IncrementResult& increment) {
  if (increment.springs.empty()) return {};
  const double force = force_level(model, increment);
  std::vector<std::vector<std::string>> rows = {{"springs", "force x", "force y"}};
  for (std::size_t i = 0; i < increment.springs.size(); ++i)
    rows.push_back(
        {model.springs[i].name, shown(increment.springs[i].x(), force), shown(increment.springs[i].y(), force)});
  return table(rows);
}

std::string report_bars(const model::Model& model, const analysis::IncrementResult& increment) {
  if (increment.bars.empty()) return {};
  const double force = force_level(model, increment);
  std::vector<std::vector<std::string>> rows = {{"bar", "tension"}};
  for (std::size_t i = 0; i < increment.bars.size(); ++i)
    rows.push_back({model.bars[i].name, shown(increment.bars[i], force)});
  return table(rows);
}

std::string report_cracks(const analysis::IncrementResult& increment) {
  if (increment.cracks.empty()) return {};
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string("-");
  };
  std::vector<std::vector<std::string>> rows = {
      {"crack", "kind", "K_I", "K_II", "T", "G", "J", "epsilon", "at length"}};
  std::vector<std::vector<std::string>> corners = {{"corner", "K_tt", "K_rt", "at distance", "singular exponents"}};
  for (const analysis::CrackResult& crack : increment.cracks) {
    const element::StressIntensity& f = crack.factors;
    const double level = rounding * std::max(std::abs(f.K_I), std::abs(f.K_II));
    if (f.kind == element::CornerKind::corner) {
      std::string exponents;
      for (const element::CornerTerm& term : f.terms) {
        for (const auto& value : term.exponents)
          exponents += (exponents.empty() ? "" : ", ") +
                       (value.imag() == 0.0 ? fmt::format("{:.6g}", value.real())
                                            : fmt::format("{:.6g}{:+.6g}i", value.real(), value.imag()));
        if (term.defective) exponents += " (power-logarithmic)";
      }
      corners.push_back({crack.name, shown(f.K_I, level), shown(f.K_II, level),
                         fmt::format("{:.6g}", f.reference_length), exponents.empty() ? "none" : exponents});
      continue;
    }
    const bool interface = f.kind == element::CornerKind::interface_crack;
    rows.push_back({crack.name, interface ? "interface" : "crack", shown(f.K_I, level), shown(f.K_II, level),
                    interface ? number(f.T_left) + ", " + number(f.T_right) : number(f.T_left), number(f.G),
                    number(f.J), interface ? fmt::format("{:.6g}", f.epsilon) : "-",
                    interface ? fmt::format("{:.6g}", f.reference_length) : "-"});
  }
  return (rows.size() > 1 ? table(rows) : "") + (corners.size() > 1 ? table(corners) : "");
}

std::string report_quantities(const analysis::IncrementResult& increment) {
  std::string text;
  for (const analysis::QuantityResult& quantity : increment.quantities) {
    // The value to one digit more than its bar has.
    const double digits = quantity.bar > 0.0 && quantity.value != 0.0
                              ? std::ceil(std::log10(std::abs(quantity.value) / quantity.bar)) + 2.0
                              : 6.0;
    text += fmt::format("quantity: {} = {:.{}g} +- {:.2g}", quantity.of, quantity.value,
                        static_cast<int>(std::clamp(digits, 3.0, 15.0)), quantity.bar);
    text += quantity.wanted
                ? fmt::format(" ({:g} wanted, {})\n", *quantity.wanted, quantity.reached() ? "reached" : "not reached")
            : quantity.value == 0.0 ? "\n"
                                    : fmt::format(" ({:.1e})\n", quantity.relative());
  }
  return text;
}

std::string report_energies(const analysis::IncrementResult& increment) {
  if (!increment.time) return {};
  const analysis::Energy& energy = increment.energy;
  std::vector<std::vector<std::string>> rows = {
      {"energy", "work", "kinetic", "elastic", "friction", "damping", "impact", "projection", "massless"}, {"in sum"}};
  for (const double term : {energy.external, energy.kinetic, energy.elastic, energy.friction, energy.damping,
                            energy.impact, energy.projection, energy.massless})
    rows.back().push_back(fmt::format("{:.4g}", term));
  return table(rows);
}

std::string report_totals(const model::Model& model, const analysis::IncrementResult& increment) {
  const std::string heading =
      fmt::format("After step {}, increment {}{}:\n", increment.step_name, increment.increment,
                  model.analysis.revolved() ? fmt::format(", forces of {}", model.analysis.forces_of()) : "");
  std::string text;
  for (const std::string& part : {report_contacts(model, increment), report_reactions(model, increment),
                                  report_springs(model, increment), report_bars(model, increment),
                                  report_cracks(increment), report_energies(increment), report_quantities(increment)})
    if (!part.empty()) text += (text.empty() ? "" : "\n") + part;
  return heading + text;
}

std::string report_warnings(const analysis::StaticSolution& solution) {
  std::string text;
  for (const Warning& warning : solution.warnings) text += fmt::format("warning: {}\n", warning.text);
  return text;
}

std::string report_mechanism(const analysis::StaticSolution& solution) {
  if (!solution.mechanism) return {};
  return fmt::format("mechanism.vtu shows the motion: {}\n", analysis::describe(*solution.mechanism, solution.model));
}

std::string report_timing(const analysis::Timing& timing) {
  const std::pair<const char*, double> stages[] = {
      {"read", timing.read},         {"mesh", timing.mesh},           {"super-elements", timing.super_elements},
      {"assemble", timing.assemble}, {"factorise", timing.factorise}, {"condense", timing.condense},
      {"newton", timing.newton},     {"recover", timing.recover},     {"write", timing.write},
      {"total", timing.total}};
  std::vector<std::vector<std::string>> rows = {{"stage", "seconds"}};
  for (const auto& [name, seconds] : stages) rows.push_back({name, fmt::format("{:.4f}", seconds)});
  std::string text = table(rows);
  if (const auto bytes = peak_memory())
    text += fmt::format("  peak of memory: {:.1f} MB\n", static_cast<double>(*bytes) / 1e6);
  return text;
}

namespace {

/// Increments as "1 to 4 and 7".
std::string ranges_of(const std::vector<int>& numbers) {
  std::vector<std::string> ranges;
  for (std::size_t i = 0, end = 0; i < numbers.size(); i = end) {
    for (end = i + 1; end < numbers.size() && numbers[end] == numbers[end - 1] + 1;) ++end;
    ranges.push_back(end - i == 1 ? fmt::format("{}", numbers[i])
                                  : fmt::format("{} to {}", numbers[i], numbers[end - 1]));
  }
  return fmt::format("{}", fmt::join(ranges, ", "));
}

}  // namespace

std::string report_growth(const analysis::StaticSolution& solution) {
  if (!solution.grown || solution.grown->ended.empty() || solution.outcome != analysis::Outcome::solved) return {};
  std::vector<int> unstable, together;
  for (std::size_t i = 0; i + 1 < solution.increments.size(); ++i) {
    const auto &at = solution.increments[i].growth, &after = solution.increments[i + 1].growth;
    if (!at || !after || at->cycles) continue;
    if (after->load_factor < at->load_factor) unstable.push_back(solution.increments[i].increment);
    const auto grow = std::count_if(at->tips.begin(), at->tips.end(), [](const auto& tip) { return tip.grows; });
    if (grow > 1) together.push_back(solution.increments[i].increment);
  }
  std::string text;
  if (!unstable.empty())
    text += fmt::format("Growth is unstable under a given load in increments {}: the next one needs less\n",
                        ranges_of(unstable));
  if (!together.empty())
    text += fmt::format(
        "Several tips are critical at once in increments {}: they grow together, the symmetric one of several ways\n",
        ranges_of(together));
  return text + fmt::format("Growth ended: {}\n", solution.grown->ended);
}

std::string report_limit(const analysis::StaticSolution& solution) {
  if (!solution.limit) return {};
  const analysis::Limit& limit = *solution.limit;
  if (std::isinf(limit.beyond))
    return fmt::format("No limit was found: there is equilibrium up to the factor {:.6g}\n", limit.solved);
  return fmt::format("limit = {:.6g} to {:.6g}: {} at {:.6g}\n", limit.solved, limit.beyond,
                     limit.outcome == analysis::Outcome::not_converged ? "not decided whether there is equilibrium"
                                                                       : name_of(limit.outcome),
                     limit.beyond);
}

std::string report_end(const analysis::StaticSolution& solution, const analysis::Timing& timing) {
  std::string text = "\n";
  switch (solution.outcome) {
    case analysis::Outcome::solved:
      text += "Solved: every increment converged and is certified.\n";
      break;
    case analysis::Outcome::not_converged:
      text += fmt::format("Did not converge: {}\n", solution.reason);
      break;
    case analysis::Outcome::mechanism:
    case analysis::Outcome::collapse:
      text += fmt::format("Not solved: {}\n", solution.reason);
      text += report_mechanism(solution);
      break;
    case analysis::Outcome::interrupted:
      text += fmt::format("Interrupted: {}\n", solution.reason);
      break;
  }
  text += report_growth(solution) + report_limit(solution);
  if (solution.limit) text += report_mechanism(solution);
  if (const analysis::IncrementResult* last = last_converged(solution))
    text += '\n' + report_totals(solution.model, *last);
  if (!solution.warnings.empty()) text += '\n' + report_warnings(solution);
  return text + '\n' + report_timing(timing);
}

}  // namespace scabo::result
