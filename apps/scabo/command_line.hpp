// The whole program from its words to its exit status.
#pragma once

#include <string>
#include <vector>

#include "exit_status.hpp"

namespace scabo::app {

class Cluster;  // cluster.hpp

/// `words`: the command line without the name of the program. `cluster`: the other processes, or null.
ExitStatus main_program(const std::vector<std::string>& words, Cluster* cluster = nullptr);

}  // namespace scabo::app
