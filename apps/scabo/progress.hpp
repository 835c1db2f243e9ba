// Progress of a run on standard error: one line that is rewritten on a terminal, or one line per increment otherwise.
#pragma once

#include <chrono>
#include <string>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/contact/solution.hpp"
#include "scabo/run/plan.hpp"
#include "scabo/run/time_left.hpp"

namespace scabo::app {

class Progress {
 public:
  enum class Style { silent, lines, terminal };

  /// Shows nothing if `quiet`; otherwise adapts to standard error.
  explicit Progress(bool quiet);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void stage(const std::string& name);
  /// Sizes, memory and time, before the work begins.
  void plan(const run::Plan& plan);
  void meshed(const analysis::Discretisation& discretisation);
  void resumed(int increments);  ///< so many were finished in earlier sessions
  void iteration(const contact::Iteration& iteration);
  void increment(const analysis::StaticSolution& solution, const analysis::IncrementResult& result);
  /// Clears the rewritten line, so that other messages can be printed.
  void clear();

 private:
  void show(const std::string& line);
  std::string increment_at_work() const;
  std::string time_left() const;
  void show_increment();  ///< unless a line was shown just before

  Style style_;
  bool line_shown_ = false;
  int increments_ = 0;      ///< of all steps, where their number is known; 0 until the first begins
  bool automatic_ = false;  ///< it is not known
  int planned_dofs_ = 0;
  run::TimeLeft time_left_;
  int done_ = 0;
  std::string before_;  ///< result of the last finished increment
  std::string now_;     ///< iteration of the increment at work; empty before the first that is shown
  std::chrono::steady_clock::time_point last_shown_;
};

}  // namespace scabo::app
