// What the growth of cracks releases, from the potential energies of the states before and after it (GrowthEnergy).
//
// A state that is loaded from rest, with nodal forces f, displacements u and reactions r at prescribed displacements d,
// stores 1/2 (f u + r d), and its potential energy is
//
//     Pi = 1/2 (r d - f u)                                                                                          (1)
//
// The forces of contact pairs, p with the relative motions w, act as loads do: f u includes p w in (1). Growth from a
// state A goes over C, its cracks on the mesh of the longer ones, closed along their new parts (closed_growth.hpp), and
// O, where these have opened under the load and the pair forces of A. The step from A to C is that of another mesh,
// Pi_A - Pi_C: remeshing. The one to O releases Pi_C - Pi_O, and f u becomes larger by the work of the loads. From
// there, on the same mesh, loads, prescribed displacements and pair forces change to those of the next state, B, and
// work with their means (the trapezoidal rule, exact for a linear body). What the pairs take is the work against their
// forces.
//
// The same from the factors: the integral of G over the growth, by Simpson's rule from its beginning (in the
// direction in which it goes), its middle and its end, all under the load of A.
#pragma once

#include "scabo/analysis/growth/closed_growth.hpp"
#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Forces times displacements of a state, force times length.
struct RestEnergy {
  double of_loads = 0.0;     ///< f u
  double of_supports = 0.0;  ///< r d
  double of_pairs = 0.0;     ///< p w

  double potential() const { return 0.5 * (of_supports - of_loads - of_pairs); }  // eq. (1)
};
RestEnergy rest_energy(const Prepared& prepared, const State& state);

/// The state under loads and prescribed displacements that are all `by` times those of `state`, without contacts.
State times(double by, State state);

/// A state and what its bodies store, force times length.
struct StoringState {
  const State& state;
  double elastic = 0.0;
};
/// What bodies store in a state from rest.
double elastic_energy(const Prepared& prepared, const State& state);

/// From a state A over O, the longer crack under its load and pair forces, to B.
GrowthEnergy energy_of_growth(const Prepared& prepared, const RestEnergy& A, const ClosedGrowth& C,
                              const StoringState& O, const StoringState& B, double integral);

/// What the scaled loads and supports would work at factor 1 (GrowthResult::displacement, reaction).
void add_conjugates(const Prepared& prepared, const State& state, GrowthResult& growth);

}  // namespace scabo::analysis
