// Checkpoint of a static analysis: all that `scabo resume` needs to continue a run as if it had not been interrupted.
// Two files in the results directory:
//
//   checkpoint.state        the last state with its history, its position in the steps, what has been written to the
//                           result files, and the origin of the run; replaced as a whole (written beside, synchronised
//                           with the disk, renamed), so that there is always a complete one
//   checkpoint.increments   a record for every increment so far, appended; the other file says how many count
//
// Displacements are not kept: they follow from the factors, the contact forces and the rigid motions by one solution
// with the factorised stiffness. So a checkpoint grows with the number of pairs, not with that of nodes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scabo/analysis/state/continuation.hpp"
#include "scabo/analysis/state/written_results.hpp"

namespace scabo::analysis {

/// A file that the run depends on, with the digest of its content.
struct SourceFile {
  std::string path;
  std::string digest;
};
SourceFile source_of(const std::string& path, std::string_view content);
/// Throws InputError if the file cannot be read.
SourceFile source_file(const std::string& path);

/// Where a run comes from.
struct RunOrigin {
  std::string version;                ///< of the program
  std::string model;                  ///< path of the model file as given by the user
  std::string folder;                 ///< working directory of that time, to which the path refers
  std::string beside;                 ///< path of the model file from the results directory; they may move together
  std::vector<SourceFile> files;      ///< the model file first, then files that it names
  std::vector<std::string> settings;  ///< `path=value`
  int threads = 1;                    ///< another number may change the last bits of results
};

struct Checkpoint {
  RunOrigin origin;
  WrittenResults results;
  Continuation from;               ///< without increments: the run starts from the beginning
  long long increments_bytes = 0;  ///< of checkpoint.increments that count
};

bool has_checkpoint(const std::filesystem::path& directory);

/// Throws InputError if there is none, if it is damaged, or if another version of the program wrote it.
Checkpoint read_checkpoint(const std::filesystem::path& directory, const std::string& version);

/// Removes both files and what remains of interrupted writes.
void remove_checkpoint(const std::filesystem::path& directory) noexcept;

class CheckpointWriter {
 public:
  /// Of a new run (`begun` without increments) or of one that continues. Throws std::runtime_error.
  CheckpointWriter(std::filesystem::path directory, Checkpoint begun);

  /// `timing`: of all sessions. Throws std::runtime_error.
  void write(const RunState& run, const StaticSolution& solution, WrittenResults results, const Timing& timing);

 private:
  void replace();

  std::filesystem::path directory_;
  Checkpoint checkpoint_;  // without increments
  std::size_t recorded_ = 0;
};

}  // namespace scabo::analysis
