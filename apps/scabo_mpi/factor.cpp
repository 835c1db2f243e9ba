// Factorisation by MUMPS under PETSc, and what its factor gives.
#include <algorithm>
#include <new>

#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"
#include "share.hpp"
#include "transfer.hpp"

namespace scabo::mpi {

namespace {

FactorRequest unpack_request(const Bytes& bytes) {
  Unpacker unpacker(bytes);
  FactorRequest request;
  request.solved = unpacker.get_list<char>();
  request.inclined = unpacker.get_list<FactorRequest::Turned>();
  request.springs = unpacker.get_list<FactorRequest::Entry>();
  return request;
}

Bytes pack(const FactorRequest& request) {
  Packer packer;
  packer.add_list(request.solved);
  packer.add_list(request.inclined);
  packer.add_list(request.springs);
  return std::move(packer).take();
}

/// A matrix like K from entries that every rank knows; each rank sets those of its rows.
void from_entries(Mat like, const std::vector<FactorRequest::Entry>& entries, OwnedMat& made) {
  PetscInt first = 0, end = 0, all = 0;
  check(MatGetOwnershipRange(like, &first, &end));
  check(MatGetSize(like, &all, nullptr));
  std::vector<PetscInt> rows, columns;
  std::vector<PetscScalar> values;
  for (const FactorRequest::Entry& entry : entries) {
    if (entry.row < first || entry.row >= end) continue;
    rows.push_back(entry.row);
    columns.push_back(entry.column);
    values.push_back(entry.value);
  }
  check(MatCreate(PetscObjectComm(reinterpret_cast<PetscObject>(like)), made.out()));
  check(MatSetSizes(made, end - first, end - first, all, all));
  check(MatSetType(made, MATMPIAIJ));
  check(MatSetPreallocationCOO(made, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
  check(MatSetValuesCOO(made, values.data(), INSERT_VALUES));
}

/// Rows and columns of T'(K + S)T.
void solved_part(const Share& share, const FactorRequest& request, OwnedMat& part) {
  OwnedMat turned, with_springs;
  Mat whole = share.K;
  if (!request.springs.empty()) {
    OwnedMat S;
    from_entries(share.K, request.springs, S);
    check(MatDuplicate(share.K, MAT_COPY_VALUES, with_springs.out()));
    check(MatAXPY(with_springs, 1.0, S, DIFFERENT_NONZERO_PATTERN));
    whole = with_springs;
  }
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(share.K, &first, &end));
  if (!request.inclined.empty()) {
    std::vector<FactorRequest::Entry> entries;
    std::vector<char> is_turned(static_cast<std::size_t>(end - first), 0);
    for (const FactorRequest::Turned& at : request.inclined) {
      if (2 * at.node < first || 2 * at.node >= end) continue;
      for (int i = 0; i < 2; ++i) {
        is_turned[static_cast<std::size_t>(2 * at.node + i - first)] = 1;
        for (int j = 0; j < 2; ++j) entries.push_back({2 * at.node + i, 2 * at.node + j, at.M[2 * i + j]});
      }
    }
    for (PetscInt row = first; row < end; ++row)
      if (!is_turned[static_cast<std::size_t>(row - first)]) entries.push_back({row, row, 1.0});
    OwnedMat T;
    from_entries(share.K, entries, T);
    check(MatPtAP(whole, T, MAT_INITIAL_MATRIX, PETSC_DEFAULT, turned.out()));
    whole = turned;
  }
  std::vector<PetscInt> rows;
  for (PetscInt row = first; row < end; ++row)
    if (request.solved[static_cast<std::size_t>(row)]) rows.push_back(row);
  OwnedIS own;
  check(ISCreateGeneral(PetscObjectComm(reinterpret_cast<PetscObject>(whole)), static_cast<PetscInt>(rows.size()),
                        rows.data(), PETSC_COPY_VALUES, own.out()));
  check(MatCreateSubMatrix(whole, own, own, MAT_INITIAL_MATRIX, part.out()));
  check(MatSetOption(part, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatSetOption(part, MAT_SPD, PETSC_TRUE));
}

PetscInt info(Mat F, int number, bool of_all) {
  PetscInt value = 0;
  check(of_all ? MatMumpsGetInfog(F, number, &value) : MatMumpsGetInfo(F, number, &value));
  return value;
}

constexpr bool is_too_small(PetscInt error) { return error == -8 || error == -9; }  // its estimate of work space
constexpr bool is_memory(PetscInt error) {
  return is_too_small(error) || error == -5 || error == -7 || error == -13 || error == -19 || error == -20;
}

}  // namespace

FactorFacts Process::factorise(int id, int share_id, const FactorRequest* request) {
  Bytes packed;
  if (request) packed = pack(*request);
  const FactorRequest wanted = unpack_request(broadcast(request ? &packed : nullptr));
  packed = {};
  FactorFacts facts;
  auto made = std::make_unique<FactorOf>();
  together([&] {
    const Share& at = share(share_id);
    OwnedMat part;
    solved_part(at, wanted, part);
    check(MatGetSize(part, &made->size, nullptr));
    check(MatCreateVecs(part, made->x.out(), made->b.out()));
    check(VecScatterCreateToZero(made->x, made->to_root.out(), made->at_root.out()));
    MatFactorInfo options;
    check(MatFactorInfoInitialize(&options));
    constexpr PetscInt first_relaxed = 30, most_relaxed = 1000;  // per cent more than the estimated work space
    for (PetscInt relaxed = first_relaxed;; relaxed *= 4) {
      // Anew each time: PETSc does not repeat a factorisation that has failed.
      check(MatGetFactor(part, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, made->F.out()));
      check(MatMumpsSetIcntl(made->F, 8, 0));  // no scaling: a factor of the matrix itself
      check(MatMumpsSetIcntl(made->F, 14, relaxed));
      timed(facts.order_and_analyse, [&] { check(MatCholeskyFactorSymbolic(made->F, part, nullptr, &options)); });
      if (info(made->F, 1, true) >= 0)
        timed(facts.factorise, [&] { check(MatCholeskyFactorNumeric(made->F, part, &options)); });
      if (!is_too_small(info(made->F, 1, true)) || relaxed >= most_relaxed) return;
    }
  });
  const PetscInt error = info(made->F, 1, true), here = info(made->F, 1, false);
  const bool fine = agreed([&] {
    if (is_memory(error) && (is_memory(here) || rank_ == count_ - 1)) throw std::bad_alloc();
    const bool indefinite = error == -10 || error == -40 || error == -6;
    if (error < 0 && !is_memory(error) && !indefinite)
      throw BrokenInvariant("MUMPS reports error " + std::to_string(error));
  });
  if (!fine) return facts;
  facts.definite = error >= 0 && info(made->F, 12, true) <= 0;
  if (facts.definite) {
    const PetscInt entries = info(made->F, 29, true);
    facts.entries = entries < 0 ? -1e6 * entries : entries;
    PetscReal operations = 0.0;
    check(MatMumpsGetRinfog(made->F, 3, &operations));
    facts.operations = operations;
    factors_[id] = std::move(made);
  }
  return facts;
}

void Process::release_factor(int id) { factors_.erase(id); }

void Process::solve(int id, const Vector* b, Vector* x) {
  together([&] {
    FactorOf& at = factor(id);
    spread(at.at_root, at.b, at.to_root, b ? b->data() : nullptr);
    check(MatSolve(at.F, at.b, at.x));
    if (x) x->resize(at.size);
    collect(at.x, at.at_root, at.to_root, x ? x->data() : nullptr);
  });
}

/// Selected entries of the inverse (ICNTL(30); Amestoy et al., SIAM J. Sci. Comput. 34 (2012) A1975): right-hand sides
/// are sparse, and MUMPS visits only the part of the elimination tree that they and the wanted rows reach.
void Process::inverse_block(int id, const std::vector<int>* indices, Matrix* block) {
  together([&] {
    FactorOf& at = factor(id);
    // Row j of the pattern: the wanted rows in column j of the inverse; all of it is on rank 0, as MUMPS asks.
    const PetscInt rows = rank_ == 0 ? at.size : 0;
    std::vector<PetscInt> start(static_cast<std::size_t>(rows) + 1, 0), columns;
    std::vector<PetscScalar> values;
    if (indices) {
      columns.reserve(indices->size() * indices->size());
      for (std::size_t k = 0; k < indices->size(); ++k) columns.insert(columns.end(), indices->begin(), indices->end());
      values.assign(columns.size(), 0.0);
      std::size_t next = 0;
      for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        if (next < indices->size() && (*indices)[next] == static_cast<int>(row)) ++next;
        start[row + 1] = static_cast<PetscInt>(next * indices->size());
      }
    }
    OwnedMat pattern, by_columns;
    check(MatCreateMPIAIJWithArrays(comm_, rows, rows, at.size, at.size, start.data(), columns.data(), values.data(),
                                    pattern.out()));
    check(MatCreateTranspose(pattern, by_columns.out()));
    check(MatMumpsSetIcntl(at.F, 27, 256));  // columns at a time
    check(MatMumpsGetInverse(at.F, by_columns));
    check(MatMumpsSetIcntl(at.F, 30, 0));  // both remain as they were for the inverse, and solves would fail
    check(MatMumpsSetIcntl(at.F, 21, 1));
    if (!block) return;
    Mat on_this_rank = nullptr;
    check(MatMPIAIJGetSeqAIJ(pattern, &on_this_rank, nullptr, nullptr));
    const PetscScalar* found = nullptr;
    check(MatSeqAIJGetArrayRead(on_this_rank, &found));
    const auto n = static_cast<Eigen::Index>(indices->size());
    *block = Eigen::Map<const Matrix>(found, n, n);
    check(MatSeqAIJRestoreArrayRead(on_this_rank, &found));
  });
}

}  // namespace scabo::mpi
