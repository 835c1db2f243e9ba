// The directory that a run leaves: summary.json, contact.csv, fields.pvd with one .vtu for each increment,
// convergence.csv and .svg, log.txt, and where they are asked for points.csv, lines.csv, grid.csv and problems/
// (docs/results.md). Increments are added as they finish, so that they can be read while the run goes
// on, and after it was interrupted or killed.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/result/files.hpp"
#include "scabo/result/point_tables.hpp"
#include "scabo/result/recovery.hpp"
#include "scabo/result/vtu.hpp"

namespace scabo::result {

/// Creates the directory, or clears it of the results of an earlier run. Only files that Scabo wrote are
/// removed; one of another origin that stands where a result has to go is an error. Throws WriteError.
void prepare_directory(const std::filesystem::path& path);

class ResultsDirectory {
 public:
  /// Prepares the directory. Throws WriteError.
  ResultsDirectory(std::filesystem::path path, const model::Model& model);

  const std::filesystem::path& path() const { return path_; }

  /// Writes what an increment came to; for one that did not converge a line of log.txt only. From time to
  /// time also summary.json, as far as it is known. Throws WriteError.
  void add(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment);

  /// Writes summary.json and ends log.txt, however the run ended. `solution.timing` with the figures that
  /// only the caller knows: read and total. Throws WriteError.
  void finish(const analysis::StaticSolution& solution);

  /// Where the discrete problem of attempt `attempt` (from 0) of an increment goes: problems/STEP_INCREMENT.hdf5 for
  /// the last attempt, problems/STEP_INCREMENT.attempt_1.hdf5 and so on for those before it. Creates the directory.
  /// Throws WriteError.
  std::filesystem::path problem_file(const analysis::IncrementResult& increment, std::size_t attempt) const;

  const std::vector<std::string>& warnings() const { return warnings_; }  ///< about what was written
  double recover_seconds() const { return recover_seconds_; }             ///< for interior fields
  double write_seconds() const { return write_seconds_; }                 ///< for files

 private:
  using Clock = std::chrono::steady_clock;

  /// `timing` of the analysis and of this directory.
  analysis::Timing complete(analysis::Timing timing) const;
  void begin_log(const analysis::StaticSolution& solution);
  void write_running_summary(const analysis::StaticSolution& solution);

  std::filesystem::path path_;
  double pseudo_time(const analysis::IncrementResult& increment) const;
  std::vector<int> increments_of_step_;
  int fields_written_ = 0;
  bool log_begun_ = false;
  double recover_seconds_ = 0.0, write_seconds_ = 0.0;
  Clock::time_point next_summary_;
  void add_points(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment);
  std::optional<GrowingFile> contact_table_, convergence_table_, log_;
  struct PointFile {
    PointTable table;
    std::unique_ptr<GrowingFile> file;
    std::optional<PointEvaluation> evaluation;
  };
  std::vector<PointFile> point_files_;
  std::vector<std::string> warnings_;  // of the tables
  std::optional<FieldCollection> collection_;
  std::optional<Recovery> recovery_;
};

}  // namespace scabo::result
