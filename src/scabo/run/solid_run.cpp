#include "scabo/run/solid_run.hpp"

#include "scabo/result/solid/solid_results.hpp"
#include "scabo/run/failures.hpp"

namespace scabo::run {

std::vector<analysis::SolidIncrement> solve(const SolidRun& run) {
  result::SolidResults results(run.output, run.model, run.posed);
  return marking_failures(run.output, [&] {
    auto increments =
        analysis::solve_solids(run.posed.model, run.posed.increments, run.model.tolerance, run.threads,
                               [&](const analysis::SolidIncrement& increment) { results.add(increment); });
    results.finish();
    return increments;
  });
}

}  // namespace scabo::run
