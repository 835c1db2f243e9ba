#include "scabo/analysis/diagnostics/near_collapse.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/analysis/state/loads.hpp"
#include "scabo/analysis/state/restart.hpp"
#include "scabo/analysis/state/step_factors.hpp"

namespace scabo::analysis {

namespace {

/// Friction over elastic energy from which it is told. Walls of 16 x 16 and 24 x 24 blocks with friction 0.6 that are
/// pushed reach 0.3 to 1.2 at 0.9 of their limit load and 3.5 to 180 from 0.95 on
/// (docs/decisions/0059-bodies-near-their-collapse.md).
constexpr double worth_telling = 3.0;

/// Energy that friction has dissipated before a step.
double friction_before(const Prepared& prepared, const std::vector<IncrementResult>& before, std::size_t step) {
  for (auto increment = before.rbegin(); increment != before.rend(); ++increment)
    if (increment->step <= static_cast<int>(step)) return increment->energy.friction;
  return prepared.model.restart ? state_of_restart(prepared).energy.friction : 0.0;
}

/// Whether temperatures change in a step: bodies that expand slide as far as they like.
bool is_heated(const model::Model& model, const Factors& before, const Factors& now) {
  for (std::size_t load = 0; load < model.loads.size(); ++load)
    if (std::holds_alternative<model::Temperature>(model.loads[load].kind) && before.loads[load] != now.loads[load])
      return true;
  return false;
}

/// Whether nothing but forces that grow steadily moves the bodies in a step.
bool only_loads_grow(const Prepared& prepared, const State& state, std::size_t index) {
  const model::Model& model = prepared.model;
  const model::Step& step = model.steps[index];
  if (!model.springs.empty() || !model.bars.empty() || model::has_stages(model.supports) || !step.load_curves.empty() ||
      !step.support_curves.empty() || model::has_large_slip(model.contacts))
    return false;
  const Factors before = factors_in(model, index, 0.0);
  return !is_heated(model, before, state.factors) &&
         prescribed_values(prepared, before.supports, {}) == prescribed_values(prepared, state.factors.supports, {});
}

/// Whether pairs that did not touch as the bodies are drawn do now.
bool gaps_closed(const Prepared& prepared, const State& state) {
  const std::vector<bool> touching = touching_pairs(prepared);
  for (std::size_t i = 0; i < touching.size(); ++i)
    if (!touching[i] && state.states[i] != contact::ContactState::open) return true;
  return false;
}

/// What the largest force would store in the stiffest node: of ground at rest under its weight hardly any energy is
/// counted, and what rounding lets slide would be many times as much.
double energy_at_one_node(const Prepared& prepared, const State& state) {
  double stiffness = 0.0;
  for (std::size_t p = 0; p < state.u.size(); ++p)
    if (!prepared.is_absent(p) && state.u[p].size() > 0)
      stiffness = std::max(stiffness, prepared.structure.parts[p]->stiff_force(Vector::Ones(state.u[p].size())));
  return stiffness > 0.0 ? 0.5 * state.largest_force * state.largest_force / stiffness : 0.0;
}

/// The body whose sides have moved farthest, and how far.
std::string farthest(const Prepared& prepared, const State& state) {
  double largest = -1.0;
  int body = 0;
  for (const system::ContactSystem::Pair& at : prepared.contact.pairs) {
    if (at.is_bar()) continue;
    const model::Contact& contact = prepared.model.contacts[static_cast<std::size_t>(at.contact)];
    for (const int side : {0, 1}) {
      const double moved = displacement_of(prepared, state, at.contact, mesh_pair(prepared, at), side).norm();
      if (moved > largest) largest = moved, body = side == 0 ? contact.a.body : contact.b.body;
    }
  }
  return fmt::format("body '{}' has moved by {:.3g}", prepared.model.bodies[static_cast<std::size_t>(body)].name,
                     largest);
}

}  // namespace

std::string near_collapse(const Prepared& prepared, const State& state, const std::vector<IncrementResult>& before,
                          std::size_t step) {
  if (prepared.contact.rigid_motions() == 0 || !only_loads_grow(prepared, state, step)) return {};
  double stored = std::max(state.energy.elastic, energy_at_one_node(prepared, state));
  for (const IncrementResult& increment : before) stored = std::max(stored, increment.energy.elastic);
  const double slid = state.energy.friction - friction_before(prepared, before, step);
  if (!(stored > 0.0) || !(slid > worth_telling * stored) || gaps_closed(prepared, state)) return {};
  return fmt::format(
      "friction has dissipated {:.2g} times the energy that the bodies store while the loads of this step grew ({}): "
      "they are close to the load under which they slide or fall, and whether they come to rest once they move is not "
      "a question of statics; compare the displacements of smaller increments, and keep a distance from this load",
      slid / stored, farthest(prepared, state));
}

}  // namespace scabo::analysis
