// `scabo-mpi`: what `scabo run` becomes under mpirun. Rank 0 runs the program, the others serve it.
#include <mpi.h>
#include <petscsys.h>

#include <command_line.hpp>
#include <cstdio>
#include <cstdlib>
#include <launch.hpp>
#include <startup.hpp>
#include <string>
#include <vector>

#include "petsc.hpp"
#include "ranks.hpp"

int main(int argc, char** argv) {
  scabo::app::prepare_process();
  scabo::app::keep_memory();
  const std::vector<std::string> words(argv + 1, argv + argc);
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS) return 3;
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  if (const char* wrong = scabo::app::why_not_these_ranks(count)) {
    std::fprintf(stderr, "scabo: %s\n", wrong);
    MPI_Abort(MPI_COMM_WORLD, 3);
  }
  // Only rank 0 has options, which are ours; signals are handled by the program.
  PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
  if (PetscInitializeNoArguments() != 0) MPI_Abort(MPI_COMM_WORLD, 3);
  scabo::mpi::remember_errors();
  int status = 0;
  {
    scabo::mpi::Process process(MPI_COMM_WORLD);
    if (process.rank() == 0) {
      scabo::mpi::PetscRanks ranks(process);
      status = scabo::app::main_program(words, &ranks);
      ranks.end();
    } else {
      scabo::mpi::serve(process);
    }
  }
  static_cast<void>(PetscFinalize());
  MPI_Finalize();
  return status;
}
