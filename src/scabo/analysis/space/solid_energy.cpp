#include "scabo/analysis/space/solid_energy.hpp"

#include "scabo/analysis/state/friction_work.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

FrictionWork friction_work_of_solids(const PreparedSolids& prepared, const SolidState& from, const SolidState& to) {
  FrictionWork total;
  const contact::JointLaws before = laws_of_solids(prepared, from.factors),
                           after = laws_of_solids(prepared, to.factors);
  for (std::size_t k = 0; k < prepared.contact().pairs.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const Eigen::Index at = in_space.of(row);
    add_friction_work(
        {*before.of_pair[k], *after.of_pair[k], after.area[row], from.history[k], to.history[k], from.p[at], to.p[at],
         from.p.segment<2>(at + 1), to.p.segment<2>(at + 1),
         to.slip.segment<2>(2 * row) - from.slip.segment<2>(2 * row), from.gap[row], from.states[k], to.states[k]},
        total);
  }
  return total;
}

/// What temperatures and preloads add to 1/2 u'K u: the strain they cause in a free body takes no energy.
double initial_energy_of_solid(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t b,
                               const AppliedToSolids& applied, const Vector& u) {
  double energy = 0.0;
  for (std::size_t i = 0; i < prepared.model.preloads.size(); ++i)
    if (const SolidPreload& preload = prepared.model.preloads[i]; preload.body == static_cast<int>(b))
      energy += preload.cut.energy(applied.shortening[static_cast<Eigen::Index>(i)], u);
  if (applied.heated[b].size() == 0) return energy;
  const SolidBody& body = prepared.model.bodies[b];
  energy += system::held_thermal_energy(body.mesh, elasticity_of(body), body.expansion, applied.heated[b], body.solved);
  for (std::size_t load = 0; load < prepared.model.loads.size(); ++load)
    if (prepared.model.temperatures[load][b].size() > 0)
      energy -= factors.presence_of(b) * factors.loads[static_cast<Eigen::Index>(load)] *
                u.dot(prepared.model.loads[load][b]);
  return energy;
}

/// Of the displacements that supports prescribe which begin or end.
double work_of_held_points(const PreparedSolids& prepared, const SolidState& from, const SolidState& to) {
  double work = 0.0;
  const std::vector<system::ContactSystem::Pair>& pairs = prepared.contact().pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!prepared.is_held_point(pairs[i])) continue;
    const std::size_t point = prepared.held_point(pairs[i]);
    const Eigen::Index row = in_space.of(static_cast<Eigen::Index>(i));
    work += 0.5 * (from.p[row] + to.p[row]) *
            (displacement_of_held_point(prepared, to.factors, point) -
             (from.factors.supports.size() > 0 ? displacement_of_held_point(prepared, from.factors, point) : 0.0));
  }
  return work;
}

}  // namespace

double elastic_energy_of_solid(const PreparedSolids& prepared, const SolidFactors& factors, const MovedSolids& moved,
                               std::size_t b) {
  return prepared.structure.parts[b]->elastic_energy(moved.u[b], moved.forces[b], moved.unbalanced[b]) +
         initial_energy_of_solid(prepared, factors, b, moved.applied, moved.u[b]);
}

Energy energy_of_solids(const PreparedSolids& prepared, const SolidState& from, const MovedSolids& before,
                        const SolidState& to, const MovedSolids& after) {
  Energy energy = from.energy;
  energy.elastic = 0.0;
  for (std::size_t i = 0; i < after.u.size(); ++i) {
    energy.external += 0.5 * (before.applied.forces[i] + after.applied.forces[i]).dot(after.u[i] - before.u[i]);
    energy.external +=
        0.5 *
        (before.reactions[i] + after.reactions[i]).dot(after.applied.prescribed[i] - before.applied.prescribed[i]);
    if (prepared.is_absent(i)) continue;
    energy.elastic += elastic_energy_of_solid(prepared, to.factors, after, i);
    energy.external += initial_energy_of_solid(prepared, to.factors, i, after.applied, after.u[i]) -
                       initial_energy_of_solid(prepared, from.factors, i, before.applied, before.u[i]);
  }
  energy.external += work_of_held_points(prepared, from, to);
  const Vector normal = to.p(Eigen::seqN(0, to.p.size() / in_space.dimension, in_space.dimension));
  energy.elastic += 0.5 * prepared.contact().softness.dot(normal.cwiseAbs2());
  const FrictionWork friction = friction_work_of_solids(prepared, from, to);
  energy.friction += friction.work;
  energy.external += friction.beyond_rule;
  energy.friction_error += friction.error;
  return energy;
}

}  // namespace scabo::analysis
