// What the growth of cracks releases, from the potential energies of the states before and after it (GrowthEnergy).
//
// A state that is loaded from rest, with nodal forces f, displacements u and reactions r at prescribed displacements d,
// stores 1/2 (f u + r d), and its potential energy is
//
//     Pi = 1/2 (r d - f u)                                                                                          (1)
//
// Growth under the load of a state A, on another mesh with the longer crack, releases Pi_A - Pi_O, and f u becomes
// larger by the work of the loads. From there, on the same mesh, loads and prescribed displacements change to those of
// the next state, with the difference of the works from rest (Betti).
//
// The same from the factors: the integral of G over the growth, by Simpson's rule from its beginning along the kink,
// its middle and its end, all under the load of A.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Works and energies of a state that was loaded from rest, force times length.
struct RestEnergy {
  double of_loads = 0.0;     ///< f u
  double of_supports = 0.0;  ///< r d
  double elastic = 0.0;      ///< 1/2 u'K u

  double work() const { return 0.5 * (of_loads + of_supports); }
  double potential() const { return 0.5 * (of_supports - of_loads); }  // eq. (1)
};
RestEnergy rest_energy(const Prepared& prepared, const State& state);

/// From state A over O, the longer crack under its load, to B.
GrowthEnergy energy_of_growth(const RestEnergy& A, const RestEnergy& O, const RestEnergy& B, double integral);

}  // namespace scabo::analysis
