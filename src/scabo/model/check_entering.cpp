// Validation of fluids that enter contacts where they open.
#include <fmt/format.h>

#include <algorithm>

#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

/// The first thing of the model with which a state that fluids have entered does not go.
const char* what_is_beside(const Model& model) {
  const bool refined = model.tolerance || model.output.error || !model.output.error_of.empty() ||
                       std::any_of(model.bodies.begin(), model.bodies.end(),
                                   [](const Body& body) { return body.mesh.tolerance.has_value(); });
  return is_dynamic(model)                ? "steps in time"
         : has_growth(model)              ? "cracks that grow"
         : has_large_slip(model.contacts) ? "contacts with 'slip: large'"
         : has_stages(model.bodies)       ? "bodies that are added or removed"
         : model.restart                  ? "a restart"
         : refined                        ? "error bars and tolerances"
                                          : nullptr;
}

/// Why a fluid cannot enter a contact as it opens; empty if it can.
std::string why_not_into(const Model& model, const Contact& contact) {
  const auto is_rigid = [&](const Place& side) { return model.bodies[static_cast<std::size_t>(side.body)].rigid; };
  if (contact.bond) return fmt::format("contact '{}' is bonded and does not open: leave 'enters' out", contact.name);
  if (contact.a.kind == Place::Kind::face)
    return fmt::format("the faces of the crack '{}' are filled as a whole: leave 'enters' out", contact.name);
  if (is_rigid(contact.a) && is_rigid(contact.b))
    return fmt::format(
        "contact '{}' is between two rigid bodies, whose two pairs do not say how far it opens: make one "
        "of them elastic",
        contact.name);
  return {};
}

}  // namespace

void check_entering(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const auto* pores = std::get_if<PorePressure>(&model.loads[i].kind);
    if (!pores || !pores->enters || !checking.load[i]) continue;
    const std::string path = path_of("loads", model.loads[i].name, i);
    checking.enter(model.loads[i].source);
    if (const char* beside = what_is_beside(model))
      checking.error(
          path, "enters",
          fmt::format("a fluid that enters a contact is not available beside {}: leave one of them out", beside));
    for (const int c : pores->contacts) {
      const std::string why = why_not_into(model, model.contacts[static_cast<std::size_t>(c)]);
      if (why.empty()) continue;
      checking.error(path, "enters", why);
      break;
    }
  }
}

}  // namespace scabo::model
