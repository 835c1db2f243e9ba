#include "scabo/analysis/state/state.hpp"

#include <algorithm>

#include "scabo/analysis/state/loads.hpp"

namespace scabo::analysis {

const mesh::ContactPair& mesh_pair(const Prepared& prepared, const system::ContactSystem::Pair& at) {
  return prepared.mesh.interfaces[static_cast<std::size_t>(at.contact)].pairs[static_cast<std::size_t>(at.index)];
}

bool is_held_point(const Prepared& prepared, const system::ContactSystem::Pair& at) {
  return at.is_bar() && prepared.structure.bars[static_cast<std::size_t>(at.index)].held.has_value();
}

Vec2 normal_of(const Prepared& prepared, const system::ContactSystem::Pair& at) {
  return at.is_bar() ? prepared.structure.bars[static_cast<std::size_t>(at.index)].direction
                     : mesh_pair(prepared, at).normal;
}

const system::BodySystem& part_of(const Prepared& prepared, int body) {
  return *prepared.structure.parts[prepared.structure.dofs.part_of(body)];
}

std::vector<bool> touching_pairs(const Prepared& prepared) {
  constexpr double rounding_of_points = 1e-9;  // of a body's size
  std::vector<bool> touching;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    if (prepared.contact.pairs[i].is_bar()) {
      touching.push_back(true);
      continue;
    }
    const model::Contact& contact =
        prepared.model.contacts[static_cast<std::size_t>(prepared.contact.pairs[i].contact)];
    const double size = std::max(part_of(prepared, contact.a.body).lever(), part_of(prepared, contact.b.body).lever());
    touching.push_back(prepared.contact.gap[static_cast<Eigen::Index>(i)] <= rounding_of_points * size);
  }
  return touching;
}

State initial_state(const Prepared& prepared) {
  State state;
  state.factors = {std::vector<double>(prepared.model.loads.size(), 0.0),
                   std::vector<double>(prepared.model.supports.size(), 0.0), coefficients_at_start(prepared.model)};
  state.factors.fits = fits_at(prepared.model, -1);
  state.factors.preloads = preloads_at(prepared.model, -1);
  const auto N = static_cast<Eigen::Index>(prepared.contact.pairs.size());
  state.p = Vector::Zero(2 * N);
  state.rigid_motion = Vector::Zero(prepared.contact.rigid_motions());
  state.gap = prepared.contact.gap;
  for (Eigen::Index i = 0; i < N; ++i) state.gap[i] = gap_at(prepared, state.factors, i);
  state.slip = Vector::Zero(N);
  state.history.assign(prepared.contact.pairs.size(), {});
  state.states.assign(prepared.contact.pairs.size(), contact::ContactState::open);
  state.forces = applied_forces(prepared, state.factors, state.released);
  state.prescribed = prescribed_values(prepared, state.factors.supports, {});
  for (const auto& part : prepared.structure.parts) {
    state.u.push_back(Vector::Zero(part->size()));
    state.reactions.push_back(Vector::Zero(static_cast<Eigen::Index>(part->constraints().size())));
  }
  return state;
}

Vec2 unplaced_motion(const Prepared& prepared, const Replacing& replaced, int contact) {
  Vec2 motion = Vec2::Zero();
  if (replaced.moved.empty()) return motion;
  const auto c = static_cast<std::size_t>(contact);
  const model::Contact& named = prepared.model.contacts[c];
  motion += replaced.moved[prepared.structure.dofs.part_of(named.b.body)];
  motion -= replaced.moved[prepared.structure.dofs.part_of(named.a.body)];
  return motion - (replaced.placement[c][1] - replaced.placement[c][0]);
}

}  // namespace scabo::analysis
