// Frictional contact problems in HDF5 files in the layout of FCLIB, the public collection of such problems (Acary,
// Bremond, Koziara, Perignon, "FCLIB: a collection of discrete 3D frictional contact problems", INRIA RT-444, 2014).
//
//   fclib_local/   spacedim, W, V, R, vectors/{q, s, mu}      u = W r + V l + q,   0 = V' r + R l + s
//   fclib_global/  spacedim, M, H, G, vectors/{f, w, b, mu}   global_problem.hpp
//   guesses/number_of_guesses, guesses/1/{r, l, u}            the first: Start
//   solution/{r, l, u, v}
//
// The rigid motions of Scabo are the bilateral constraints of FCLIB with V = G, s = f, R = 0 and l = a; signs are the
// same. Other readers ignore the data that only Scabo uses: vectors/cohesion, vectors/tension (`inf`: bonded),
// vectors/mu_backward (problem.hpp) and the group scabo/.
//
// Matrices are groups {m, n, nz, nzmax, p, i, x}, as in CSparse: nz = -1 for compressed columns, -2 for compressed
// rows, otherwise nz triplets with columns p and rows i. W is kept as it is, even if unsymmetric.
#pragma once

#include "scabo/contact/files/saved_problem.hpp"

namespace scabo::contact {

/// Throws InputError: `file: dataset: what is wrong and what to do`.
SavedProblem read_fclib(const std::string& file);

/// Writes the local form, with a solution if `saved.r` contains one. A condensed W is formed. The file is written
/// completely or not at all. Throws std::runtime_error.
void write_fclib(const std::string& file, const SavedProblem& saved);

/// Writes the global form, with a solution if `r` is not empty.
void write_fclib(const std::string& file, const GlobalProblem& global, const std::string& title, const Vector& r = {});

}  // namespace scabo::contact
