// What `scabo contact` says of a solved problem: a table for people, JSON for programs, CSV of the
// iterations.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scabo/contact/saved_problem.hpp"
#include "scabo/contact/uniqueness.hpp"

namespace scabo::app {

/// A solution and the judgement of it, which is made here and nowhere else. Solved is
///
///     natural-map residual <= tolerance,   or
///     certificate <= tolerance and natural-map residual <= 16 eps |r| / |q|
///
/// and in both cases the balance of rigid motions, which the natural map does not know, within the tolerance.
/// The natural map subtracts motions from forces, so it feels units: where r is 1e10 times q (an elastic body
/// in SI), the rounding of r alone is 1e-6 of q, and no better r can be written down. The certificate does
/// not feel them.
struct Judged {
  contact::Solution solution;
  contact::Status status = contact::Status::not_converged;
  std::string reason;  ///< where not solved
  std::string solver;
  double tolerance = 1e-10;
  double rounding = 0.0;  ///< 16 eps |r| / |q|
  double seconds = 0.0;
  std::optional<contact::UniquenessReport> uniqueness;  ///< where asked for and solved
};

std::string report_table(const std::string& file, const contact::SavedProblem& saved, const Judged& judged);
std::string report_json(const std::string& file, const contact::SavedProblem& saved, const Judged& judged);

/// First line of a trace, with the names of its columns.
extern const std::string_view trace_header;
std::string report_trace(const contact::Solution& solution);

}  // namespace scabo::app
