// The state that growth looks for on the present cracks: that in which the leading tip is critical, or that at the
// highest load of a cycle.
#pragma once

#include "scabo/analysis/growth/critical.hpp"
#include "scabo/analysis/growth/fatigue.hpp"

namespace scabo::analysis {

struct Sought {
  GrowthResult at;  ///< where the tips are, and which of them grow
  Factors factors;
  std::vector<MaterialConstants> materials;  ///< at the tips, of growth under a load
  std::vector<CycledTip> cycled;             ///< of growth under cycles
  std::optional<Reached> reached;            ///< if it was solved while it was looked for
  std::string failed;                        ///< why there is none
};

/// Without contacts, where the factors of the tips are linear in the load factor (critical.hpp).
Sought sought_without_contact(const Prepared& prepared, const std::vector<Tip>& tips, const Options& options);

/// With contacts, whose pairs have a history: from the state `from`, by trial from `guess` on. Factors of the tips are
/// no linear function of the load factor where pairs change their states.
Sought sought_in_contact(const Prepared& prepared, const std::vector<Tip>& tips, const State& from, double guess,
                         const Options& options);

/// `from`: the state before, of models with contacts.
Sought sought_in_cycle(const Prepared& prepared, const std::vector<Tip>& tips, const State& from,
                       const Options& options);

/// The rates of the tips that grow, together.
double rate_of(const GrowthResult& at, const std::vector<CycledTip>& cycled);

/// Factors, T and G from the state itself, and the kinks.
void add_factors(const Prepared& prepared, const std::vector<Tip>& tips, const IncrementResult& increment,
                 GrowthResult& growth);

}  // namespace scabo::analysis
