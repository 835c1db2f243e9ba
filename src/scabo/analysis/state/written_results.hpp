// What a run has written to its results directory, for its checkpoint (checkpoint.hpp). Plain data.
#pragma once

#include <string>
#include <vector>

namespace scabo::analysis {

/// State of the result files after an increment (result/results_directory.hpp).
struct WrittenResults {
  struct File {
    std::string name;
    long long bytes = 0;
  };
  int finished = 0;        ///< increments
  int fields_written = 0;  ///< number of the last increment with files of fields
  bool log_begun = false;
  std::vector<File> files;            ///< that grow, with the part of them that counts
  std::vector<std::string> warnings;  ///< about the files written
};

}  // namespace scabo::analysis
