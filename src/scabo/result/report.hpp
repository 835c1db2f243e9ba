// Texts about a run for people: log.txt and the terminal.
#pragma once

#include <string>
#include <vector>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/result/summary.hpp"

namespace scabo::result {

/// A table with columns of a common width: the first left-aligned, the others right-aligned.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// What moves the ground in each step in time, one line each: its largest acceleration, and its velocity and
/// displacement at the end, which show whether a record needs a correction of its baseline.
std::string report_ground(const model::Model& model);

/// Version, title, sizes, motion of the ground and the law of every contact.
std::string report_header(const model::Model& model, const ModelSizes& sizes);

/// Degrees of freedom and estimated error of every mesh of the refinement; empty without refinement.
std::string report_passes(const analysis::StaticSolution& solution);

/// `step press, increment 2 of 10: tip = 0.2; 4 iterations, residual 3.1e-15, certificate 2.2e-14`, or the reason if it
/// did not converge; in time also what contact and projection have taken so far (below 0: given). One line.
std::string report_increment(const model::Model& model, const analysis::IncrementResult& increment);

/// The law of a contact, as in `friction 0.5, cohesion 3e+05 until failure`.
std::string describe_law(const model::Contact& contact);

// Tables for people show 0 for a figure that is only rounding: a force below 1e-12 of the largest force, below the
// residual of equilibrium in the certificate, or below what the rounding of coordinates makes of it; a gap below 1e-12
// of the largest displacement, or below the rounding of coordinates; one of the two factors of a crack below 1e-12 of
// the other; an effective mass below 1e-12 of the total. Files for programs contain the computed values.

/// Terms of the balance of energy since the begin; empty for an increment at rest.
std::string report_energies(const analysis::IncrementResult& increment);

/// Totals of every contact; empty if there is none.
std::string report_contacts(const model::Model& model, const analysis::IncrementResult& increment);

/// Force of every support on its body; empty if there is none.
std::string report_reactions(const model::Model& model, const analysis::IncrementResult& increment);

/// Force of every entry of `springs` on its body; empty if there is none.
std::string report_springs(const model::Model& model, const analysis::IncrementResult& increment);

/// Tension of every bar; empty if there is none.
std::string report_bars(const model::Model& model, const analysis::IncrementResult& increment);

/// Table of stress intensity factors; empty without cracks.
std::string report_cracks(const analysis::IncrementResult& increment);

/// All of these, separated by empty lines, under a heading.
std::string report_totals(const model::Model& model, const analysis::IncrementResult& increment);

/// One line for each warning.
std::string report_warnings(const analysis::StaticSolution& solution);

/// `mechanism.vtu shows the motion: 3 of 17 bodies move, most of all 'b_3_1'`; empty without a mechanism.
std::string report_mechanism(const analysis::StaticSolution& solution);

/// Why the growth of cracks ended, one line; empty if none grew, or if it ended without a solution.
/// Of a step that looks for a limit: its bracket, and what is beyond.
std::string report_limit(const analysis::StaticSolution& solution);
std::string report_growth(const analysis::StaticSolution& solution);

/// Seconds of every stage and the peak of memory.
std::string report_timing(const analysis::Timing& timing);

/// Outcome, totals and reactions of the last converged increment, warnings, timing.
std::string report_end(const analysis::StaticSolution& solution, const analysis::Timing& timing);

}  // namespace scabo::result
