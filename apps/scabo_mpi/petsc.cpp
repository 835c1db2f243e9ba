#include "petsc.hpp"

namespace scabo::mpi {

namespace {

std::string& last_message() {
  static std::string message;
  return message;
}

/// PETSc calls it on every level of its functions, first where the error is.
PetscErrorCode remember(MPI_Comm, int, const char* function, const char*, PetscErrorCode code, PetscErrorType type,
                        const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL)
    last_message() = std::string(function ? function : "PETSc") + ": " + (message ? message : "error");
  return code;
}

}  // namespace

void remember_errors() { static_cast<void>(PetscPushErrorHandler(remember, nullptr)); }

void check(PetscErrorCode code) {
  if (code == 0) return;
  throw PetscFailure(code, last_message());
}

}  // namespace scabo::mpi
