// A whole run of a static analysis: solve a model and, if a directory is given, write its results as they come, with
// checkpoints from which `scabo resume` continues. The program and the Python module both run models by this.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/state/checkpoint.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/result/results_directory.hpp"
#include "scabo/run/failures.hpp"
#include "scabo/run/plan.hpp"

namespace scabo::run {

/// What the caller of a run is told while it goes on. Each function may be empty, and may throw `Stopped`.
struct Observer {
  std::function<void(const Plan&)> on_plan;  ///< when the estimated memory is known to be available
  std::function<void(const std::string& stage)> on_stage;
  std::function<void(const analysis::StaticSolution&)> on_mesh;
  std::function<void(const analysis::StaticSolution&, const analysis::IncrementResult&)> on_increment;
  std::function<void(const analysis::IncrementBegin&)> on_increment_begin;  ///< analysis::Options
  std::function<void(const contact::Iteration&)> on_iteration;              ///< may also throw analysis::EndAtOnce
};

struct StaticRun {
  const model::Model& model;
  result::ResultsDirectory* directory = nullptr;  ///< null: results are only returned
  analysis::Checkpoint begun = {};  ///< of a new run: without increments; without origin, no checkpoints are written
  double reading = 0.0;             ///< seconds for reading the model
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  int threads = 1;
  system::Ranks* ranks = nullptr;           ///< analysis::Options::ranks
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: end after the current increment
  bool keep_fields = false;                 ///< analysis::Options::keep_fields
  std::optional<Plan> plan = {};            ///< of a new run
  std::string anyway = {};  ///< how to start although memory is not available; empty: that is not checked
  Observer observer = {};
};

/// Whether a run in a directory writes checkpoints: static analyses of several increments.
bool keeps_checkpoints(const model::Model& model);

/// What a checkpoint says about the origin of a run. Throws InputError if a file cannot be read.
analysis::RunOrigin origin_of(const model::Model& model, const std::vector<std::string>& settings,
                              const std::filesystem::path& output, int threads);

/// Runs the model. Timing contains reading and total. Throws what solve_static and ResultsDirectory throw, and
/// NotEnoughMemory; a failure is recorded in the directory.
analysis::StaticSolution solve(const StaticRun& run);

/// Part of the whole analysis that is done after `increment`, 0 to 1.
double part_done(const model::Model& model, const analysis::IncrementResult& increment);

/// Why the run ended without a solution, and how many increments were kept, as one sentence; empty if it is solved.
std::string why_not_solved(const analysis::StaticSolution& solution, bool interrupted);

}  // namespace scabo::run
