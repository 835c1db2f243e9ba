// Stress intensity factors of the cracks and corners of a structure after an increment
// (element/plane/stress_intensity.hpp).
#pragma once

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/analysis/state/results.hpp"

namespace scabo::analysis {

struct Prepared;
struct State;

/// One result for each bounded open super-element, from its boundary displacements and the loads inside it. Factors are
/// not a number if a load has the exponent of a singular mode.
std::vector<CrackResult> crack_results(const Discretisation& discretisation, const IncrementResult& increment);
/// The same of a state that is not described otherwise (describe.cpp).
std::vector<CrackResult> crack_results(const Prepared& prepared, const State& state);

/// `plate.crack`; of a crack given as a path `plate.crack.start` or `plate.crack.end`.
std::string name_of_tip(const model::Body& body, const Vec2& tip);

/// Warnings for users: undefined factors, exponents that the boundary does not resolve.
std::vector<Warning> crack_warnings(const std::vector<CrackResult>& cracks);

}  // namespace scabo::analysis
