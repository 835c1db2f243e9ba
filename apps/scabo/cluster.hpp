// Other processes that a run can use. `scabo-mpi` provides them; this program alone has none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scabo/result/results_directory.hpp"
#include "scabo/system/ranks.hpp"

namespace scabo::app {

class Cluster {
 public:
  virtual ~Cluster() = default;
  /// Before a run: the other processes read its model. Parts of at least `divide_from` degrees of freedom are divided.
  virtual void begin(const std::string& file, const std::vector<std::string>& settings,
                     const std::filesystem::path& directory, double divide_from) = 0;
  virtual system::Ranks& ranks() = 0;
  virtual result::FieldParts& fields() = 0;
  virtual int threads_of_a_rank() const = 0;  ///< processors over processes, on this machine
  /// How many of the processes share this machine, relative to all of them.
  virtual double part_on_this_machine() const = 0;
};

}  // namespace scabo::app
