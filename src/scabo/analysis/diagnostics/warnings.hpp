// Warnings about models that were analysed as written but are probably not what was intended.
//
// - A load without effect: it is zero, or all its forces act on supported degrees of freedom; or a load that is lost in
//   the rounding of another one.
// - Springs that are so much stiffer than their body that rounding of their stiffness is as large as that of the body.
// - A slender super-element of order 1 or 2 with sides so long that it is too stiff in bending.
// - Bodies that overlap at the start by more than a hundredth of the smaller one's size across the contact, or
//   pressures beyond a twentieth of Young's modulus: the theory of small strains does not cover such strains.
// - A contact that is open at every pair in every increment.
// - Fewer than five pairs in contact at the end: the forces are right, but the pressure is not reliable.
//
// Contacts with the same problem share one sentence, however many they are.
#pragma once

#include <string>
#include <vector>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::analysis {

std::vector<Warning> load_warnings(const model::Model& model, const system::Structure& structure);

/// Of a cantilever that is one super-element, measured (docs/methods/18_robustness.md): its deflection is too small by
/// x / (1 + x), with its length L, depth h and sides s,
///
///     order 1   x = 0.08 (s L / h^2)^2             order 2   x = 0.0022 (s / h)^3, at most 0.06
///
/// from order 3 on by less than 1e-4. L and h are those of the rectangle with the same area and perimeter. 0 of a body
/// that is less than five times as long as deep, and of other meshes.
double stiffened_in_bending(const mesh::BodyMesh& mesh);
/// Of all bodies of which that is more than a hundredth.
std::vector<Warning> slender_warnings(const model::Model& model, const mesh::Mesh& mesh);

/// What rounding does where springs are more than `least` times as stiff as the body that they hold, or a rigid one as
/// the stiffest elastic body; empty where there are none.
std::string stiff_springs(const model::Model& model, const system::Structure& structure, double least);
constexpr double stiff_beside = 1e3;  ///< from which it may explain why forces are not balanced to 1e-10
constexpr double very_stiff = 1e6;    ///< from which a warning says so: on an inclined edge they are not balanced then

/// Warnings about all increments so far.
std::vector<Warning> contact_warnings(const StaticSolution& solution);

}  // namespace scabo::analysis
