// The part that `scabo run` and `scabo resume` have in common: solve a model, write its results and report.
#pragma once

#include <chrono>
#include <filesystem>

#include "exit_status.hpp"
#include "interrupt.hpp"
#include "plan.hpp"
#include "scabo/analysis/checkpoint.hpp"
#include "scabo/model/model.hpp"
#include "scabo/result/results_directory.hpp"

namespace scabo::app {

struct StaticRun {
  const model::Model& model;
  result::ResultsDirectory& directory;
  const Interrupt& interrupt;
  analysis::Checkpoint begun;  ///< of a new run: without increments
  double reading = 0.0;        ///< seconds for reading the model
  std::chrono::steady_clock::time_point start;
  int threads = 1;
  bool quiet = false;
  std::optional<Plan> plan;  ///< of a new run
  bool ignore_memory = false;
};

/// Whether a run writes checkpoints: static analyses of several increments.
bool keeps_checkpoints(const model::Model& model);

ExitStatus solve_and_write(StaticRun run);

}  // namespace scabo::app
