// Factorisation by MUMPS of the rows that supports leave free, and what its factor gives.
#include <algorithm>

#include "mumps.hpp"
#include "scabo/base/stopwatch.hpp"
#include "share.hpp"

namespace scabo::mpi {

namespace {

FactorRequest unpack_request(const Bytes& bytes) {
  Unpacker unpacker(bytes);
  FactorRequest request;
  request.solved = unpacker.get_list<char>();
  request.inclined = unpacker.get_list<FactorRequest::Turned>();
  request.springs = unpacker.get_list<FactorRequest::Entry>();
  request.condensed = unpacker.get_list<int>();
  return request;
}

Bytes pack(const FactorRequest& request) {
  Packer packer;
  packer.add_list(request.solved);
  packer.add_list(request.inclined);
  packer.add_list(request.springs);
  packer.add_list(request.condensed);
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

/// T'(K + S)T: K itself, or what is made for it in `made`.
Mat whole_matrix(const Share& share, const FactorRequest& request, OwnedMat& made) {
  OwnedMat with_springs;
  Mat whole = share.K;
  if (!request.springs.empty()) {
    OwnedMat S;
    from_entries(share.K, request.springs, S);
    check(MatDuplicate(share.K, MAT_COPY_VALUES, with_springs.out()));
    check(MatAXPY(with_springs, 1.0, S, DIFFERENT_NONZERO_PATTERN));
    whole = with_springs;
  }
  if (request.inclined.empty()) {
    made = std::move(with_springs);
    return whole;
  }
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(share.K, &first, &end));
  std::vector<FactorRequest::Entry> entries;
  std::vector<char> is_turned(static_cast<std::size_t>(end - first), 0);
  for (const FactorRequest::Turned& at : request.inclined) {
    const auto row = static_cast<PetscInt>(place_of(at.node));
    if (row < first || row >= end) continue;
    for (int i = 0; i < 2; ++i) {
      is_turned[static_cast<std::size_t>(row + i - first)] = 1;
      for (int j = 0; j < 2; ++j) entries.push_back({row + i, row + j, at.M[2 * i + j]});
    }
  }
  for (PetscInt row = first; row < end; ++row)
    if (!is_turned[static_cast<std::size_t>(row - first)]) entries.push_back({row, row, 1.0});
  OwnedMat T;
  from_entries(share.K, entries, T);
  check(MatPtAP(whole, T, MAT_INITIAL_MATRIX, PETSC_DEFAULT, made.out()));
  return made;
}

/// Numbers of the solved unknowns of all ranks, from 1; 0: not solved. Most that are asked for are this rank's: only
/// theirs are kept.
class Numbers {
 public:
  Numbers(const std::vector<char>& solved, PetscInt first, PetscInt end) : solved_(solved), first_(first), end_(end) {
    own_.reserve(static_cast<std::size_t>(end - first));
    MUMPS_INT count = 0;
    for (std::size_t i = 0; i < solved.size(); ++i) {
      if (i % stride == 0) before_.push_back(count);
      if (solved[i]) ++count;
      if (static_cast<PetscInt>(i) >= first && static_cast<PetscInt>(i) < end) own_.push_back(solved[i] ? count : 0);
    }
    count_ = count;
  }
  int count() const { return count_; }
  MUMPS_INT operator[](PetscInt i) const {
    if (i >= first_ && i < end_) return own_[static_cast<std::size_t>(i - first_)];
    const auto at = static_cast<std::size_t>(i);
    if (!solved_[at]) return 0;
    const auto from = solved_.begin() + static_cast<std::ptrdiff_t>(at / stride * stride);
    const auto to = solved_.begin() + static_cast<std::ptrdiff_t>(at) + 1;
    return before_[at / stride] + static_cast<MUMPS_INT>(std::count_if(from, to, [](char is) { return is != 0; }));
  }

 private:
  static constexpr std::size_t stride = 64;
  const std::vector<char>& solved_;
  PetscInt first_, end_;
  std::vector<MUMPS_INT> own_, before_;  // before every stride-th
  int count_ = 0;
};

/// The lower triangle of the solved rows and columns that this rank has, and how many there are of all ranks.
MumpsFactor::Entries solved_part(Mat whole, const std::vector<char>& solved, int& unknowns) {
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(whole, &first, &end));
  const Numbers number(solved, first, end);
  unknowns = number.count();
  MatInfo info;
  check(MatGetInfo(whole, MAT_LOCAL, &info));
  MumpsFactor::Entries entries;
  const auto most = static_cast<std::size_t>(0.55 * info.nz_used);
  entries.rows.reserve(most);
  entries.columns.reserve(most);
  entries.values.reserve(most);
  for (PetscInt row = first; row < end; ++row) {
    const MUMPS_INT i = number[row];
    if (i == 0) continue;
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    check(MatGetRow(whole, row, &count, &columns, &values));
    for (PetscInt k = 0; k < count; ++k) {
      if (columns[k] > row) continue;
      const MUMPS_INT j = number[columns[k]];
      if (j == 0) continue;
      entries.rows.push_back(i);
      entries.columns.push_back(j);
      entries.values.push_back(values[k]);
    }
    check(MatRestoreRow(whole, row, &count, &columns, &values));
  }
  return entries;
}

}  // namespace

FactorFacts Process::factorise(int id, int share_id, const FactorRequest* request) {
  Bytes packed;
  if (request) packed = pack(*request);
  FactorRequest wanted = unpack_request(broadcast(request ? &packed : nullptr));
  packed = {};
  FactorFacts facts;
  std::unique_ptr<MumpsFactor> made;
  together([&] {
    int unknowns = 0;
    MumpsFactor::Entries entries;
    {
      OwnedMat changed;
      entries = solved_part(whole_matrix(share(share_id), wanted, changed), wanted.solved, unknowns);
    }
    made = std::make_unique<MumpsFactor>(comm_);
    made->factorise(unknowns, std::move(entries), request ? request->step : std::vector<int>(),
                    std::move(wanted.condensed), facts.costs);
  });
  int definite = 0;
  const bool fine = agreed([&] {
    made->complain();
    definite = made->is_definite() ? 1 : 0;
    if (rank_ != 0 || definite == 0) return;
    try {
      timed(facts.costs.factorise, [&] { made->factorise_condensed(); });
    } catch (const linalg::NotPositiveDefinite&) {
      definite = 0;
    }
  });
  if (!fine) return facts;
  MPI_Bcast(&definite, 1, MPI_INT, 0, comm_);
  facts.definite = definite != 0;
  if (!facts.definite) return facts;
  facts.costs.entries = made->entries();
  facts.costs.operations = made->operations();
  factors_[id] = std::move(made);
  return facts;
}

void Process::release_factor(int id) { factors_.erase(id); }

void Process::solve(int id, Matrix* X) {
  together([&] { factor(id).solve(X); });
}

bool Process::is_condensed(int id) { return factor(id).is_condensed(); }

Matrix Process::condensed_block(int id, const std::vector<int>& indices) { return factor(id).condensed_block(indices); }

void Process::inverse_block(int id, const std::vector<int>* indices, Matrix* block) {
  together([&] { factor(id).inverse_block(indices, block); });
}

}  // namespace scabo::mpi
