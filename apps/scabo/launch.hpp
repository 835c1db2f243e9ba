// How this program was started: alone, or by mpirun as one of several processes.
#pragma once

namespace scabo::app {

/// If mpirun (or srun) started several of this program, this one becomes `scabo-mpi`, which is beside it: otherwise
/// each would run the whole model. Returns if it was started alone, or if SCABO_RANKS=no says that the processes have
/// nothing to do with each other. Ends with status 1 and one message, from the first process, if there is no
/// `scabo-mpi`, or if the command is not one for several processes.
void become_a_rank(char** arguments);

/// In `scabo-mpi`: what is wrong if MPI knows another number of processes than mpirun started; null if nothing is.
const char* why_not_these_ranks(int count);

}  // namespace scabo::app
