#include "transfer.hpp"

#include <algorithm>

namespace scabo::mpi {

std::vector<double> values_of(Vec vector) {
  PetscInt count = 0;
  check(VecGetLocalSize(vector, &count));
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(vector, &values));
  std::vector<double> copy(values, values + count);
  check(VecRestoreArrayRead(vector, &values));
  return copy;
}

void set_values(Vec vector, const double* from) {
  PetscInt count = 0;
  check(VecGetLocalSize(vector, &count));
  PetscScalar* values = nullptr;
  check(VecGetArrayWrite(vector, &values));
  std::copy_n(from, count, values);
  check(VecRestoreArrayWrite(vector, &values));
}

void spread(Vec at_root, Vec all, VecScatter to_root, const double* from) {
  if (from) set_values(at_root, from);
  check(VecScatterBegin(to_root, at_root, all, INSERT_VALUES, SCATTER_REVERSE));
  check(VecScatterEnd(to_root, at_root, all, INSERT_VALUES, SCATTER_REVERSE));
}
void collect(Vec all, Vec at_root, VecScatter to_root, double* to) {
  check(VecScatterBegin(to_root, all, at_root, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(to_root, all, at_root, INSERT_VALUES, SCATTER_FORWARD));
  if (!to) return;
  const std::vector<double> values = values_of(at_root);
  std::copy(values.begin(), values.end(), to);
}

}  // namespace scabo::mpi
