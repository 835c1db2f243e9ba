// The results directory of a model in space: summary.json, contact.csv, log.txt, fields.pvd and contact.pvd with one
// .vtu for each increment (docs/model/space.md). Increments are added as they finish.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scabo/analysis/space/posed_solids.hpp"
#include "scabo/analysis/state/written_results.hpp"
#include "scabo/result/files.hpp"
#include "scabo/result/solid/solid_outputs.hpp"
#include "scabo/result/vtu.hpp"

namespace scabo::result {

/// How a run in space has ended.
struct SolidEnd {
  std::string status;             ///< `solved`, `mechanism`, `collapse`, `not_converged` or `interrupted`
  std::string reason;             ///< empty: it is solved
  int finished = 0;               ///< increments that are solved
  double certificate = 0.0;       ///< its worst figure in all of them
  std::string at;                 ///< `step press, increment 2`, of the last increment; empty: there is none
  std::vector<Warning> warnings;  ///< of increments
  std::string totals;             ///< of contacts and supports after the last solved increment, for people; likewise
};

/// Content of summary.json of increments in memory, and how the run has ended.
std::pair<std::string, SolidEnd> summary_of(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                                            const std::vector<analysis::SolidIncrement>& increments, bool interrupted);

class SolidResults {
 public:
  /// Creates or clears the directory. `model` and `posed` must outlive it. Throws WriteError.
  SolidResults(std::filesystem::path path, const model::SpaceModel& model, const analysis::PosedSolids& posed);
  /// Continues a run in it with what is written. Throws WriteError.
  SolidResults(std::filesystem::path path, DirectoryLock lock, const model::SpaceModel& model,
               const analysis::PosedSolids& posed, const analysis::WrittenResults& written);
  ~SolidResults();

  /// Of one that is not solved, only summary and log. Throws WriteError, with nothing left of the increment.
  void add(const analysis::SolidIncrement& increment);
  /// What is written is on the disk.
  analysis::WrittenResults written();
  /// summary.json with the outcome, and the end of the log.
  SolidEnd finish(bool interrupted);

 private:
  struct Summary;
  void open_files(const analysis::WrittenResults* written);
  std::vector<GrowingFile*> growing_files();
  void add_files(const analysis::SolidIncrement& increment);
  void add_fields(const analysis::SolidIncrement& increment);
  void replace_summary() const;

  std::filesystem::path path_;
  const model::SpaceModel& model_;
  const analysis::PosedSolids& posed_;
  std::unique_ptr<Summary> summary_;
  DirectoryLock lock_;
  int finished_ = 0;
  SolidOutputs outputs_;
  std::optional<GrowingFile> table_, log_, points_, lines_, history_;  // the last three if the model asks for them
  std::optional<FieldCollection> collection_, faces_;                  // the latter of models with contacts
  std::vector<std::filesystem::path> not_synchronised_;
  std::vector<Warning> warnings_;  // of increments
};

}  // namespace scabo::result
