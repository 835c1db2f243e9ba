#include "scabo/analysis/growth/growth_energy.hpp"

namespace scabo::analysis {

RestEnergy rest_energy(const Prepared& prepared, const State& state) {
  RestEnergy energy;
  for (std::size_t p = 0; p < state.u.size(); ++p) {
    energy.of_loads += state.forces[p].dot(state.u[p]);
    energy.of_supports += state.reactions[p].dot(state.prescribed[p]);
    energy.elastic += prepared.structure.parts[p]->elastic_energy(state.u[p]);
  }
  return energy;
}

GrowthEnergy energy_of_growth(const RestEnergy& A, const RestEnergy& O, const RestEnergy& B, double integral) {
  GrowthEnergy energy;
  energy.external = O.of_loads - A.of_loads + B.work() - O.work();
  energy.elastic = B.elastic - A.elastic;
  energy.released = A.potential() - O.potential();
  energy.integral = integral;
  return energy;
}

}  // namespace scabo::analysis
