#include "mumps.hpp"

#include <petscsys.h>

#include <algorithm>
#include <new>
#include <string>

#include "petsc.hpp"
#include "scabo/base/error.hpp"
#include "scabo/base/stopwatch.hpp"

namespace scabo::mpi {

namespace {

enum Job : MUMPS_INT { start = -1, stop = -2, analyse = 1, eliminate = 2, substitute = 3 };

constexpr bool is_too_small(MUMPS_INT error) { return error == -8 || error == -9; }  // its estimate of work space
constexpr bool is_memory(MUMPS_INT error) {
  return is_too_small(error) || error == -5 || error == -7 || error == -13 || error == -19 || error == -20;
}
constexpr bool is_indefinite(MUMPS_INT error) { return error == -10 || error == -40 || error == -6; }

}  // namespace

MumpsFactor::MumpsFactor(MPI_Comm comm) {
  MPI_Comm_dup(comm, &comm_);  // MUMPS uses it as it is
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &count_);
  mumps_.sym = 1;  // positive definite
  mumps_.par = 1;  // rank 0 works as all others
  mumps_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm_));
  call(start);
  std::fill(&icntl(1), &icntl(4) + 1, 0);  // no messages
  icntl(8) = 0;                            // no scaling: a factor of the matrix itself
  icntl(18) = 3;                           // entries where they are
  icntl(28) = 1;                           // analysis on rank 0: Schur complements and a given order need it
  icntl(14) = 30;                          // per cent more than the estimated work space
}

MumpsFactor::~MumpsFactor() {
  call(stop);
  MPI_Comm_free(&comm_);
}

void MumpsFactor::call(MUMPS_INT job) {
  mumps_.job = job;
  dmumps_c(&mumps_);
}

/// Those of MUMPS's parameters that change its way and not its result, by PETSc's names of them: PETSC_OPTIONS.
void MumpsFactor::take_options() {
  for (const int number : {7, 13, 14, 22, 23, 58}) {
    const std::string name = "-mat_mumps_icntl_" + std::to_string(number);
    PetscInt value = 0;
    PetscBool is_set = PETSC_FALSE;
    check(PetscOptionsGetInt(nullptr, nullptr, name.c_str(), &value, &is_set));
    if (is_set) icntl(number) = static_cast<MUMPS_INT>(value);
  }
}

void MumpsFactor::factorise(int n, Entries entries, const std::vector<int>& step, std::vector<int> condensed,
                            linalg::FactorisationCosts& costs) {
  icntl(7) = 1;  // the order of elimination is given
  take_options();
  std::vector<MUMPS_INT> position;
  if (icntl(7) == 1)
    for (const int k : step) position.push_back(static_cast<MUMPS_INT>(k + 1));
  mumps_.perm_in = position.data();
  mumps_.n = n;
  mumps_.nnz_loc = static_cast<MUMPS_INT8>(entries.values.size());
  mumps_.irn_loc = entries.rows.data();
  mumps_.jcn_loc = entries.columns.data();
  mumps_.a_loc = entries.values.data();
  is_condensed_ = !condensed.empty() && static_cast<int>(condensed.size()) < n;  // MUMPS needs others to eliminate
  if (is_condensed_) {
    icntl(19) = 2;  // lower triangle by columns; all of it is on rank 0
    mumps_.nprow = mumps_.npcol = 1;
    mumps_.mblock = mumps_.nblock = 100;
    if (rank_ == 0) {
      condensed_ = std::move(condensed);
      for (const int unknown : condensed_) variables_.push_back(static_cast<MUMPS_INT>(unknown + 1));
      mumps_.size_schur = static_cast<MUMPS_INT>(variables_.size());
      mumps_.listvar_schur = variables_.data();
    }
  }
  timed(costs.analyse, [&] { call(analyse); });
  if (is_condensed_ && rank_ == 0 && mumps_.infog[0] >= 0) {
    const auto size = static_cast<Eigen::Index>(condensed_.size());
    S_ = Matrix::Zero(size, size);
    mumps_.schur_lld = static_cast<MUMPS_INT>(size);
    mumps_.schur = S_.data();
  }
  constexpr MUMPS_INT most_relaxed = 1000;
  if (mumps_.infog[0] >= 0)
    for (;;) {
      timed(costs.factorise, [&] { call(eliminate); });
      if (!is_too_small(mumps_.infog[0]) || icntl(14) >= most_relaxed) break;
      icntl(14) *= 4;
    }
  mumps_.nnz_loc = 0;
  mumps_.irn_loc = mumps_.jcn_loc = nullptr;
  mumps_.a_loc = nullptr;
  mumps_.perm_in = nullptr;
}

void MumpsFactor::complain() const {
  const MUMPS_INT error = mumps_.infog[0], here = mumps_.info[0];
  if (is_memory(error) && (is_memory(here) || rank_ == count_ - 1)) throw std::bad_alloc();
  if (error < 0 && !is_memory(error) && !is_indefinite(error))
    throw BrokenInvariant("MUMPS reports error " + std::to_string(error));
}

bool MumpsFactor::is_definite() const { return mumps_.infog[0] >= 0 && mumps_.infog[11] <= 0; }

void MumpsFactor::factorise_condensed() {
  if (!is_condensed_) return;
  condensed_factor_.emplace(std::move(S_));
  mumps_.schur = nullptr;
}

double MumpsFactor::entries() const { return mumps_.infog[28] < 0 ? -1e6 * mumps_.infog[28] : mumps_.infog[28]; }

double MumpsFactor::operations() const { return mumps_.rinfog[2]; }

void MumpsFactor::solve(Matrix* X) {
  Matrix reduced;
  if (X) {
    mumps_.rhs = X->data();
    mumps_.nrhs = static_cast<MUMPS_INT>(X->cols());
    mumps_.lrhs = mumps_.n;
    reduced.resize(static_cast<Eigen::Index>(condensed_.size()), X->cols());
    mumps_.redrhs = reduced.data();
    mumps_.lredrhs = static_cast<MUMPS_INT>(reduced.rows());
  }
  icntl(20) = icntl(21) = icntl(30) = 0;
  icntl(26) = is_condensed_ ? 1 : 0;
  call(substitute);
  complain();
  if (is_condensed_) {
    if (X) {
      reduced = condensed_factor_->solve(reduced);
      mumps_.redrhs = reduced.data();
    }
    icntl(26) = 2;
    call(substitute);
    complain();
  }
  mumps_.rhs = mumps_.redrhs = nullptr;
}

Matrix MumpsFactor::condensed_block(const std::vector<int>& indices) const {
  std::vector<int> places;
  for (const int index : indices) {
    const auto at = std::lower_bound(condensed_.begin(), condensed_.end(), index);
    ensure(at != condensed_.end() && *at == index, "an unknown was not condensed");
    places.push_back(static_cast<int>(at - condensed_.begin()));
  }
  return condensed_factor_->inverse_block(places);
}

void MumpsFactor::inverse_block(const std::vector<int>* indices, Matrix* block) {
  std::vector<MUMPS_INT> starts, rows;
  if (indices) {
    // Column j of the pattern: the wanted rows in column j of the inverse.
    starts.reserve(static_cast<std::size_t>(mumps_.n) + 1);
    std::size_t next = 0;
    for (int j = 0; j <= mumps_.n; ++j) {
      starts.push_back(static_cast<MUMPS_INT>(next * indices->size() + 1));
      if (next < indices->size() && (*indices)[next] == j) ++next;
    }
    rows.reserve(indices->size() * indices->size());
    for (std::size_t k = 0; k < indices->size(); ++k)
      for (const int row : *indices) rows.push_back(static_cast<MUMPS_INT>(row + 1));
    *block = Matrix::Zero(static_cast<Eigen::Index>(indices->size()), static_cast<Eigen::Index>(indices->size()));
    mumps_.nrhs = mumps_.n;
    mumps_.nz_rhs = static_cast<MUMPS_INT>(rows.size());
    mumps_.rhs_sparse = block->data();
    mumps_.irhs_sparse = rows.data();
    mumps_.irhs_ptr = starts.data();
  }
  icntl(20) = icntl(21) = icntl(26) = 0;
  icntl(27) = 256;  // columns at a time
  icntl(30) = 1;
  call(substitute);
  complain();
  icntl(30) = 0;
  mumps_.rhs_sparse = nullptr;
  mumps_.irhs_sparse = mumps_.irhs_ptr = nullptr;
}

}  // namespace scabo::mpi
