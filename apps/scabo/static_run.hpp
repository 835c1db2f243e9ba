// The part that `scabo run` and `scabo resume` have in common: a run with its progress, and what is said at its end.
#pragma once

#include "events.hpp"
#include "exit_status.hpp"
#include "interrupt.hpp"
#include "scabo/run/static_run.hpp"

namespace scabo::app {

/// Solves and writes `run`, which has a directory; its stop and observer are set here.
ExitStatus solve_and_report(run::StaticRun run, const Interrupt& interrupt, Events& events, bool quiet);

}  // namespace scabo::app
