#include "scabo/analysis/growth/growth_energy.hpp"

#include "scabo/analysis/growth/critical.hpp"
#include "scabo/analysis/state/loads.hpp"

namespace scabo::analysis {

RestEnergy rest_energy(const Prepared& prepared, const State& state) {
  RestEnergy energy;
  for (std::size_t p = 0; p < state.u.size(); ++p) {
    energy.of_loads += state.forces[p].dot(state.u[p]);
    energy.of_supports += state.reactions[p].dot(state.prescribed[p]);
    if (state.p.size() > 0) energy.of_pairs += state.p.dot(prepared.contact.motion[p] * state.u[p]);
  }
  return energy;
}

State times(double by, State state) {
  for (std::vector<Vector>* values : {&state.u, &state.forces, &state.reactions, &state.prescribed})
    for (Vector& of_part : *values) of_part *= by;
  state.energy.elastic *= by * by;
  return state;
}

double elastic_energy(const Prepared& prepared, const State& state) {
  double energy = 0.0;
  for (std::size_t p = 0; p < state.u.size(); ++p) energy += prepared.structure.parts[p]->elastic_energy(state.u[p]);
  return energy;
}

GrowthEnergy energy_of_growth(const Prepared& prepared, const RestEnergy& A, const ClosedGrowth& C,
                              const StoringState& longer, const StoringState& next, double integral) {
  const State &O = longer.state, &B = next.state;
  GrowthEnergy energy;
  for (std::size_t p = 0; p < B.u.size(); ++p) {
    const Vector opened = -C.moved[p], moved = B.u[p] - O.u[p];
    energy.external += O.forces[p].dot(opened) + 0.5 * (O.forces[p] + B.forces[p]).dot(moved);
    energy.external += 0.5 * (O.reactions[p] + B.reactions[p]).dot(B.prescribed[p] - O.prescribed[p]);
    if (B.p.size() > 0) {
      const auto& motion = prepared.contact.motion[p];
      energy.contact -= O.p.dot(motion * opened) + 0.5 * (O.p + B.p).dot(motion * moved);
    }
  }
  energy.elastic = next.elastic - longer.elastic - C.elastic;
  energy.released = C.released;
  energy.integral = integral;
  energy.remeshing = A.potential() - rest_energy(prepared, O).potential() - C.released;
  return energy;
}

void add_conjugates(const Prepared& prepared, const State& state, GrowthResult& growth) {
  const Factors none = factors_at(prepared.model, 0.0), whole = factors_at(prepared.model, 1.0);
  if (whole.loads != none.loads) {
    const std::vector<Vector> from = applied_forces(prepared, none, state.released),
                              to = applied_forces(prepared, whole, state.released);
    growth.displacement = 0.0;
    for (std::size_t p = 0; p < to.size(); ++p) *growth.displacement += (to[p] - from[p]).dot(state.u[p]);
  }
  if (whole.supports != none.supports) {
    const std::vector<Vector> from = prescribed_values(prepared, none.supports, {}),
                              to = prescribed_values(prepared, whole.supports, {});
    growth.reaction = 0.0;
    for (std::size_t p = 0; p < to.size(); ++p) *growth.reaction += (to[p] - from[p]).dot(state.reactions[p]);
  }
}

}  // namespace scabo::analysis
