// The results directory of a run: summary.json, contact.csv, fields.pvd with one .vtu for each increment, contact.pvd
// with one .vtu of the contacts for each (both as requested by `output`), convergence.csv and .svg, log.txt, of a
// mechanism or collapse mechanism.vtu, and if requested history.csv, points.csv, lines.csv, grid.csv and problems/
// (docs/results.md). Increments are added as they finish, so that they can be read while the run continues and after it
// was interrupted or killed. Where cracks grow also cracks.csv.
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "scabo/analysis/state/solution.hpp"
#include "scabo/analysis/state/written_results.hpp"
#include "scabo/result/files.hpp"
#include "scabo/result/history.hpp"
#include "scabo/result/old_results.hpp"
#include "scabo/result/point_tables.hpp"
#include "scabo/result/recovery.hpp"
#include "scabo/result/vtu.hpp"

namespace scabo::result {

/// The `status` in summary.json; nothing if it cannot be read.
std::optional<std::string> status_in(const std::filesystem::path& directory);
/// Likewise its `analysis`: `space` of a model in space.
std::optional<std::string> analysis_in(const std::filesystem::path& directory);

/// Records in summary.json that an error ended the run: status `failed`, with the reason. A full disk has room for the
/// status alone, which is then written over the one before.
void mark_failed(const std::filesystem::path& directory, const std::string& reason) noexcept;

/// Other processes write the fields of the cells that they have.
class FieldParts {
 public:
  virtual ~FieldParts() = default;
  /// Whether they have any.
  virtual bool any() const = 0;
  /// Writes `stem_0.vtu`, `stem_1.vtu` ... into a directory; their names. Throws WriteError.
  virtual std::vector<std::string> write(const analysis::Discretisation& discretisation,
                                         const analysis::IncrementResult& increment,
                                         const std::filesystem::path& directory, const std::string& stem) = 0;
};

class ResultsDirectory {
 public:
  /// Prepares the directory, and writes a first summary.json with the sizes of the mesh. Throws WriteError.
  ResultsDirectory(std::filesystem::path path, const model::Model& model, mesh::Mesh mesh = {});

  /// Continues the results of a run of the same model: what was written after `written` is removed. Throws WriteError.
  ResultsDirectory(std::filesystem::path path, DirectoryLock lock, const model::Model& model,
                   const analysis::WrittenResults& written);

  const std::filesystem::path& path() const { return path_; }

  /// From now on, fields are written in parts, with a .pvtu that names them, while `parts` has any.
  void divide_fields(FieldParts* parts) { parts_ = parts; }

  /// Writes the results of an increment; for one that did not converge, only a line of log.txt. Also writes
  /// summary.json with the results so far, unless that would take more than a twentieth of the time. Throws WriteError;
  /// if not all files could be written, none of them, and not summary.json either, contains the increment.
  /// What is thrown at an interruption point (base/interruption.hpp) leaves the directory as if it had not been called.
  void add(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment);

  /// What the files contain now, for a checkpoint. All of it is on the disk.
  analysis::WrittenResults written();

  /// Writes summary.json and completes log.txt, however the run ended. `solution.timing` contains the figures that only
  /// the caller knows: read and total. Throws WriteError.
  void finish(const analysis::StaticSolution& solution);

  /// File for the discrete problem of attempt `attempt` (from 0) of an increment: problems/STEP_INCREMENT.hdf5 for the
  /// last attempt, problems/STEP_INCREMENT.attempt_1.hdf5 and so on for the earlier ones. Creates the directory. Throws
  /// WriteError.
  std::filesystem::path problem_file(const analysis::IncrementResult& increment, std::size_t attempt) const;

  /// `timing` of the analysis, with that of this directory.
  analysis::Timing complete(analysis::Timing timing) const;

  const std::vector<std::string>& warnings() const { return warnings_; }  ///< about the files written
  double recover_seconds() const { return recover_seconds_; }             ///< time for interior fields
  double write_seconds() const { return write_seconds_; }                 ///< time for writing files

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<GrowingFile*> growing_files();
  /// New ones, or those of `written`.
  void open_files(const model::Model& model, const analysis::WrittenResults* written);
  void add_files(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment);
  /// How far the files have been written.
  struct Reached {
    std::vector<long long> sizes;  // of growing_files()
    int finished = 0, fields_written = 0;
    bool log_begun = false;
    std::size_t not_synchronised = 0;
    std::vector<HistoryExtremes> extremes;
  };
  Reached reached();
  /// Removes what was written since.
  void take_back(Reached before);
  void begin_log(const analysis::StaticSolution& solution);
  void write_running_summary(const analysis::StaticSolution& solution);

  std::filesystem::path path_;
  FieldParts* parts_ = nullptr;
  int steps_ = 0;
  bool in_time_ = false;  // whether the model has steps in time
  std::optional<DirectoryLock> lock_;
  double pseudo_time(const analysis::IncrementResult& increment) const;
  bool may_be_last(const model::Model& model, const analysis::IncrementResult& increment) const;
  std::string fields_of_bodies(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment);
  bool in_parts() const { return fields_collection_ && parts_ && parts_->any(); }
  void write_fields(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment,
                    const std::optional<std::string>& of_bodies);
  int written_before_ = 0;  // converged increments before the run was resumed
  int finished_ = 0;        // converged increments
  int fields_written_ = 0;  // number of the last increment whose fields are written
  bool log_begun_ = false;
  double recover_seconds_ = 0.0, write_seconds_ = 0.0;
  Clock::time_point next_summary_;
  std::vector<std::string> point_rows(const analysis::StaticSolution& solution,
                                      const analysis::IncrementResult& increment);
  std::optional<GrowingFile> contact_table_, convergence_table_, crack_table_, history_table_, log_;
  History history_;
  struct PointFile {
    PointTable table{};
    std::optional<GrowingFile> file;  // cannot be moved, hence the deque
    std::optional<PointEvaluation> evaluation;
  };
  std::deque<PointFile> point_files_;
  std::vector<std::filesystem::path> not_synchronised_;  // files of fields that may not be on the disk yet
  std::vector<std::string> warnings_;                    // of the point tables
  model::Output output_;
  std::optional<FieldCollection> fields_collection_, contact_collection_;
  std::optional<Recovery> recovery_;
  PackedGrid packed_grid_;  // of the grid of recovery_
  int pairings_ = 0;        // StaticSolution::pairings of the mesh of the evaluations and the recovery
  void follow_mesh(const analysis::StaticSolution& solution);
};

}  // namespace scabo::result
