#include "launch.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>

#include "exit_status.hpp"

namespace scabo::app {

namespace {

/// What mpirun or srun says about this process.
struct Launch {
  int count = 1, rank = 0, on_this_machine = 1;
};

int number_in(const char* variable, int otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

Launch launch() {
  // Open MPI; MPICH, Intel MPI and Slurm's PMI; Slurm with PMIx.
  for (const auto& [count, rank, on_this_machine] :
       {std::array{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_LOCAL_SIZE"},
        std::array{"PMI_SIZE", "PMI_RANK", "MPI_LOCALNRANKS"},
        std::array{"SLURM_STEP_NUM_TASKS", "PMIX_RANK", "SLURM_STEP_TASKS_PER_NODE"}})
    if (std::getenv(count) && std::getenv(rank))
      return {number_in(count, 1), number_in(rank, 0), std::max(1, number_in(on_this_machine, 1))};
  return {};
}

[[noreturn]] void refuse(const Launch& launch, const std::string& why) {
  // mpirun ends all when the first one ends: the others wait until it has spoken.
  if (launch.rank != 0)
    std::this_thread::sleep_for(std::chrono::seconds(2));
  else
    std::fprintf(stderr, "scabo: %s\n", why.c_str());
  std::exit(ExitStatus::wrong_input);
}

}  // namespace

void become_a_rank(char** arguments) {
  const Launch started = launch();
  if (started.count <= 1) return;
  const char* const wish = std::getenv("SCABO_RANKS");
  if (wish != nullptr && std::strcmp(wish, "no") == 0) return;
  const std::string_view command = arguments[1] == nullptr ? "" : arguments[1];
  if (command != "run" && command != "resume")
    refuse(started,
           fmt::format("mpirun started {} processes, and only `scabo run` and `scabo resume` can use them: start "
                       "this command without mpirun",
                       started.count));
  std::error_code error;
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "scabo-mpi";
  if (!error && access(program.c_str(), X_OK) == 0) {
    const auto threads = std::to_string(
        std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / std::max(1, started.on_this_machine)));
    for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) setenv(variable, threads.c_str(), 0);
    execv(program.c_str(), arguments);
  }
  refuse(started, fmt::format("mpirun started {} processes, but this Scabo was built without MPI: there is no {}. "
                              "Install libpetsc-real-dev and build it again, start one process without mpirun, or set "
                              "SCABO_RANKS=no if each is a run of its own",
                              started.count, program.string()));
}

const char* why_not_these_ranks(int count) {
  const Launch started = launch();
  if (count >= 2) return nullptr;
  if (started.count > count)
    return "mpirun started several processes, but MPI connects none of them: use the mpirun of the MPI that Scabo was "
           "built with (Debian: Open MPI)";
  return "this program is for several processes: start it by `mpirun -n N scabo run MODEL`";
}

}  // namespace scabo::app
