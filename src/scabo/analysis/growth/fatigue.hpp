// Growth under cycles of load.
//
// The equivalent factor K* (criteria.hpp) goes from K*_min to K*_max in every cycle, with Delta K = K*_max - K*_min and
// R = K*_min / K*_max. A tip grows per cycle by
//
//     paris     da/dN = C Delta K^m                                                                                (1)
//     walker    da/dN = C (Delta K / (1 - R)^(1 - gamma))^m                                                        (2)
//     forman    da/dN = C Delta K^m / ((1 - R) K_c - Delta K)                                                      (3)
//
// in the direction of the criterion at the highest load. The lowest load has the same mode mix, or hardly any K.
//
// With contacts the factors are those of the second cycle: from the state before, the lowest, the highest, the lowest
// and the highest load follow each other, so that friction has found its cycle. Where the lowest load closes the faces
// on each other, K*_min = 0 comes from the contact.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "scabo/analysis/growth/critical.hpp"

namespace scabo::analysis {

/// Tips that grow more slowly than this part of the fastest one wait.
constexpr double least_rate = 0.02;

/// A tip under cycles of load.
struct CycledTip {
  double kink = 0.0;                  ///< at the highest load, counter-clockwise from the crack, radians
  double highest = 0.0, range = 0.0;  ///< K*_max, Delta K: force / length^(3/2)
  double rate = 0.0;                  ///< da/dN, length; infinite where the law of Forman has its end
};

/// Eqs. (1) to (3).
double growth_per_cycle(const model::LoadCycles& cycles, double range, double highest);

/// Factors of loads and supports at the lowest (0) or the highest (1) load of the cycles.
Factors factors_in_cycle(const model::Model& model, int end);

struct Cycled {
  std::vector<CycledTip> tips;
  Reached highest;  ///< the state at the highest load
};
/// All tips, or why they do not grow by these cycles. `from`: the state in which the cycles begin, of models with
/// contacts.
std::variant<Cycled, std::string> cycled_tips(const Prepared& prepared, const std::vector<Tip>& tips, const State& from,
                                              const Options& options);
/// The same tips from the state at the highest load and the ranges that were found.
std::variant<std::vector<CycledTip>, std::string> cycled_again(const Prepared& prepared, const std::vector<Tip>& tips,
                                                               const State& highest, const GrowthResult& known);

}  // namespace scabo::analysis
