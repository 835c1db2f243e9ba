// `scabo plot`: pictures of results by the Python program beside this one (python/scabo/plot).
#include "commands.hpp"
#include "python_program.hpp"

namespace scabo::app {

ExitStatus plot(const std::vector<std::string>& arguments) { return become(command_of(pictures()), arguments); }

}  // namespace scabo::app
