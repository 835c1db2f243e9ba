#include "scabo/analysis/quasistatic/stages.hpp"

#include <algorithm>
#include <utility>

#include "scabo/analysis/state/balance.hpp"
#include "scabo/analysis/state/fields.hpp"
#include "scabo/analysis/state/pair_motions.hpp"
#include "scabo/analysis/state/step_factors.hpp"
#include "scabo/system/fewer_parts.hpp"

namespace scabo::analysis {

namespace {

using Pair = system::ContactSystem::Pair;

/// Per part: not there during a step.
std::vector<char> absent_in(const Prepared& whole, std::size_t step) {
  if (!model::has_stages(whole.model.bodies)) return {};
  std::vector<char> absent(whole.structure.parts.size(), 0);
  for (std::size_t b = 0; b < whole.model.bodies.size(); ++b)
    if (!whole.model.bodies[b].is_there(static_cast<int>(step)))
      absent[whole.structure.dofs.part_of(static_cast<int>(b))] = 1;
  if (std::none_of(absent.begin(), absent.end(), [](char is) { return is != 0; })) absent.clear();
  return absent;
}

/// Per bar and held point: it does not act in a step.
std::vector<char> waiting_in(const Prepared& whole, std::size_t step) {
  std::vector<char> waiting;
  const auto number = static_cast<int>(step);
  for (const model::Bar& bar : whole.model.bars) waiting.push_back(bar.acts_in(number) ? 0 : 1);
  for (const system::BarSystem& bar : whole.structure.bars)
    if (bar.held)
      waiting.push_back(whole.model.supports[static_cast<std::size_t>(bar.held->support)].is_there(number) ? 0 : 1);
  if (std::none_of(waiting.begin(), waiting.end(), [](char does) { return does != 0; })) waiting.clear();
  return waiting;
}

/// A pair counts its motion from its placing: minus the motion so far of the new ones.
void set_offsets(const std::vector<Eigen::Index>& places, const Vector& motion, Vector& offset) {
  if (offset.size() == 0) offset = Vector::Zero(motion.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const auto row = static_cast<Eigen::Index>(2 * i); places[i] < 0)
      offset.segment<2>(row) = -motion.segment<2>(row);
}

/// The parts of both sides of a pair.
std::pair<std::size_t, std::size_t> parts_of(const Prepared& prepared, const Pair& pair) {
  if (pair.is_bar()) {
    const system::BarSystem& bar = prepared.structure.bars[static_cast<std::size_t>(pair.index)];
    return {bar.a.part, bar.b.part};
  }
  const model::Contact& contact = prepared.model.contacts[static_cast<std::size_t>(pair.contact)];
  return {prepared.structure.dofs.part_of(contact.a.body), prepared.structure.dofs.part_of(contact.b.body)};
}

/// Takes the bodies of parts that are no longer there, and supports that end, out of a state: what they exerted on the
/// others is released. `waiting`: per bar and held point.
void take_away(const Prepared& before, const std::vector<char>& absent, const std::vector<char>& waiting,
               std::size_t step, State& state) {
  state.released.assign(absent.size(), Vector());
  if (model::has_stages(before.model.supports)) {
    const std::vector<Eigen::Vector3d> exerted = reactions_of_held_points(before, state);
    for (std::size_t i = 0; i < exerted.size(); ++i)
      for (const double component : exerted[i])
        state.released_reactions.push_back(before.model.supports[i].removed == static_cast<int>(step) ? component
                                                                                                      : 0.0);
  }
  Vector vanishing = Vector::Zero(state.p.size());  // forces of the pairs of what is taken away
  const auto gone = [&](std::size_t p) { return p != system::PairSide::ground && absent[p] && !before.is_absent(p); };
  for (std::size_t i = 0; i < before.contact.pairs.size(); ++i) {
    const Pair& pair = before.contact.pairs[i];
    const auto [a, b] = parts_of(before, pair);
    const auto row = static_cast<Eigen::Index>(2 * i);
    const bool ends = pair.is_bar() && !waiting.empty() && waiting[static_cast<std::size_t>(pair.index)];
    if (!gone(a) && !gone(b) && !ends) continue;
    vanishing.segment<2>(row) = state.p.segment<2>(row);
    // What springs between the sides have stored leaves with them.
    state.energy.external -= 0.5 * before.contact.softness[static_cast<Eigen::Index>(i)] * state.p[row] * state.p[row];
  }
  for (std::size_t p = 0; p < absent.size(); ++p) {
    if (!absent[p]) {
      const Vector forces = before.contact.motion[p].transpose() * vanishing;
      if (forces.size() > 0 && !forces.isZero(0.0)) state.released[p] = forces;
      continue;
    }
    if (!gone(p)) continue;
    state.energy.external -=
        before.structure.parts[p]->elastic_energy(state.u[p]) + thermal_energy(before, state.factors, p, state.u[p]);
    for (Vector* of : {&state.u[p], &state.forces[p], &state.reactions[p], &state.prescribed[p]}) of->setZero();
  }
  for (std::size_t p = 0; p < absent.size(); ++p)
    if (state.released[p].size() > 0) state.forces[p] += state.released[p];
}

/// Parts that are put in place are not displaced yet: what the reference points of the others have moved so far does
/// not count for them.
void refer_new_parts(const Prepared& whole, const std::vector<char>& before, const std::vector<char>& absent,
                     State& state) {
  if (whole.references.empty() || before.empty()) return;
  state.referred.resize(whole.structure.parts.size(), Vec2::Zero());
  for (const Reference& reference : whole.references)
    for (const int number : reference.parts) {
      const auto p = static_cast<std::size_t>(number);
      if (before[p] && (absent.empty() || !absent[p])) state.referred[p] = displacement_of(reference, whole, state.u);
    }
}

}  // namespace

Stages::Stages(const Prepared& whole, std::size_t step) : whole_(whole) {
  set(absent_in(whole, step), waiting_in(whole, step));
}

void Stages::set(std::vector<char> absent, std::vector<char> waiting) {
  now_.reset();
  contact_.reset();
  waiting_ = std::move(waiting);
  if (absent.empty() && waiting_.empty()) return;
  if (absent.empty()) absent.assign(whole_.structure.parts.size(), 0);
  contact_ = system::without_parts(whole_.contact, whole_.structure, whole_.model, absent, waiting_);
  now_.emplace(whole_.discretisation, *contact_, whole_.on_iteration, std::move(absent));
}

void Stages::enter(std::size_t step, State& state) {
  std::vector<char> waiting = waiting_in(whole_, step);
  const bool has_stages = model::has_stages(whole_.model.bodies) || model::has_stages(whole_.model.supports);
  if (!has_stages && waiting == waiting_) return;
  state.factors.presence = presence_at(whole_.model, static_cast<int>(step) - 1);
  state.factors.release = takes_away(whole_.model, step) ? 1.0 : 0.0;
  state.released.clear();
  state.released_reactions.clear();
  std::vector<char> absent = absent_in(whole_, step);
  const std::vector<char> none(whole_.structure.parts.size(), 0);
  const auto all_there = [&](const std::vector<char>& of) { return of.empty() || of == none; };
  if (waiting == waiting_ && (absent == now().absent || (all_there(absent) && all_there(now().absent)))) return;

  const std::vector<Pair> pairs_before = now().contact.pairs, held_before = now().contact.held;
  const std::vector<int> first_before = now().contact.first_rigid;
  const std::vector<char> absent_before = now().absent;
  if (takes_away(whole_.model, step)) take_away(now(), absent.empty() ? none : absent, waiting, step, state);
  refer_new_parts(whole_, absent_before, absent, state);
  set(std::move(absent), std::move(waiting));
  const system::ContactSystem& contact = now().contact;

  ParentMaps maps{system::places_in(pairs_before, contact.pairs), system::places_in(held_before, contact.held), {}};
  maps.rigid_motions.assign(static_cast<std::size_t>(contact.rigid_motions()), -1);
  for (std::size_t part = 0; part < whole_.structure.parts.size(); ++part) {
    const bool was_absent = !absent_before.empty() && absent_before[part];
    if (was_absent || now().is_absent(part)) continue;
    for (Eigen::Index k = 0; k < whole_.structure.parts[part]->rigid_motions().cols(); ++k)
      maps.rigid_motions[static_cast<std::size_t>(contact.first_rigid[part] + k)] = first_before[part] + k;
  }
  state = transfer(std::move(state), maps);
  for (std::size_t i = 0; i < maps.pairs.size(); ++i)
    if (maps.pairs[i] < 0) state.gap[static_cast<Eigen::Index>(i)] = contact.gap[static_cast<Eigen::Index>(i)];
  set_offsets(maps.pairs, motion_under(contact.motion, state.u, static_cast<Eigen::Index>(2 * contact.pairs.size())),
              state.offset);
  set_offsets(maps.held_pairs,
              motion_under(contact.held_motion, state.u, static_cast<Eigen::Index>(2 * contact.held.size())),
              state.held_offset);
}

}  // namespace scabo::analysis
