#include "scabo/result/solid/solid_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scabo/analysis/space/solid_mechanism.hpp"

namespace scabo::result {

namespace {

using Json = nlohmann::ordered_json;

Json components_of(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

}  // namespace

Json content_of_mechanism(const analysis::SolidMechanism& mechanism, const analysis::SolidModel& model) {
  Json json = {{"text", analysis::describe(mechanism, model)},
               {"rule", mechanism.rule == analysis::FlowRule::coulomb ? "coulomb" : "associated"},
               {"moving", std::count_if(mechanism.bodies.begin(), mechanism.bodies.end(),
                                        [](const analysis::SolidBodyMotion& body) { return body.moves(); })},
               {"present", mechanism.present()},
               {"work", mechanism.work},
               {"bodies", Json::object()}};
  for (std::size_t b = 0; b < mechanism.bodies.size(); ++b) {
    const analysis::SolidBodyMotion& motion = mechanism.bodies[b];
    if (!motion.moves()) continue;
    const std::optional<Eigen::Vector3d> axis = motion.axis();
    json["bodies"][model.bodies[b].name] = {{"largest", motion.largest},
                                            {"displacement", components_of(motion.shift)},
                                            {"of", components_of(motion.about)},
                                            {"rotation", components_of(motion.rotation)},
                                            {"centre", axis ? components_of(*axis) : Json()}};
  }
  return json;
}

void note_warnings(const model::SpaceModel& model, const Json& increment, const std::vector<Warning>& given,
                   Json& texts, std::vector<Warning>& warnings) {
  for (const Warning& warning : given) {
    const bool told = std::any_of(texts.begin(), texts.end(), [&](const Json& text) {
      return text.get_ref<const std::string&>().ends_with(": " + warning.text);
    });
    if (told) continue;
    const model::Step& step = model.steps[increment["step"].get<std::size_t>() - 1];
    warnings.push_back(
        {warning.kind, warning.subject,
         fmt::format("step {}, increment {}: {}", step.name, increment["increment"].get<int>(), warning.text)});
    texts.push_back(warnings.back().text);
  }
}

void note_few_pairs(const model::SpaceModel& model, const Json& last, Json& texts, std::vector<Warning>& warnings) {
  constexpr int fewest_pairs = 4;  // three say nothing about how the pressure is distributed
  const auto is_rigid = [&](const model::SpaceFace& side) {
    return model.bodies[static_cast<std::size_t>(side.body)].rigid;
  };
  for (const model::SpaceContact& contact : model.contacts) {
    if (contact.tied || (is_rigid(contact.a) && is_rigid(contact.b)) || !last["contacts"].contains(contact.name))
      continue;
    const Json& of = last["contacts"][contact.name];
    const int closed = of["stick"].get<int>() + of["slip"].get<int>(), all = closed + of["open"].get<int>();
    if (closed == 0 || closed >= fewest_pairs || all < fewest_pairs) continue;
    const std::string subject = fmt::format("contact '{}'", contact.name);
    warnings.push_back(
        {WarningKind::few_pairs, subject,
         fmt::format("{}: only {} of {} pairs {} in contact at the end, and the mesh is too coarse for the zone that "
                     "touches: pressures and displacements are not reliable; use smaller elements there",
                     subject, closed, all, closed == 1 ? "is" : "are")});
    texts.push_back(warnings.back().text);
  }
}

}  // namespace scabo::result
