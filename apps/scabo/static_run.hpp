// The part that `scabo run` and `scabo resume` have in common: a run with its progress, and what is said at its end.
#pragma once

#include "cluster.hpp"
#include "events.hpp"
#include "exit_status.hpp"
#include "interrupt.hpp"
#include "scabo/run/static_run.hpp"

namespace scabo::app {

/// Makes the other processes ready for a run, of the model in `file` with `settings`; a failure is recorded in the
/// directory of the run.
void use(Cluster& cluster, const std::string& file, const std::vector<std::string>& settings, double divide_from,
         run::StaticRun& run);

/// Solves and writes `run`, which has a directory; its stop and observer are set here.
ExitStatus solve_and_report(run::StaticRun run, const Interrupt& interrupt, Events& events, bool quiet);

}  // namespace scabo::app
