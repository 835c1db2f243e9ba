// Frictional contact problems in HDF5 files in the layout of FCLIB, the public collection of such problems
// (Acary, Bremond, Koziara, Perignon, "FCLIB: a collection of discrete 3D frictional contact problems", INRIA
// RT-444, 2014).
//
//   fclib_local/   spacedim, W, V, R, vectors/{q, s, mu}      u = W r + V l + q,   0 = V' r + R l + s
//   fclib_global/  spacedim, M, H, G, vectors/{f, w, b, mu}   global_problem.hpp
//   guesses/number_of_guesses, guesses/1/{r, l, u}            the first: Start
//   solution/{r, l, u, v}
//
// Our rigid motions are FCLIB's bilateral constraints with V = G, s = f, R = 0 and l = a: no sign changes.
// Other readers ignore what only Scabo knows: vectors/cohesion, vectors/tension (`inf`: bonded) and the group
// scabo/.
//
// Matrices are groups {m, n, nz, nzmax, p, i, x}: nz = -1 compressed columns, -2 compressed rows, otherwise
// nz triplets with columns p and rows i, as in CSparse. W is kept as it is, unsymmetric as it may be.
#pragma once

#include "scabo/contact/saved_problem.hpp"

namespace scabo::contact {

/// Throws InputError: `file: dataset: what is wrong and what to do`.
SavedProblem read_fclib(const std::string& file);

/// Writes the local form; with a solution where `saved.r` has one. A W that is only known as an operator is
/// formed. The file is there whole or not at all. Throws std::runtime_error.
void write_fclib(const std::string& file, const SavedProblem& saved);

/// Writes the global form, and a solution where `r` is not empty.
void write_fclib(const std::string& file, const GlobalProblem& global, const std::string& title, const Vector& r = {});

}  // namespace scabo::contact
