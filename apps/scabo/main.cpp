#include "command_line.hpp"
#include "launch.hpp"
#include "startup.hpp"

int main(int argc, char** argv) {
  scabo::app::become_a_rank(argv);
  scabo::app::prepare_process();
  scabo::app::keep_memory();
  return scabo::app::main_program(std::vector<std::string>(argv + 1, argv + argc));
}
