// What the growth of cracks releases, from the potential energies of the states before and after it (GrowthEnergy).
//
// A state that is loaded from rest, with nodal forces f, displacements u and reactions r at prescribed displacements d,
// stores 1/2 (f u + r d), and its potential energy is
//
//     Pi = 1/2 (r d - f u)                                                                                          (1)
//
// The forces of contact pairs, p with the relative motions w, act as loads do: f u includes p w in (1). Growth under
// the load and the pair forces of a state A, on another mesh with the longer crack, releases Pi_A - Pi_O, and f u
// becomes larger by the work of the loads. From there, on the same mesh, loads, prescribed displacements and pair
// forces change to those of the next state, and work with their means (the trapezoidal rule, exact for a linear body).
// What the pairs take is the work against their forces.
//
// The same from the factors: the integral of G over the growth, by Simpson's rule from its beginning along the kink,
// its middle and its end, all under the load of A.
#pragma once

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Forces times displacements of a state, force times length.
struct RestEnergy {
  double of_loads = 0.0;     ///< f u
  double of_supports = 0.0;  ///< r d
  double of_pairs = 0.0;     ///< p w
  double elastic = 0.0;      ///< 1/2 u'K u

  double potential() const { return 0.5 * (of_supports - of_loads - of_pairs); }  // eq. (1)
};
RestEnergy rest_energy(const Prepared& prepared, const State& state);

/// From a state A over O, the longer crack under its load and pair forces, to B.
GrowthEnergy energy_of_growth(const Prepared& prepared, const RestEnergy& A, const State& O, const State& B,
                              double integral);

/// What the scaled loads and supports would work at factor 1 (GrowthResult::displacement, reaction).
void add_conjugates(const Prepared& prepared, const State& state, GrowthResult& growth);

}  // namespace scabo::analysis
