// Vectors of rank 0 to all ranks, and back.
#pragma once

#include <vector>

#include "petsc.hpp"

namespace scabo::mpi {

/// Own entries.
std::vector<double> values_of(Vec vector);
void set_values(Vec vector, const double* from);

/// The vector of rank 0, whose entries are at `from` there, to all; or that of all to `to` on rank 0. Elsewhere null.
void spread(Vec at_root, Vec all, VecScatter to_root, const double* from);
void collect(Vec all, Vec at_root, VecScatter to_root, double* to);

}  // namespace scabo::mpi
