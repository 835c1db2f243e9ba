// What a user sees of a run at work, on standard error. On a terminal one line that is rewritten; piped, one
// plain line for every increment.
#pragma once

#include <chrono>
#include <string>

#include "scabo/analysis/static_analysis.hpp"

namespace scabo::app {

class Progress {
 public:
  enum class Style { silent, lines, terminal };

  /// Silent when `quiet`, else as standard error is.
  explicit Progress(bool quiet);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void stage(const std::string& name);
  void meshed(const analysis::StaticSolution& solution);
  void increment(const analysis::StaticSolution& solution, const analysis::IncrementResult& result);
  /// Takes the rewritten line away, so that other messages can be printed.
  void clear();

 private:
  void show(const std::string& line);
  std::string increment_at_work() const;

  Style style_;
  bool line_shown_ = false;
  int increments_ = 0;  ///< of all steps; 0 until they begin
  int done_ = 0;
  std::string before_;  ///< what the last finished increment came to
  std::chrono::steady_clock::time_point last_shown_;
};

}  // namespace scabo::app
