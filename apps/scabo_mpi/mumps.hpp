// MUMPS on all ranks: a factor of a sparse symmetric positive definite matrix A whose entries are spread over them.
//
// Unknowns c may be left out of the elimination, as the variables of a Schur complement (ICNTL(19)):
//     S = A_cc - A_ci A_ii^-1 A_ic,     (A^-1)_cc = S^-1.
// Contact needs (A^-1)_cc: condensation is then a part of the factorisation. Rank 0 has S, dense, and its factor. A
// solve eliminates forward (ICNTL(26) = 1), solves with S on rank 0, and substitutes back (ICNTL(26) = 2).
//
// All ranks call each function at the same time. What is dense, right-hand sides, solutions and S, is on rank 0.
#pragma once

#include <dmumps_c.h>
#include <mpi.h>

#include <optional>
#include <vector>

#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::mpi {

class MumpsFactor {
 public:
  /// Of the lower triangle, rows and columns from 1; a rank has any of them, and those at one place are added up.
  struct Entries {
    std::vector<MUMPS_INT> rows, columns;
    std::vector<double> values;
  };

  explicit MumpsFactor(MPI_Comm comm);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// `step`: on rank 0, the step at which each unknown is eliminated, 0 to n - 1. `condensed`: the unknowns c,
  /// ascending and distinct, from 0; their steps are the last. Adds to the seconds of `costs`. MUMPS's errors are left
  /// to the functions that follow.
  void factorise(int n, Entries entries, const std::vector<int>& step, std::vector<int> condensed,
                 linalg::FactorisationCosts& costs);
  /// Throws std::bad_alloc on a rank that had too little memory, BrokenInvariant where MUMPS failed otherwise.
  void complain() const;
  /// Whether there is a factor of all unknowns but c.
  bool is_definite() const;
  /// On rank 0: factorises S. Throws NotPositiveDefinite.
  void factorise_condensed();

  double entries() const;     ///< of the factor
  double operations() const;  ///< of the factorisation

  /// A^-1 B. On rank 0 `X` is B and becomes the solution; null elsewhere.
  void solve(Matrix* X);
  /// Whether rank 0 has the inverse between all unknowns c: not without such, and not if no other is left.
  bool is_condensed() const { return is_condensed_; }
  /// On rank 0, alone: entries of the inverse at all pairs of some of the unknowns c. Throws if another is asked for.
  Matrix condensed_block(const std::vector<int>& indices) const;
  /// The same for any unknowns, ascending and distinct, without unknowns c: selected entries of the inverse (ICNTL(30);
  /// Amestoy et al., SIAM J. Sci. Comput. 34 (2012) A1975). Right-hand sides are sparse, and MUMPS visits only the part
  /// of the elimination tree that they and the wanted rows reach. On rank 0 `block` becomes the result.
  void inverse_block(const std::vector<int>* indices, Matrix* block);

 private:
  MUMPS_INT& icntl(int number) { return mumps_.icntl[number - 1]; }
  void call(MUMPS_INT job);
  void take_options();

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, count_ = 1;
  DMUMPS_STRUC_C mumps_{};
  bool is_condensed_ = false;
  std::vector<int> condensed_;  // on rank 0, as the following
  std::vector<MUMPS_INT> variables_;
  Matrix S_;  // lower triangle, until it is factorised
  std::optional<linalg::SymmetricPositiveSolver> condensed_factor_;
};

}  // namespace scabo::mpi
