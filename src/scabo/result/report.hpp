// Texts about a run, for people: log.txt and the terminal.
#pragma once

#include <string>
#include <vector>

#include "scabo/analysis/static_analysis.hpp"

namespace scabo::result {

/// Columns filled to a common width: the first flush left, the others flush right.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// Version, title, sizes and the law of every contact.
std::string report_header(const analysis::StaticSolution& solution);

/// Degrees of freedom and estimated error of every mesh that refinement came by; empty without refinement.
std::string report_passes(const analysis::StaticSolution& solution);

/// `step press, increment 2 of 10: tip = 0.2; 4 iterations, residual 3.1e-15, certificate 2.2e-14`, and why
/// not where it did not converge. One line.
std::string report_increment(const model::Model& model, const analysis::IncrementResult& increment);

/// What a contact carries, as in `friction 0.5, cohesion 3e+05 until failure`.
std::string describe_law(const model::Contact& contact);

// Tables for people show 0 for a figure that is nothing but rounding: a force below 1e-12 of the largest force at work,
// or below what the certificate leaves of equilibrium; a gap below 1e-12 of the largest displacement, or below the
// rounding of coordinates; of the two factors of a crack one below 1e-12 of the other; an effective mass below 1e-12
// of the total. Files for programs keep what was computed.

/// Totals of every contact; empty where there is none.
std::string report_contacts(const analysis::IncrementResult& increment);

/// Force of every support on its body; empty where there is none.
std::string report_reactions(const model::Model& model, const analysis::IncrementResult& increment);

/// Table of stress intensity factors; empty without cracks.
std::string report_cracks(const analysis::IncrementResult& increment);

/// All of these, an empty line between them.
std::string report_totals(const model::Model& model, const analysis::IncrementResult& increment);

/// One line for each warning.
std::string report_warnings(const analysis::StaticSolution& solution);

/// Seconds of every stage and the peak of memory.
std::string report_timing(const analysis::Timing& timing);

/// Outcome, totals and reactions of the last converged increment, warnings, timing.
std::string report_end(const analysis::StaticSolution& solution, const analysis::Timing& timing);

}  // namespace scabo::result
