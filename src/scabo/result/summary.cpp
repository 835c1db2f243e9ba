#include "scabo/result/summary.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scabo/analysis/diagnostics/mechanism.hpp"
#include "scabo/result/model_content.hpp"
#include "scabo/result/version.hpp"

namespace scabo::result {

namespace {

using Json = nlohmann::ordered_json;  // keys in the order of the documentation

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

template <typename Value>
Json value_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json json_of(const Vec2& vector) { return {number_or_null(vector.x()), number_or_null(vector.y())}; }

Json json_of(const analysis::ContactResult& contact) {
  Json json = {{"normal_force", number_or_null(contact.normal_force)},
               {"tangential_force", number_or_null(contact.tangential_force)},
               {"force", json_of(contact.force)},
               {"moment", number_or_null(contact.moment)},
               {"centre_of_pressure", contact.centre_of_pressure ? json_of(*contact.centre_of_pressure) : Json()},
               {"open", contact.open},
               {"stick", contact.stick},
               {"slip", contact.slip},
               {"max_gap", number_or_null(contact.max_gap)},
               {"max_pressure", number_or_null(contact.max_pressure)},
               {"first_pair_in_contact", value_or_null(contact.first_in_contact)},
               {"last_pair_in_contact", value_or_null(contact.last_in_contact)}};
  if (contact.broken) json["broken"] = *contact.broken;
  if (contact.pore_force) {
    json["pore_force"] = number_or_null(*contact.pore_force);
    json["total_normal_force"] = number_or_null(contact.normal_force + *contact.pore_force);
  }
  return json;
}

Json json_of(const contact::Certificate& certificate) {
  return {{"equilibrium", number_or_null(certificate.equilibrium)},
          {"penetration", number_or_null(certificate.penetration)},
          {"tension", number_or_null(certificate.tension)},
          {"friction_excess", number_or_null(certificate.friction_excess)},
          {"complementarity", number_or_null(certificate.complementarity)},
          {"slip_direction", number_or_null(certificate.slip_direction)},
          {"rigid_balance", number_or_null(certificate.rigid_balance)}};
}

Json json_of(const analysis::Energy& energy) {
  return {{"external", number_or_null(energy.external)},
          {"elastic", number_or_null(energy.elastic)},
          {"friction", number_or_null(energy.friction)},
          {"friction_error", number_or_null(energy.friction_error)}};
}

void add_in_time(const analysis::Energy& energy, Json& json) {
  json["kinetic"] = number_or_null(energy.kinetic);
  json["damping"] = number_or_null(energy.damping);
  json["impact"] = number_or_null(energy.impact);
  json["projection"] = number_or_null(energy.projection);
  json["massless"] = number_or_null(energy.massless);
}

Json json_of(const std::vector<std::complex<double>>& exponents) {
  Json list = Json::array();
  for (const std::complex<double>& value : exponents)
    list.push_back({number_or_null(value.real()), number_or_null(value.imag())});
  return list;
}

Json number_or_null(const std::optional<double>& value) { return value ? number_or_null(*value) : Json(); }

Json json_of(const element::CornerTerm& term) {
  return {{"exponents", json_of(term.exponents)},
          {"K_tt", number_or_null(term.factors[0])},
          {"K_rt", number_or_null(term.factors[1])},
          {"limit", term.limit ? Json{number_or_null((*term.limit)[0]), number_or_null((*term.limit)[1])} : Json()},
          {"defective", term.defective}};
}

Json json_of(const element::StressIntensity& crack) {
  Json json = {{"kind", name_of(crack.kind)}};
  const bool corner = crack.kind == element::CornerKind::corner,
             interface = crack.kind == element::CornerKind::interface_crack;
  json[corner ? "K_tt" : "K_I"] = number_or_null(crack.K_I);
  json[corner ? "K_rt" : "K_II"] = number_or_null(crack.K_II);
  if (interface) {
    json["T_left"] = number_or_null(crack.T_left);
    json["T_right"] = number_or_null(crack.T_right);
  } else if (!corner) {
    json["T"] = number_or_null(crack.T_left);
  }
  if (!corner) {
    json["G"] = number_or_null(crack.G);
    json["J"] = number_or_null(crack.J);
  }
  if (interface) json["epsilon"] = number_or_null(crack.epsilon);
  if (interface || corner) json["reference_length"] = number_or_null(crack.reference_length);
  json["exponents"] = json_of(crack.exponents);
  if (!corner) return json;
  json["ray"] = number_or_null(crack.ray);
  json["terms"] = Json::array();
  for (const element::CornerTerm& term : crack.terms) json["terms"].push_back(json_of(term));
  return json;
}

Json json_of(const analysis::GrowthResult& growth) {
  Json json = {{"load_factor", number_or_null(growth.load_factor)}, {"tips", Json::object()}};
  if (growth.cycles) json["cycles"] = number_or_null(*growth.cycles);
  if (growth.displacement) json["displacement"] = number_or_null(*growth.displacement);
  if (growth.reaction) json["reaction"] = number_or_null(*growth.reaction);
  if (const auto& energy = growth.energy)
    json["energy"] = {{"external", number_or_null(energy->external)}, {"elastic", number_or_null(energy->elastic)},
                      {"contact", number_or_null(energy->contact)},   {"released", number_or_null(energy->released)},
                      {"integral", number_or_null(energy->integral)}, {"remeshing", number_or_null(energy->remeshing)}};
  for (const analysis::TipResult& tip : growth.tips) {
    Json& of = json["tips"][tip.name];
    of = {{"position", json_of(tip.position)},
          {"length", number_or_null(tip.length)},
          {"opening", number_or_null(tip.opening)},
          {"kink", number_or_null(tip.kink)},
          {"critical_at", number_or_null(tip.load_factor)},
          {"grows", tip.grows}};
    if (tip.range) of["range"] = number_or_null(*tip.range);
    if (tip.meets) of["meets"] = json_of(*tip.meets);
  }
  return json;
}

Json json_of(const analysis::Limit& limit, const model::Model& model) {
  const model::LimitStep& step = *model.steps.back().limit;
  const auto names = [](const std::vector<char>& which, const auto& things) {
    Json list = Json::array();
    for (std::size_t i = 0; i < which.size(); ++i)
      if (which[i]) list.push_back(things[i].name);
    return list;
  };
  const bool undecided = limit.outcome == analysis::Outcome::not_converged;
  return {{"loads", names(step.loads, model.loads)},
          {"friction", names(step.friction, model.contacts)},
          {"cohesion", names(step.cohesion, model.contacts)},
          {"solved", limit.solved},
          {"beyond", number_or_null(limit.beyond)},
          {"by", std::isinf(limit.beyond) ? Json() : Json(undecided ? "not_decided" : name_of(limit.outcome))},
          {"reason", limit.reason.empty() ? Json() : Json(limit.reason)}};
}

Json json_of(const analysis::GrownCracks& grown) {
  Json json = {
      {"ended", grown.ended.empty() ? Json() : Json(grown.ended)}, {"broken", grown.broken}, {"paths", Json::object()}};
  for (const analysis::GrownCracks::Path& path : grown.paths) {
    json["paths"][path.crack] = Json::array();
    for (const Vec2& point : path.points) json["paths"][path.crack].push_back(json_of(point));
  }
  return json;
}

Json json_of(const analysis::ErrorEstimate& error, const model::Model& model) {
  Json json = {{"relative_energy_norm", number_or_null(error.relative)}, {"bodies", Json::object()}};
  for (std::size_t b = 0; b < error.bodies.size(); ++b) {
    const auto& body = error.bodies[b];
    if (body)
      json["bodies"][model.bodies[b].name] = {{"absolute", number_or_null(body->absolute)},
                                              {"relative", number_or_null(body->relative)}};
  }
  return json;
}

Json json_of(const analysis::QuantityResult& quantity) {
  return {{"of", quantity.of},
          {"value", number_or_null(quantity.value)},
          {"bar", number_or_null(quantity.bar)},
          {"relative", number_or_null(quantity.relative())},
          {"finer", number_or_null(quantity.finer)},
          {"wanted", value_or_null(quantity.wanted)},
          {"reached", quantity.wanted ? Json(quantity.reached()) : Json()}};
}

/// An increment that did not converge has no contacts, reactions, certificate or energy, because it is not a result.
Json json_of(const analysis::IncrementResult& increment, const model::Model& model) {
  Json json = {{"step", increment.step}, {"increment", increment.increment}, {"reached", increment.reached}};
  if (increment.time) json["time"] = number_or_null(*increment.time);
  json["factors"] = Json::object();
  for (const auto& [name, factor] : increment.factors) json["factors"][name] = number_or_null(factor);
  json["converged"] = increment.converged;
  json["newton_iterations"] = increment.newton_iterations;
  json["coarse_iterations"] = increment.coarse_iterations;
  if (increment.pairs_found)
    json["pairs_found_anew"] = {{"times", increment.pairs_found->times},
                                {"jump", number_or_null(increment.pairs_found->jump)}};
  json["residual"] = number_or_null(increment.residual);
  json["contacts"] = Json::object();
  json["reactions"] = Json::object();
  json["cracks"] = Json::object();
  json["certificate"] = nullptr;
  json["energy"] = nullptr;
  json["error"] = nullptr;
  if (!increment.converged) return json;
  for (const analysis::ContactResult& contact : increment.contacts) json["contacts"][contact.name] = json_of(contact);
  for (std::size_t i = 0; i < increment.reactions.size(); ++i)
    json["reactions"][model.supports[i].name] = {number_or_null(increment.reactions[i].x()),
                                                 number_or_null(increment.reactions[i].y())};
  for (std::size_t i = 0; i < increment.moments.size(); ++i)
    if (increment.moments[i]) json["moments"][model.supports[i].name] = number_or_null(*increment.moments[i]);
  if (!model.springs.empty()) json["springs"] = Json::object();
  for (std::size_t i = 0; i < increment.springs.size(); ++i)
    json["springs"][model.springs[i].name] = {number_or_null(increment.springs[i].x()),
                                              number_or_null(increment.springs[i].y())};
  if (!model.bars.empty()) json["bars"] = Json::object();
  for (std::size_t i = 0; i < increment.bars.size(); ++i)
    json["bars"][model.bars[i].name] = {{"tension", number_or_null(increment.bars[i])}};
  if (model::has_stages(model.bodies)) json["absent"] = Json::array();
  for (const int body : increment.absent) json["absent"].push_back(model.bodies[static_cast<std::size_t>(body)].name);
  for (const analysis::CrackResult& crack : increment.cracks) json["cracks"][crack.name] = json_of(crack.factors);
  if (increment.growth) json["growth"] = json_of(*increment.growth);
  json["certificate"] = json_of(increment.certificate);
  json["energy"] = json_of(increment.energy);
  if (increment.time) {
    json["certificate"]["energy_balance"] = number_or_null(increment.certificate.energy_balance);
    add_in_time(increment.energy, json["energy"]);
  }
  json["error"] = increment.error ? json_of(*increment.error, model) : Json();
  if (!increment.quantities.empty()) {
    json["quantities"] = Json::array();
    for (const analysis::QuantityResult& quantity : increment.quantities)
      json["quantities"].push_back(json_of(quantity));
  }
  if (increment.uniqueness) json["uniqueness"] = content_of_uniqueness(*increment.uniqueness);
  return json;
}

/// The bodies that move, those that move most first; equal ones in the order of the model.
Json json_of(const analysis::Mechanism& mechanism, const model::Model& model) {
  std::vector<std::size_t> moving;
  for (std::size_t b = 0; b < mechanism.bodies.size(); ++b)
    if (mechanism.bodies[b].moves()) moving.push_back(b);
  std::stable_sort(moving.begin(), moving.end(), [&](std::size_t a, std::size_t b) {
    return analysis::rank(mechanism.bodies[a]) > analysis::rank(mechanism.bodies[b]);
  });
  Json json = {{"text", analysis::describe(mechanism, model)},
               {"rule", analysis::name_of(mechanism.rule)},
               {"moving", mechanism.moving()},
               {"present", mechanism.present()},
               {"work", number_or_null(mechanism.work)},
               {"bodies", Json::object()}};
  for (const std::size_t b : moving) {
    const analysis::BodyMotion& motion = mechanism.bodies[b];
    const std::optional<Vec2> centre = motion.centre();
    json["bodies"][model.bodies[b].name] = {{"largest", number_or_null(motion.largest)},
                                            {"displacement", json_of(motion.shift)},
                                            {"of", json_of(motion.about)},
                                            {"rotation", number_or_null(motion.rotation)},
                                            {"centre", centre ? json_of(*centre) : Json()}};
  }
  return json;
}

Json json_of(const HistoryExtremes& column, bool in_time) {
  const auto value = [](const std::optional<HistoryExtremes::Value>& of) { return of ? Json(of->value) : Json(); };
  const auto place = [](const std::optional<HistoryExtremes::Value>& of) {
    return of ? Json{of->step, of->increment} : Json();
  };
  Json json = {{"last", value(column.last)},
               {"min", value(column.least)},
               {"min_at", place(column.least)},
               {"max", value(column.greatest)},
               {"max_at", place(column.greatest)}};
  if (in_time && column.least) json["min_time"] = column.least->time, json["max_time"] = column.greatest->time;
  return json;
}

/// What moves the ground in each step, along x and y.
Json ground_content(const model::Model& model) {
  Json list = Json::array();
  for (const model::Step& step : model.steps)
    for (std::size_t k = 0; step.dynamic && k < 2; ++k) {
      if (step.dynamic->ground[k] < 0) continue;
      const model::Curve& curve = model.curves[static_cast<std::size_t>(step.dynamic->ground[k])];
      const model::GroundMotion motion = model::ground_motion(curve, step.dynamic->duration, step.dynamic->duration);
      Json entry = {{"step", step.name},
                    {"along", k == 0 ? "x" : "y"},
                    {"curve", curve.name},
                    {"largest_acceleration", number_or_null(motion.largest)},
                    {"velocity_at_end", number_or_null(motion.velocity)},
                    {"displacement_at_end", number_or_null(motion.displacement)}};
      if (curve.record) {
        entry["record"] = {{"file", curve.record->file}, {"of", curve.record->of}};
        if (curve.record->baseline) entry["record"]["baseline"] = *curve.record->baseline;
      }
      list.push_back(std::move(entry));
    }
  return list;
}

Json json_of(const analysis::Timing& timing, bool running) {
  return {{"read", running ? Json() : number_or_null(timing.read)},
          {"mesh", number_or_null(timing.mesh)},
          {"super_elements", number_or_null(timing.super_elements)},
          {"assemble", number_or_null(timing.assemble)},
          {"factorise", number_or_null(timing.factorise)},
          {"condense", number_or_null(timing.condense)},
          {"newton", number_or_null(timing.newton)},
          {"recover", number_or_null(timing.recover)},
          {"write", number_or_null(timing.write)},
          {"total", running ? Json() : number_or_null(timing.total)}};
}

}  // namespace

nlohmann::ordered_json content_of_uniqueness(const analysis::UniquenessResult& uniqueness) {
  return {{"unique", uniqueness.verdict},
          {"others", uniqueness.others},
          {"complete", uniqueness.complete},
          {"bound", number_or_null(uniqueness.bound)},
          {"index", uniqueness.index}};
}

std::string_view name_of(analysis::Outcome outcome) {
  switch (outcome) {
    case analysis::Outcome::solved:
      return "solved";
    case analysis::Outcome::not_converged:
      return "not_converged";
    case analysis::Outcome::mechanism:
      return "mechanism";
    case analysis::Outcome::collapse:
      return "collapse";
    case analysis::Outcome::interrupted:
      return "interrupted";
  }
  throw BrokenInvariant("an outcome without a name");
}

std::string_view name_of(element::CornerKind kind) {
  switch (kind) {
    case element::CornerKind::crack:
      return "crack";
    case element::CornerKind::interface_crack:
      return "interface_crack";
    case element::CornerKind::corner:
      return "corner";
  }
  throw BrokenInvariant("a corner without a name");
}

ModelSizes sizes_of(const analysis::Discretisation& discretisation) {
  ModelSizes sizes;
  sizes.nodes = discretisation.mesh.nodes();
  sizes.dofs = discretisation.mesh.dofs();
  for (const mesh::BodyMesh& body : discretisation.mesh.bodies) {
    sizes.super_elements += body.count(mesh::CellKind::superelement);
    sizes.finite_elements += body.count(mesh::CellKind::finite_element);
  }
  for (const mesh::Interface& interface : discretisation.mesh.interfaces)
    sizes.contact_pairs += static_cast<int>(interface.pairs.size());
  return sizes;
}

ModelSizes sizes_of(const analysis::StaticSolution& solution) {
  const analysis::Discretisation& discretisation = solution;
  ModelSizes sizes = sizes_of(discretisation);
  // Only an increment shows which pairs can move; of all but the last one, the totals remain. Bodies that are added
  // later have none in it.
  if (model::has_stages(solution.model.bodies) || solution.increments.empty() || !solution.increments.front().converged)
    return sizes;
  sizes.contact_pairs = 0;
  for (const analysis::ContactResult& contact : solution.increments.front().contacts)
    sizes.contact_pairs += contact.open + contact.stick + contact.slip;
  return sizes;
}

std::optional<long long> peak_memory() {
  // getrusage() would include the program that started this one.
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key; std::getline(status, key))
    if (long long kilobytes = 0; key == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
  return static_cast<long long>(usage.ru_maxrss) * 1024;
}

std::string summary_content(const analysis::StaticSolution& solution, const analysis::Timing& timing, bool running,
                            const std::vector<HistoryExtremes>& history, std::size_t most) {
  const ModelSizes sizes = sizes_of(solution);
  Json json;
  json["scabo"] = version();
  json["title"] = solution.model.title;
  json["status"] = running ? "running" : name_of(solution.outcome);
  json["reason"] = solution.reason.empty() ? Json() : Json(solution.reason);
  if (solution.mechanism) json["mechanism"] = json_of(*solution.mechanism, solution.model);
  json["warnings"] = texts_of(solution.warnings);
  json["warning_kinds"] = Json::array();
  for (const Warning& warning : solution.warnings) json["warning_kinds"].push_back(name_of(warning.kind));
  json["model"] = {{"nodes", sizes.nodes},
                   {"dofs", sizes.dofs},
                   {"super_elements", sizes.super_elements},
                   {"contact_pairs", sizes.contact_pairs}};
  json["model"].update(model_content(solution.model, solution.mesh));
  json["passes"] = Json::array();
  for (const analysis::RefinementPass& pass : solution.passes)
    json["passes"].push_back({{"dofs", pass.dofs},
                              {"error", number_or_null(pass.error)},
                              {"raised", pass.raised},
                              {"divided", pass.divided}});
  json["increments"] = Json::array();
  for (std::size_t i = 0; i < std::min(most, solution.increments.size()); ++i)
    json["increments"].push_back(json_of(solution.increments[i], solution.model));
  if (solution.grown) json["growth"] = json_of(*solution.grown);
  if (solution.limit) json["limit"] = json_of(*solution.limit, solution.model);
  const bool in_time = model::is_dynamic(solution.model);
  if (model::is_shaken(solution.model)) json["ground"] = ground_content(solution.model);
  if (!history.empty()) {
    json["history"] = Json::object();
    for (const HistoryExtremes& column : history) json["history"][column.column] = json_of(column, in_time);
  }
  json["timing"] = json_of(timing, running);
  json["peak_memory_bytes"] = value_or_null(peak_memory());
  // Texts of the user may not be UTF-8; the results must not be lost because of that.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string failed_summary(const std::string& summary, const std::string& reason) {
  Json json = Json::parse(summary);
  json["status"] = "failed";
  json["reason"] = reason;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string running_summary(const std::string& summary) {
  Json json = Json::parse(summary);
  json["status"] = "running";
  json["reason"] = nullptr;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

namespace {

std::optional<std::string> text_in_summary(const std::string& summary, const char* key) {
  const Json json = Json::parse(summary, nullptr, false);
  if (!json.is_object() || !json.contains(key) || !json[key].is_string()) return std::nullopt;
  return json[key].get<std::string>();
}

}  // namespace

std::optional<std::string> status_of_summary(const std::string& summary) { return text_in_summary(summary, "status"); }

std::optional<std::string> analysis_of_summary(const std::string& summary) {
  return text_in_summary(summary, "analysis");
}

}  // namespace scabo::result
