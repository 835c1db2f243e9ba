// Preloads whose tension is given in an increment: their shortenings are unknowns, as rigid motions are.
//
// A shortening s of 1 moves the pairs by w = B K^-1 f_c (system/solid_cut.hpp). No support holds both parts, so that it
// takes no force by itself, k = f_c'K^-1 f_c, and the tension is -f_c'K^-1 f - w'p under loads f and contact forces p:
//
//     u = q + W p + [G, w] [a; s],   0 = [G, w]' p + [f; N + f_c'K^-1 f]
#pragma once

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/contact/problem.hpp"

namespace scabo::analysis {

/// Those with a force whose factors grow.
std::vector<std::size_t> preloads_being_tightened(const SolidModel& model, const Vector& before, const Vector& factors);

/// Shortenings at the end of an increment, 0 of those that are being tightened; `before` it.
Vector known_shortenings(const SolidModel& model, const std::vector<std::size_t>& tightened, const Vector& before,
                         const Vector& factors);

/// Adds the unknown shortenings to a problem; `u`: displacement of every part under the loads alone.
void add_shortenings(const SolidModel& model, const std::vector<std::size_t>& tightened, const Vector& factors,
                     const system::Structure& structure, const system::ContactSystem& system,
                     const std::vector<Vector>& u, contact::Problem& problem);

/// Of every preload.
std::vector<SolidTension> tensions_of(const SolidModel& model, const Vector& shortening, const std::vector<Vector>& u);

}  // namespace scabo::analysis
