#include "scabo/analysis/space/solid_stages.hpp"

#include <algorithm>

#include "scabo/analysis/space/solid_bars.hpp"
#include "scabo/analysis/space/solid_energy.hpp"
#include "scabo/analysis/space/solid_fields.hpp"
#include "scabo/analysis/state/pair_motions.hpp"
#include "scabo/system/fewer_parts.hpp"

namespace scabo::analysis {

namespace {

using Pair = system::ContactSystem::Pair;

/// A pair counts its motion from its placing: minus the motion so far of the new ones.
void set_offsets(const std::vector<Eigen::Index>& places, const std::vector<Eigen::SparseMatrix<double>>& motion,
                 const std::vector<Vector>& u, Vector& offset) {
  if (motion.empty()) return;
  const Eigen::Index rows = in_space.count(static_cast<Eigen::Index>(places.size()));
  const Vector moved = motion_under(motion, u, rows);
  if (offset.size() == 0) offset = Vector::Zero(rows);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const Eigen::Index row = in_space.of(static_cast<Eigen::Index>(i)); places[i] < 0)
      offset.segment<3>(row) = -moved.segment<3>(row);
}

/// Takes the bodies that are no longer there, and supports that end in a step, out of a state: what they exerted on the
/// others is released. `absent`: one for each body.
void take_away(const PreparedSolids& before, const std::vector<char>& absent, int step, const MovedSolids& moved,
               SolidState& state) {
  const system::ContactSystem& contact = before.contact();
  const auto gone = [&](std::size_t part) {
    return part != system::PairSide::ground && absent[part] != 0 && !before.is_absent(part);
  };
  const auto ends = [&](const Pair& pair) {
    return before.is_held_point(pair) && before.model.held_points[before.held_point(pair)].stay.removed == step;
  };
  const Vector reactions = reactions_of_held_points(before, state.p, 0.0, {});
  state.released_points = Vector::Zero(reactions.size());
  Vector vanishing = Vector::Zero(state.p.size());  // forces of the pairs of what is taken away
  for (std::size_t i = 0; i < contact.pairs.size(); ++i) {
    const system::PairPoints& points = before.paired.points[static_cast<std::size_t>(contact.pairs[i].index)];
    const bool let_go = ends(contact.pairs[i]);
    if (!gone(points.a.part) && !gone(points.b.part) && !let_go) continue;
    if (let_go && !gone(points.b.part)) {
      const auto point = static_cast<Eigen::Index>(before.held_point(contact.pairs[i]));
      state.released_points[point] = reactions[point];
    }
    const auto row = static_cast<Eigen::Index>(i);
    vanishing.segment<3>(in_space.of(row)) = state.p.segment<3>(in_space.of(row));
    if (before.is_bar(contact.pairs[i]))
      vanishing[in_space.of(row)] -= given_tension(before, state.factors, before.bar(contact.pairs[i]));
    state.energy.external -= 0.5 * contact.softness[row] * state.p[in_space.of(row)] * state.p[in_space.of(row)];
  }
  state.released.assign(absent.size(), Vector());
  for (std::size_t b = 0; b < absent.size(); ++b) {
    if (gone(b)) state.energy.external -= elastic_energy_of_solid(before, state.factors, moved, b);
    if (absent[b] != 0) continue;
    Vector forces = contact.motion[b].transpose() * vanishing;
    if (!forces.isZero(0.0)) state.released[b] = std::move(forces);
  }
  for (std::size_t i = 0; i < before.model.preloads.size(); ++i)
    if (absent[static_cast<std::size_t>(before.model.preloads[i].body)])
      state.shortening[static_cast<Eigen::Index>(i)] = 0.0;
}

}  // namespace

Vector presence_at(const SolidModel& model, int step) {
  if (!model.has_stages()) return {};
  Vector presence(static_cast<Eigen::Index>(model.bodies.size()));
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    presence[static_cast<Eigen::Index>(b)] = model.bodies[b].stay.is_there(step) ? 1.0 : 0.0;
  return presence;
}

bool takes_away(const SolidModel& model, int step) {
  const auto ends = [&](const auto& of) { return of.stay.removed == step; };
  return std::any_of(model.bodies.begin(), model.bodies.end(), ends) ||
         std::any_of(model.held_points.begin(), model.held_points.end(), ends);
}

void enter_step(PreparedSolids& prepared, int step, SolidState& state, MovedSolids& moved) {
  const SolidModel& model = prepared.model;
  if (!model.has_stages()) return;
  const bool takes = takes_away(model, step);
  state.factors.presence = presence_at(model, step - 1);
  state.factors.release = takes ? 1.0 : 0.0;
  state.released.clear();
  state.released_points.resize(0);
  const auto changes = [&](const auto& of) { return of.stay.is_there(step) != of.stay.is_there(step - 1); };
  if (std::none_of(model.bodies.begin(), model.bodies.end(), changes) &&
      std::none_of(model.held_points.begin(), model.held_points.end(), changes) &&
      std::none_of(model.bars.begin(), model.bars.end(), changes))
    return;
  const std::vector<char> absent_before = prepared.absent;

  const system::ContactSystem& before = prepared.contact();
  const std::vector<Pair> pairs_before = before.pairs, held_before = before.held;
  const std::vector<int> first_before = before.first_rigid;
  if (takes) {
    std::vector<char> absent = absent_in(model, step);
    absent.resize(model.bodies.size(), 0);
    take_away(prepared, absent, step, moved, state);
  }
  set_stage(prepared, step);
  const system::ContactSystem& contact = prepared.contact();
  ParentMaps maps{system::places_in(pairs_before, contact.pairs), system::places_in(held_before, contact.held), {}};
  maps.rigid_motions.assign(static_cast<std::size_t>(contact.rigid_motions()), -1);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if ((!absent_before.empty() && absent_before[b]) || prepared.is_absent(b)) continue;
    for (Eigen::Index k = 0; k < prepared.structure.parts[b]->rigid_motions().cols(); ++k)
      maps.rigid_motions[static_cast<std::size_t>(contact.first_rigid[b] + k)] = first_before[b] + k;
  }
  state = transfer(std::move(state), maps, fields_of_solid_state());
  for (std::size_t i = 0; i < maps.pairs.size(); ++i)
    if (maps.pairs[i] < 0) state.gap[static_cast<Eigen::Index>(i)] = contact.gap[static_cast<Eigen::Index>(i)];
  moved = moved_solids(prepared, applied_to_solids(prepared, state.factors, state.shortening, state.released), state.p,
                       state.a);
  set_offsets(maps.pairs, contact.motion, moved.u, state.offset);
  set_offsets(maps.held_pairs, contact.held_motion, moved.u, state.held_offset);
}

}  // namespace scabo::analysis
