// Energies of bodies in space, by the rules of the plane (docs/methods/07_history_and_increments.md, "Energy").
#pragma once

#include "scabo/analysis/space/prepared_solids.hpp"

namespace scabo::analysis {

/// What body `b` stores.
double elastic_energy_of_solid(const PreparedSolids& prepared, const SolidFactors& factors, const MovedSolids& moved,
                               std::size_t b);

/// The energy of `from` and what an increment adds to it.
Energy energy_of_solids(const PreparedSolids& prepared, const SolidState& from, const MovedSolids& before,
                        const SolidState& to, const MovedSolids& after);

}  // namespace scabo::analysis
