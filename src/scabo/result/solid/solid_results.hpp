// The results directory of a model in space: summary.json, contact.csv, fields.pvd and contact.pvd with one .vtu for
// each increment (docs/model/space.md). Increments are added as they finish.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/space/posed_solids.hpp"
#include "scabo/result/files.hpp"
#include "scabo/result/vtu.hpp"

namespace scabo::result {

/// Content of summary.json of the increments so far; `running`: more are to come.
std::string solid_summary_content(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                                  const std::vector<analysis::SolidIncrement>& increments, bool running);

/// Totals of contacts and supports of an increment, for people.
std::string report_solids(const model::SpaceModel& model, const analysis::PosedSolids& posed,
                          const analysis::SolidIncrement& increment);

class SolidResults {
 public:
  /// Creates or clears the directory. `model` and `posed` must outlive it. Throws WriteError.
  SolidResults(std::filesystem::path path, const model::SpaceModel& model, const analysis::PosedSolids& posed);
  /// Of one that is not solved, only the summary. Throws WriteError.
  void add(const analysis::SolidIncrement& increment);
  void finish();  ///< summary.json with the outcome

 private:
  std::filesystem::path path_;
  const model::SpaceModel& model_;
  const analysis::PosedSolids& posed_;
  DirectoryLock lock_;
  GrowingFile table_;
  FieldCollection collection_;
  std::optional<FieldCollection> faces_;        // of models with contacts
  std::vector<analysis::SolidIncrement> made_;  // without displacements
};

}  // namespace scabo::result
