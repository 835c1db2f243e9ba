#include "scabo/analysis/quasistatic/branch.hpp"

#include "scabo/contact/questions/uniqueness.hpp"

namespace scabo::analysis {

std::optional<UniquenessResult> follow_history(const contact::Problem& problem, const contact::JointLaws& laws,
                                               const contact::History& history, const contact::Start& start,
                                               const contact::SolverOptions& options, contact::Evolution& evolution) {
  if (evolution.solution.status != contact::Status::solved) return std::nullopt;
  contact::UniquenessReport report = contact::examine_uniqueness(evolution.problem, start, evolution.solution, options);
  if (report.nearest >= 0) {
    const contact::Start nearer{report.others[static_cast<std::size_t>(report.nearest)], evolution.solution.a};
    contact::Evolution other = contact::evolve(problem, laws, history, nearer, options);
    if (other.solution.status == contact::Status::solved) {
      other.solution.iterations += evolution.solution.iterations;
      other.solution.coarse_iterations += evolution.solution.coarse_iterations;
      evolution = std::move(other);
      report = contact::examine_uniqueness(evolution.problem, start, evolution.solution, options);
    }
  }
  return UniquenessResult{contact::name_of(report.unique), static_cast<int>(report.others.size()), report.complete,
                          report.bound, report.index};
}

}  // namespace scabo::analysis
