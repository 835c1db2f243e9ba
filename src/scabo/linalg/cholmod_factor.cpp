#include <cholmod.h>

#include <cstring>
#include <new>

#include "scabo/base/error.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/elimination_order.hpp"
#include "scabo/linalg/sparse_factor.hpp"
#include "scabo/linalg/supernodal_sweep.hpp"

extern "C" {
[[gnu::weak]] void omp_set_max_active_levels(int levels);  // exist if CHOLMOD was built with OpenMP
[[gnu::weak]] int omp_get_max_active_levels();
}

namespace scabo::linalg {

namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

/// While it exists, OpenMP starts no threads. CHOLMOD asks for four in loops that copy entries, however many there are
/// processors and whatever omp_set_num_threads says; its time goes into BLAS, which has threads of its own.
class NoThreadsOfOpenMP {
 public:
  NoThreadsOfOpenMP() {
    if (omp_get_max_active_levels) before_ = omp_get_max_active_levels();
    if (omp_set_max_active_levels) omp_set_max_active_levels(0);
  }
  ~NoThreadsOfOpenMP() {
    if (omp_set_max_active_levels) omp_set_max_active_levels(before_);
  }
  NoThreadsOfOpenMP(const NoThreadsOfOpenMP&) = delete;
  NoThreadsOfOpenMP& operator=(const NoThreadsOfOpenMP&) = delete;

 private:
  int before_ = 1;
};

/// The lower triangle with indices of 64 bits: a factor may have more than 2^31 entries.
struct LowerTriangle {
  explicit LowerTriangle(const SparseMatrix& A) : n(static_cast<std::size_t>(A.rows())) {
    const auto about = static_cast<std::size_t>(A.nonZeros() / 2) + n;
    starts.reserve(n + 1);
    rows.reserve(about);
    values.reserve(about);
    starts.push_back(0);
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      for (SparseMatrix::InnerIterator it(A, j); it; ++it)
        if (it.row() >= j) rows.push_back(it.row()), values.push_back(it.value());
      starts.push_back(static_cast<SuiteSparse_long>(rows.size()));
    }
  }
  cholmod_sparse view() {
    cholmod_sparse view{};
    view.nrow = view.ncol = n;
    view.nzmax = rows.size();
    view.p = starts.data();
    view.i = rows.data();
    view.x = values.data();
    view.stype = -1;  // symmetric, lower triangle stored
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    return view;
  }

  std::size_t n;
  std::vector<SuiteSparse_long> starts, rows;
  std::vector<double> values;
};

/// CHOLMOD's workspace and factor, freed together.
class CholmodFactor final : public SparseFactor {
 public:
  CholmodFactor(const SparseMatrix& A, const SparseOptions& options, FactorisationCosts& costs) {
    std::vector<std::int64_t> order =
        timed(costs.order, [&] { return elimination_order(A, options.ordering, options.positions); });
    cholmod_l_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.print = 0;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    const NoThreadsOfOpenMP quiet;
    LowerTriangle lower(A);
    cholmod_sparse view = lower.view();
    timed(costs.analyse, [&] {
      factor_ = cholmod_l_analyze_p(&view, order.data(), nullptr, 0, &common_);
      return 0;
    });
    if (factor_ != nullptr) timed(costs.factorise, [&] { return cholmod_l_factorize(&view, factor_, &common_); });
    const bool definite = factor_ != nullptr && common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
    if (!definite) {
      const bool out_of_memory = common_.status == CHOLMOD_OUT_OF_MEMORY;
      release();
      if (out_of_memory) throw std::bad_alloc();
      throw NotPositiveDefinite();
    }
    ensure(factor_->is_super != 0 && factor_->is_ll != 0, "CHOLMOD's factor is not supernodal");
    costs.entries += common_.lnz;
    costs.operations += common_.fl;
    const auto* const unknowns = static_cast<const SuiteSparse_long*>(factor_->Perm);
    position_.resize(factor_->n);
    for (std::size_t k = 0; k < factor_->n; ++k)
      position_[static_cast<std::size_t>(unknowns[k])] = static_cast<std::int64_t>(k);
  }
  ~CholmodFactor() override { release(); }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  Matrix solve(const Matrix& B) const override {
    Matrix X(B.rows(), B.cols());
    if (B.size() == 0) return X;
    cholmod_dense right{};
    right.nrow = static_cast<std::size_t>(B.rows());
    right.ncol = static_cast<std::size_t>(B.cols());
    right.nzmax = right.nrow * right.ncol;
    right.d = right.nrow;
    right.x = const_cast<double*>(B.data());  // the interface of CHOLMOD lacks const; the data are only read
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* solution = cholmod_l_solve(CHOLMOD_A, factor_, &right, &common_);
    if (solution == nullptr && common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    ensure(solution != nullptr, "CHOLMOD could not solve");
    std::memcpy(X.data(), solution->x, sizeof(double) * static_cast<std::size_t>(X.size()));
    cholmod_l_free_dense(&solution, &common_);
    return X;
  }

  Vector begin(const Vector& b) const override {
    Vector ordered(b.size());
    for (std::size_t i = 0; i < position_.size(); ++i) ordered[position_[i]] = b[static_cast<Eigen::Index>(i)];
    return forward(supernodes(), std::move(ordered));
  }
  Vector solve_at(const Vector& begun, const std::vector<int>& wanted) const override {
    return backward_at(supernodes(), begun, positions_of(wanted));
  }
  Vector solve_from(const Vector& begun, const Vector& more) const override {
    const Vector ordered = backward(supernodes(), begun + begin(more));
    Vector x(ordered.size());
    for (std::size_t i = 0; i < position_.size(); ++i) x[static_cast<Eigen::Index>(i)] = ordered[position_[i]];
    return x;
  }

  Matrix inverse_block(const std::vector<int>& indices) const override {
    return linalg::inverse_block(supernodes(), positions_of(indices));
  }

 private:
  SupernodalFactor supernodes() const {
    SupernodalFactor L;
    L.size = static_cast<std::int64_t>(factor_->n);
    L.supernodes = static_cast<std::int64_t>(factor_->nsuper);
    L.first_column = static_cast<const std::int64_t*>(factor_->super);
    L.first_row = static_cast<const std::int64_t*>(factor_->pi);
    L.first_value = static_cast<const std::int64_t*>(factor_->px);
    L.rows = static_cast<const std::int64_t*>(factor_->s);
    L.values = static_cast<const double*>(factor_->x);
    return L;
  }
  std::vector<std::int64_t> positions_of(const std::vector<int>& unknowns) const {
    std::vector<std::int64_t> positions;
    positions.reserve(unknowns.size());
    for (const int i : unknowns) positions.push_back(position_[static_cast<std::size_t>(i)]);
    return positions;
  }

  void release() {
    if (factor_ != nullptr) cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_finish(&common_);
  }

  mutable cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  std::vector<std::int64_t> position_;  // row of L of each unknown
};

}  // namespace

std::unique_ptr<SparseFactor> factorise_by_cholmod(const SparseMatrix& A, const SparseOptions& options,
                                                   FactorisationCosts& costs) {
  return std::make_unique<CholmodFactor>(A, options, costs);
}

}  // namespace scabo::linalg
