#include "scabo/analysis/growth/longer_pairs.hpp"

#include <algorithm>

namespace scabo::analysis {

namespace {

bool is_between_faces(const model::Contact& contact, const Tip& tip) {
  return contact.a.kind == model::Place::Kind::face && contact.a.body == tip.body && contact.a.index / 2 == tip.crack;
}

}  // namespace

State on_longer(const Prepared& longer, const Prepared& shorter, const State& from, const std::vector<Tip>& tips) {
  CarriedPairs before = pairs_to_carry(shorter, from, &longer.model);
  for (std::size_t c = 0; c < before.size(); ++c)
    for (const Tip& tip : tips) {
      if (!is_between_faces(longer.model.contacts[c], tip)) continue;
      CarriedPair& at_tip = before[c].emplace_back();
      at_tip.at_a = at_tip.at_b = arc_length_on(crack_of(longer.model, tip), position_of(shorter.model, tip));
      at_tip.history.broken = true;
    }
  const std::vector<CarriedPair> carried = carried_to(longer, before);
  State state = initial_state(longer);
  state.factors = from.factors;
  state.rigid_motion = from.rigid_motion;
  state.largest_force = from.largest_force;
  state.energy = from.energy;
  for (std::size_t i = 0; i < carried.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    state.p[2 * k] = carried[i].pressure * longer.contact.laws.area[k];
    state.p[2 * k + 1] = carried[i].shear * longer.contact.laws.area[k];
    state.slip[k] = carried[i].slip;
    state.history[i] = carried[i].history;
    if (carried[i].closed)
      state.states[i] = carried[i].direction != 0 ? contact::ContactState::slip : contact::ContactState::stick;
  }
  complete(longer, state);
  return state;
}

bool is_stuck(const Prepared& prepared, const State& state, const Tip& tip) {
  if (!has_contact(prepared.model, tip)) return false;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i)
    if (is_between_faces(prepared.model.contacts[static_cast<std::size_t>(prepared.contact.pairs[i].contact)], tip) &&
        state.states[i] != contact::ContactState::stick)
      return false;
  return true;
}

bool has_contact(const model::Model& model, const Tip& tip) {
  return std::any_of(model.contacts.begin(), model.contacts.end(),
                     [&](const model::Contact& contact) { return is_between_faces(contact, tip); });
}

}  // namespace scabo::analysis
