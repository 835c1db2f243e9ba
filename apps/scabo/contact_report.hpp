// Output of `scabo contact`: a table for people, JSON for programs, and the iterations as CSV.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scabo/contact/files/saved_problem.hpp"
#include "scabo/contact/questions/uniqueness.hpp"

namespace scabo::app {

/// A solution as judged by the library (contact/judge.hpp), and the options it was computed with.
struct Judged {
  contact::Solution solution;
  bool by_certificate = false;  ///< the certificate was decisive, otherwise the natural map
  std::string solver;
  double tolerance = 1e-10;
  double seconds = 0.0;
  std::optional<contact::UniquenessReport> uniqueness;  ///< if requested and solved
};
inline bool is_solved(const Judged& judged) { return judged.solution.status == contact::Status::solved; }
/// The status in the words of a message: `did not converge`.
std::string_view spoken_name_of(contact::Status status);

std::string report_table(const std::string& file, const contact::SavedProblem& saved, const Judged& judged);
std::string report_json(const std::string& file, const contact::SavedProblem& saved, const Judged& judged);

/// First line of a trace, with the names of its columns.
extern const std::string_view trace_header;
std::string report_trace(const contact::Solution& solution);

}  // namespace scabo::app
