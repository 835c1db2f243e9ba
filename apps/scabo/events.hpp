// What a run does, for programs that watch it: one JSON object a line on standard output (`--json-lines`,
// docs/events.md).
//
// Every line is written whole by one call of the system, so that the lines are valid whatever ends the process. A
// reader that has gone away does not end the run.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "exit_status.hpp"
#include "scabo/analysis/static_analysis.hpp"
#include "scabo/base/error.hpp"
#include "scabo/run/plan.hpp"
#include "scabo/run/time_left.hpp"

namespace scabo::app {

class Events {
 public:
  /// Writes nothing if `on` is false.
  explicit Events(bool on);

  /// `start`, then what `run` tells, then `finished` with the exit status. What it throws becomes events of kind
  /// `error` and is passed on.
  ExitStatus around(const std::string& command, const std::function<ExitStatus()>& run);

  void files(const std::string& model, const std::filesystem::path& directory, const char* analysis);
  void plan(const run::Plan& plan);
  void stage(const std::string& name);
  void meshed() { time_left_.begin(); }
  void increment_begin(const analysis::IncrementBegin& begin);
  void iteration(const contact::Iteration& iteration);
  void increment_end(const model::Model& model, const analysis::IncrementResult& result, bool is_first);
  void warning(const Warning& warning);
  void warning(const std::string& text);
  void error(const std::string& text);
  /// Text for people: on standard output, or on standard error if that has the events.
  void print_summary(const std::string& text) const;
  /// How a run that is not solved ended, for the last event.
  void not_solved(const analysis::StaticSolution& solution);

 private:
  void end_stage();
  void finished(ExitStatus status);
  void write(std::string line);

  using Clock = std::chrono::steady_clock;
  bool wanted_, on_;  ///< on: standard output can still be written
  Clock::time_point start_ = Clock::now(), begun_, last_iteration_;
  std::optional<std::string> stage_;
  std::optional<analysis::IncrementBegin> increment_;
  std::optional<analysis::Outcome> outcome_;
  std::optional<std::string> mechanism_;  ///< which bodies move, if they do
  run::TimeLeft time_left_;
};

}  // namespace scabo::app
