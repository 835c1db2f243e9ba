// The stiffness of a divided part: cells, rows, products.
#include "share.hpp"

#include <algorithm>
#include <limits>

#include "own_fields.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/system/assembly.hpp"
#include "transfer.hpp"

namespace scabo::mpi {

namespace {

/// Stiffness of the cells of a share, and the numbers of its nodes among all ranks. Nodes that two of its bodies have
/// in common are one.
struct OwnStiffness {
  std::vector<PetscInt> numbers;
  linalg::SparseMatrix K;
};

OwnStiffness own_stiffness(const model::Model& model, const Share& share) {
  OwnStiffness own;
  const auto of_body = [&](std::size_t b) {
    system::Stiffness stiffness = system::body_stiffness(model, model::extent_of(model, static_cast<int>(b)),
                                                         share.mesh.bodies[b], share.cells[b], share.threads);
    return stiffness.dense ? linalg::SparseMatrix(stiffness.dense->sparseView(0.0, 0.0)) : std::move(stiffness.sparse);
  };
  if (share.bodies.size() == 1) {
    const auto b = static_cast<std::size_t>(share.bodies.front());
    own.numbers.assign(share.numbers[b].begin(), share.numbers[b].end());
    if (!share.mesh.bodies[b].cells.empty()) own.K = of_body(b);
    return own;
  }
  for (const int b : share.bodies) {
    const std::vector<int>& numbers = share.numbers[static_cast<std::size_t>(b)];
    own.numbers.insert(own.numbers.end(), numbers.begin(), numbers.end());
  }
  std::sort(own.numbers.begin(), own.numbers.end());
  own.numbers.erase(std::unique(own.numbers.begin(), own.numbers.end()), own.numbers.end());
  std::vector<Eigen::Triplet<double>> entries;
  for (const int body : share.bodies) {
    const auto b = static_cast<std::size_t>(body);
    if (share.mesh.bodies[b].cells.empty()) continue;
    std::vector<int> place;
    for (const int number : share.numbers[b])
      place.push_back(
          static_cast<int>(std::lower_bound(own.numbers.begin(), own.numbers.end(), number) - own.numbers.begin()));
    const auto at = [&](Eigen::Index dof) {
      return static_cast<int>(
          place_of(place[static_cast<std::size_t>(plane_components.node_of(dof))], plane_components.component_of(dof)));
    };
    const linalg::SparseMatrix K = of_body(b);
    for (Eigen::Index j = 0; j < K.cols(); ++j)
      for (linalg::SparseMatrix::InnerIterator it(K, j); it; ++it)
        entries.emplace_back(at(it.row()), at(j), it.value());
  }
  const auto n = places_of(own.numbers.size());
  own.K.resize(n, n);
  own.K.setFromTriplets(entries.begin(), entries.end());
  return own;
}

/// K of all ranks from what each has.
void assemble(MPI_Comm comm, int rank, OwnStiffness own, Share& share) {
  const auto local = static_cast<PetscInt>(places_of(own.numbers.size()));
  const auto rows = static_cast<PetscInt>(places_of(share.nodes(rank))),
             all = static_cast<PetscInt>(places_of(share.first.back()));
  if (own.K.rows() == 0) own.K.resize(local, local);
  own.K.makeCompressed();
  OwnedMapping mapping;
  check(ISLocalToGlobalMappingCreate(comm, 2, local / 2, own.numbers.data(), PETSC_COPY_VALUES, mapping.out()));
  OwnedMat parts, alone;
  check(MatCreateIS(comm, 2, rows, rows, all, all, mapping, mapping, parts.out()));
  // Symmetric: its columns are its rows.
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, local, local, own.K.outerIndexPtr(), own.K.innerIndexPtr(),
                                  own.K.valuePtr(), alone.out()));
  check(MatISSetLocalMat(parts, alone));
  check(MatAssemblyBegin(parts, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(parts, MAT_FINAL_ASSEMBLY));
  check(MatConvert(parts, MATMPIAIJ, MAT_INITIAL_MATRIX, share.K.out()));
  check(MatSetOption(share.K, MAT_SYMMETRIC, PETSC_TRUE));
}

/// What products need: vectors, and the ways between them.
void prepare_products(Share& share) {
  check(MatCreateVecs(share.K, share.x.out(), share.y.out()));
  check(VecScatterCreateToZero(share.x, share.to_root.out(), share.at_root.out()));
  const PetscInt* columns = nullptr;
  check(MatMPIAIJGetSeqAIJ(share.K, &share.own_columns, &share.other_columns, &columns));
  PetscInt count = 0;
  check(MatGetSize(share.other_columns, nullptr, &count));
  check(VecCreateSeq(PETSC_COMM_SELF, count, share.others.out()));
  OwnedIS wanted;
  check(ISCreateGeneral(PETSC_COMM_SELF, count, columns, PETSC_COPY_VALUES, wanted.out()));
  check(VecScatterCreate(share.x, wanted, share.others, nullptr, share.to_others.out()));
}

/// Rows of a sequential matrix, by PETSc's own arrays.
class Rows {
 public:
  explicit Rows(Mat A) : A_(A) {
    PetscBool done = PETSC_FALSE;
    check(MatGetRowIJ(A_, 0, PETSC_FALSE, PETSC_FALSE, &count_, &start_, &column_, &done));
    ensure(done == PETSC_TRUE, "PETSc gives no rows of its matrix");
    check(MatSeqAIJGetArrayRead(A_, &value_));
  }
  ~Rows() {
    PetscBool done = PETSC_FALSE;
    static_cast<void>(MatSeqAIJRestoreArrayRead(A_, &value_));
    static_cast<void>(MatRestoreRowIJ(A_, 0, PETSC_FALSE, PETSC_FALSE, &count_, &start_, &column_, &done));
  }
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  /// visit(value, column) for each entry.
  template <typename Visit>
  void row(std::size_t i, const Visit& visit) const {
    for (PetscInt k = start_[i]; k < start_[i + 1]; ++k) visit(value_[k], static_cast<std::size_t>(column_[k]));
  }

 private:
  Mat A_;
  PetscInt count_ = 0;
  const PetscInt *start_ = nullptr, *column_ = nullptr;
  const PetscScalar* value_ = nullptr;
};

}  // namespace

ShareFacts Process::divide(int id, const std::function<Bytes(int)>& message_of) {
  Bytes message = distributed(message_of);
  auto made = std::make_unique<Share>();
  ShareFacts facts;
  OwnStiffness own;
  double seconds[2] = {0.0, 0.0};
  const bool all_solved = agreed([&] {
    *made = unpack_share(message, model().bodies.size());
    message = {};
    timed(seconds[0], [&] { made->cells = element::solve_cells(model(), made->mesh, made->threads); });
    timed(seconds[1], [&] { own = own_stiffness(model(), *made); });
  });
  if (!all_solved) return facts;
  double local[3] = {0.0, 0.0, system::Stiffness().rounding};
  for (const int b : made->bodies)
    for (const auto& cell : made->cells[static_cast<std::size_t>(b)])
      if (cell) local[2] = std::max(local[2], cell->rounding());
  together([&] {
    timed(seconds[1], [&] { assemble(comm_, rank_, std::move(own), *made); });
    prepare_products(*made);
    MatInfo info;
    check(MatGetInfo(made->K, MAT_GLOBAL_SUM, &info));
    facts.entries = info.nz_used;
    check(MatGetDiagonal(made->K, made->x));
    PetscReal largest = 0.0;
    check(VecMax(made->x, nullptr, &largest));
    facts.largest_diagonal = largest;
  });
  MPI_Allreduce(&local[2], &facts.rounding, 1, MPI_DOUBLE, MPI_MAX, comm_);
  double slowest[2] = {0.0, 0.0};
  MPI_Allreduce(seconds, slowest, 2, MPI_DOUBLE, MPI_MAX, comm_);
  facts.seconds_cells = slowest[0];
  facts.seconds_assembly = slowest[1];
  shares_[id] = std::move(made);
  own_fields_.reset();
  return facts;
}

void Process::release_share(int id) {
  shares_.erase(id);
  own_fields_.reset();
}

void Process::multiply(int id, const Vector* u, Vector* y) {
  together([&] {
    Share& at = share(id);
    spread(at.at_root, at.x, at.to_root, u ? u->data() : nullptr);
    check(MatMult(at.K, at.x, at.y));
    if (y) y->resize(places_of(at.first.back()));
    collect(at.y, at.at_root, at.to_root, y ? y->data() : nullptr);
  });
}

void Process::multiply_squares(int id, const Vector* u, Vector* y) {
  together([&] {
    Share& at = share(id);
    spread(at.at_root, at.x, at.to_root, u ? u->data() : nullptr);
    check(VecScatterBegin(at.to_others, at.x, at.others, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(at.to_others, at.x, at.others, INSERT_VALUES, SCATTER_FORWARD));
    const std::vector<double> own = values_of(at.x), others = values_of(at.others);
    const Rows own_rows(at.own_columns), other_rows(at.other_columns);
    std::vector<double> sums(own.size(), 0.0);
    for (std::size_t i = 0; i < own.size(); ++i) {
      own_rows.row(i, [&](double value, std::size_t j) { sums[i] += value * value * own[j]; });
      other_rows.row(i, [&](double value, std::size_t j) { sums[i] += value * value * others[j]; });
    }
    set_values(at.y, sums.data());
    if (y) y->resize(places_of(at.first.back()));
    collect(at.y, at.at_root, at.to_root, y ? y->data() : nullptr);
  });
}

void Process::multiply_twofold(int id, const linalg::TwofoldVector* u, linalg::TwofoldVector* y) {
  together([&] {
    Share& at = share(id);
    const auto n = places_of(at.first.back());
    linalg::TwofoldVector own, others;
    for (const bool low : {false, true}) {
      Vector half;
      if (u) {
        half.resize(n);
        for (Eigen::Index i = 0; i < n; ++i) {
          const linalg::Twofold& value = (*u)[static_cast<std::size_t>(i)];
          half[i] = low ? value.low : value.high;
        }
      }
      spread(at.at_root, at.x, at.to_root, u ? half.data() : nullptr);
      check(VecScatterBegin(at.to_others, at.x, at.others, INSERT_VALUES, SCATTER_FORWARD));
      check(VecScatterEnd(at.to_others, at.x, at.others, INSERT_VALUES, SCATTER_FORWARD));
      for (const auto& [vector, into] : {std::pair<Vec, linalg::TwofoldVector*>{at.x, &own}, {at.others, &others}}) {
        const std::vector<double> values = values_of(vector);
        into->resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) (low ? (*into)[i].low : (*into)[i].high) = values[i];
      }
    }
    const Rows own_rows(at.own_columns), other_rows(at.other_columns);
    linalg::TwofoldVector sums(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      own_rows.row(i, [&](double value, std::size_t j) { sums[i] = sums[i] + linalg::Twofold{value, 0.0} * own[j]; });
      other_rows.row(i, [&](double value, std::size_t j) {
        sums[i] = sums[i] + linalg::Twofold{value, 0.0} * others[j];
      });
    }
    if (y) y->resize(static_cast<std::size_t>(n));
    for (const bool low : {false, true}) {
      std::vector<double> half;
      for (const linalg::Twofold& sum : sums) half.push_back(low ? sum.low : sum.high);
      set_values(at.y, half.data());
      Vector all;
      if (y) all.resize(n);
      collect(at.y, at.at_root, at.to_root, y ? all.data() : nullptr);
      for (Eigen::Index i = 0; i < all.size(); ++i)
        (low ? (*y)[static_cast<std::size_t>(i)].low : (*y)[static_cast<std::size_t>(i)].high) = all[i];
    }
  });
}

}  // namespace scabo::mpi
