#include "scabo/linalg/sparse_general_solver.hpp"

#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "scabo/base/error.hpp"
#include "scabo/linalg/elimination_order.hpp"

namespace scabo::linalg {

namespace {

/// An order of elimination for a matrix of saddle type, [W G; G' 0]. Unknowns without a diagonal entry, or with a small
/// negative one that only holds them, have none to be eliminated with: each is put right behind a group of its
/// neighbours with equal columns, whose elimination fills it, at most half as many as the group has members. The
/// groups, with what was put behind them, are dissected. Empty where there are no such unknowns.
std::vector<int> saddle_order(const Eigen::SparseMatrix<double>& A) {
  const auto n = static_cast<int>(A.rows());
  constexpr double small = 1e-3;  // of the largest entry of its column
  std::vector<char> bare(static_cast<std::size_t>(n), 1);
  for (int j = 0; j < n; ++j) {
    double own = 0.0, largest = 0.0;
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      largest = std::max(largest, std::abs(it.value()));
      if (it.row() == j) own = it.value();
    }
    if (own > 0.0 || own < -small * largest) bare[static_cast<std::size_t>(j)] = 0;
  }
  if (std::find(bare.begin(), bare.end(), 1) == bare.end()) return {};
  const SparseMatrix both = A + SparseMatrix(A.transpose());
  const std::vector<int> groups = equal_columns(both);
  const auto count = static_cast<int>(groups.size()) - 1;
  std::vector<int> group_of(static_cast<std::size_t>(n)), room(static_cast<std::size_t>(count), 0);
  for (int g = 0; g < count; ++g)
    for (int j = groups[static_cast<std::size_t>(g)]; j < groups[static_cast<std::size_t>(g) + 1]; ++j) {
      group_of[static_cast<std::size_t>(j)] = g;
      room[static_cast<std::size_t>(g)] += bare[static_cast<std::size_t>(j)] ? 0 : 1;
    }
  for (int& of_group : room) of_group = (of_group + 1) / 2;
  std::vector<std::vector<int>> behind(static_cast<std::size_t>(count));
  for (int j = 0; j < n; ++j) {
    if (!bare[static_cast<std::size_t>(j)]) continue;
    int most = 0, best = -1;
    for (SparseMatrix::InnerIterator it(both, j); it; ++it) {
      const int g = group_of[static_cast<std::size_t>(it.row())];
      if (room[static_cast<std::size_t>(g)] > most) most = room[static_cast<std::size_t>(g)], best = g;
    }
    if (best < 0) continue;
    --room[static_cast<std::size_t>(best)];
    behind[static_cast<std::size_t>(best)].push_back(j);
    group_of[static_cast<std::size_t>(j)] = best;
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(both.nonZeros()) / 4);
  for (int j = 0; j < n; ++j) {
    const int g = group_of[static_cast<std::size_t>(j)];
    const bool first = j == groups[static_cast<std::size_t>(g)] || bare[static_cast<std::size_t>(j)];
    if (!first) continue;  // the others of the group have the same column
    int before = -1;
    for (SparseMatrix::InnerIterator it(both, j); it; ++it) {
      const int h = group_of[static_cast<std::size_t>(it.row())];
      if (h == before) continue;
      before = h;
      entries.emplace_back(h, g, 1.0);
      entries.emplace_back(g, h, 1.0);
    }
  }
  for (int g = 0; g < count; ++g) entries.emplace_back(g, g, 1.0);
  SparseMatrix quotient(count, count);
  quotient.setFromTriplets(entries.begin(), entries.end());
  std::vector<int> order;
  order.reserve(static_cast<std::size_t>(n));
  for (const std::int64_t g : elimination_order(quotient, Ordering::nested_dissection)) {
    for (int j = groups[static_cast<std::size_t>(g)]; j < groups[static_cast<std::size_t>(g) + 1]; ++j)
      if (group_of[static_cast<std::size_t>(j)] == g) order.push_back(j);
    for (const int j : behind[static_cast<std::size_t>(g)]) order.push_back(j);
  }
  return order;
}

}  // namespace

struct SparseGeneralSolver::Factor {
  const Eigen::SparseMatrix<double>* A = nullptr;
  void *symbolic = nullptr, *numeric = nullptr;
  std::vector<int> outer, inner;  // pattern that `symbolic` is of
  double control[UMFPACK_CONTROL];
  std::vector<int> indices;
  std::vector<double> room;

  Factor() { of_any(); }
  void of_any() {
    umfpack_di_defaults(control);
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    control[UMFPACK_IRSTEP] = 0;  // who calls refines with the matrix that he means
  }
  /// Pivots on the diagonal wherever elimination has filled it; with the usual tolerance of 1e-3 a hundredth of them
  /// lie elsewhere and cost a fifth more operations.
  void of_saddle() {
    of_any();
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_GIVEN;
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control[UMFPACK_SYM_PIVOT_TOLERANCE] = 1e-6;
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
  ~Factor() {
    forget_pattern();
    forget();
  }
  void forget() {
    if (numeric != nullptr) umfpack_di_free_numeric(&numeric);
    numeric = nullptr;
  }
  void forget_pattern() {
    if (symbolic != nullptr) umfpack_di_free_symbolic(&symbolic);
    symbolic = nullptr;
  }
  bool same_pattern(const Eigen::SparseMatrix<double>& other) const {
    return symbolic != nullptr &&
           std::equal(outer.begin(), outer.end(), other.outerIndexPtr(),
                      other.outerIndexPtr() + other.outerSize() + 1) &&
           std::equal(inner.begin(), inner.end(), other.innerIndexPtr(), other.innerIndexPtr() + other.nonZeros());
  }
};

SparseGeneralSolver::SparseGeneralSolver() : factor_(std::make_unique<Factor>()) {}
SparseGeneralSolver::~SparseGeneralSolver() = default;
SparseGeneralSolver::SparseGeneralSolver(SparseGeneralSolver&&) noexcept = default;
SparseGeneralSolver& SparseGeneralSolver::operator=(SparseGeneralSolver&&) noexcept = default;

bool SparseGeneralSolver::factorise(const Eigen::SparseMatrix<double>& A) {
  ensure(A.rows() == A.cols() && A.isCompressed(),
         "SparseGeneralSolver: a square matrix in compressed columns is wanted");
  factor_->forget();
  factor_->A = &A;
  reciprocal_condition_ = 1.0;
  if (A.rows() == 0) return true;
  const auto n = static_cast<int>(A.rows());
  double info[UMFPACK_INFO];
  int status = UMFPACK_OK;
  if (!factor_->same_pattern(A)) {
    factor_->forget_pattern();
    factor_->outer.assign(A.outerIndexPtr(), A.outerIndexPtr() + n + 1);
    factor_->inner.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    if (const std::vector<int> order = saddle_order(A); !order.empty()) {
      factor_->of_saddle();
      status = umfpack_di_qsymbolic(n, n, A.outerIndexPtr(), A.innerIndexPtr(), nullptr, order.data(),
                                    &factor_->symbolic, factor_->control, info);
    } else {
      factor_->of_any();
      status = umfpack_di_symbolic(n, n, A.outerIndexPtr(), A.innerIndexPtr(), nullptr, &factor_->symbolic,
                                   factor_->control, info);
    }
  }
  if (status == UMFPACK_OK)
    status = umfpack_di_numeric(A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), factor_->symbolic,
                                &factor_->numeric, factor_->control, info);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  reciprocal_condition_ = status == UMFPACK_OK ? info[UMFPACK_RCOND] : 0.0;
  return status == UMFPACK_OK;
}

void SparseGeneralSolver::solve(const Vector& b, Vector& x) const {
  const Eigen::SparseMatrix<double>& A = *factor_->A;
  ensure(b.size() == A.rows(), "SparseGeneralSolver: matrix and right-hand side differ in size");
  x.resize(b.size());
  if (b.size() == 0) return;
  factor_->indices.resize(static_cast<std::size_t>(b.size()));
  factor_->room.resize(static_cast<std::size_t>(b.size()));
  umfpack_di_wsolve(UMFPACK_A, A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr(), x.data(), b.data(), factor_->numeric,
                    factor_->control, nullptr, factor_->indices.data(), factor_->room.data());
}

}  // namespace scabo::linalg
