#include <utility>

#include "scabo/contact/stages.hpp"
#include "scabo/contact/sweeps/long_sweeps.hpp"

namespace scabo::contact {

namespace {

constexpr int most_sweeps = 25000, crossover = 40;
/// Rows of a W that would have to be formed for sweeps.
constexpr Eigen::Index most_formed = 5000;

}  // namespace

StageEnd sweeps_stage(Search& search) {
  const Problem& problem = search.problem();
  if (problem.G.cols() > 0) return {false, "sweeps need bodies that do not move freely"};
  if (!problem.W.is_dense() && !problem.W.is_sparse() && problem.W.size() > most_formed)
    return {false, "sweeps need the entries of W"};
  LongSweeps sweeps(problem, search.start().p);
  const bool accepted = sweeps.run(most_sweeps, search.judge(), search.options().deadline);
  const double residual = search.residual_at(sweeps.p(), Vector());
  search.offer(sweeps.p(), Vector(), residual, accepted);
  search.add_trace({{0, residual, 0.0, 1.0, 0, std::to_string(sweeps.sweeps()) + " sweeps"}}, 0);
  if (!accepted && !search.late()) search.newton_from({sweeps.p(), Vector()}, {"newton after sweeps", crossover});
  return {search.solved(), std::to_string(sweeps.sweeps()) + " sweeps did not settle"};
}

}  // namespace scabo::contact
