#include <utility>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/stages.hpp"
#include "scabo/contact/sweeps/long_sweeps.hpp"

namespace scabo::contact {

StageEnd sweeps_stage(Search& search) {
  const Problem& problem = search.problem();
  if (problem.G.cols() > 0) return {false, "sweeps need bodies that do not move freely"};
  if (!problem.W.is_dense() && !problem.W.is_sparse() && problem.W.size() > sweep_constants.most_formed)
    return {false, "sweeps need the entries of W"};
  LongSweeps sweeps(problem, search.start().p);
  const bool accepted = sweeps.run(sweep_constants.most, search.judge(), search.options().deadline);
  const double residual = search.residual_at(sweeps.p(), Vector());
  search.offer(sweeps.p(), Vector(), residual, accepted);
  search.add_trace({{0, residual, 0.0, 1.0, 0, std::to_string(sweeps.sweeps()) + " sweeps"}}, 0);
  if (!accepted && !search.late())
    search.newton_from({sweeps.p(), Vector()}, {"newton after sweeps", interior_constants.crossover});
  return {search.solved(), std::to_string(sweeps.sweeps()) + " sweeps did not settle"};
}

}  // namespace scabo::contact
