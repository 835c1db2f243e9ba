// Warnings about models that were analysed as written but are probably not what was intended.
//
// - A load without effect: it is zero, or all its forces act on supported degrees of freedom.
// - Bodies that overlap at the start by more than a hundredth of the smaller one's size across the contact, or
//   pressures beyond a twentieth of Young's modulus: the theory of small strains does not cover such strains.
// - A contact that is open at every pair in every increment.
// - Fewer than five pairs in contact at the end: the forces are right, but the pressure is not reliable.
//
// Contacts with the same problem share one sentence, however many they are.
#pragma once

#include <vector>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::analysis {

std::vector<Warning> load_warnings(const model::Model& model, const system::Structure& structure);

/// Warnings about all increments so far.
std::vector<Warning> contact_warnings(const StaticSolution& solution);

}  // namespace scabo::analysis
