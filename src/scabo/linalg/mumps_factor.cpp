#include "scabo/base/error.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/elimination_order.hpp"
#include "scabo/linalg/sparse_factor.hpp"

#ifdef SCABO_MUMPS
#include <dlfcn.h>
#include <dmumps_c.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <new>
#endif

namespace scabo::linalg {

#ifdef SCABO_MUMPS

namespace {

/// The only function of MUMPS, from the library that is loaded when it is first needed; null if it is missing.
decltype(&dmumps_c) mumps_function() {
  static const auto function = [] {
    void* handle = dlopen(SCABO_MUMPS, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr)
      handle = dlopen(std::filesystem::path(SCABO_MUMPS).filename().c_str(), RTLD_NOW | RTLD_LOCAL);
    return handle == nullptr ? nullptr : reinterpret_cast<decltype(&dmumps_c)>(dlsym(handle, "dmumps_c"));
  }();
  return function;
}

class MumpsFactor final : public SparseFactor {
 public:
  MumpsFactor(const SparseMatrix& A, const SparseOptions& options, FactorisationCosts& costs) {
    ensure(mumps_function() != nullptr, "the library of MUMPS was not found");
    std::vector<std::int64_t> order =
        timed(costs.order, [&] { return elimination_order(A, options.ordering, options.positions); });
    std::vector<MUMPS_INT> step(order.size()), rows, columns;
    for (std::size_t k = 0; k < order.size(); ++k)
      step[static_cast<std::size_t>(order[k])] = static_cast<MUMPS_INT>(k + 1);
    std::vector<double> values;
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (SparseMatrix::InnerIterator it(A, j); it; ++it)
        if (it.row() >= j) {
          rows.push_back(static_cast<MUMPS_INT>(it.row() + 1));
          columns.push_back(static_cast<MUMPS_INT>(j + 1));
          values.push_back(it.value());
        }

    mumps_.sym = 1;  // positive definite
    mumps_.par = 1;
    mumps_.comm_fortran = -987654;  // MPI_COMM_WORLD
    call(-1);
    try {
      std::fill(&icntl(1), &icntl(4) + 1, 0);  // no messages
      icntl(7) = 1;                            // order of elimination given
      icntl(8) = 0;                            // no scaling: a factor of A itself, as the other library's
      mumps_.n = static_cast<MUMPS_INT>(A.rows());
      mumps_.nnz = static_cast<MUMPS_INT8>(values.size());
      mumps_.irn = rows.data();
      mumps_.jcn = columns.data();
      mumps_.a = values.data();
      mumps_.perm_in = step.data();
      timed(costs.analyse, [&] { return call(1); });
      timed(costs.factorise, [&] {
        constexpr MUMPS_INT most_relaxed = 1000;  // per cent of the estimated memory
        call(2, most_relaxed);
        if (mumps_.infog[11] > 0) throw NotPositiveDefinite();  // negative pivots
        return 0;
      });
    } catch (...) {
      release();
      throw;
    }
    mumps_.irn = mumps_.jcn = mumps_.perm_in = nullptr;
    mumps_.a = nullptr;
    costs.entries += mumps_.infog[28] < 0 ? -1e6 * mumps_.infog[28] : mumps_.infog[28];
    costs.operations += mumps_.rinfog[2];
  }
  ~MumpsFactor() override { release(); }
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  Matrix solve(const Matrix& B) const override {
    Matrix X = B;
    if (B.size() == 0) return X;
    icntl(20) = icntl(30) = 0;
    mumps_.rhs = X.data();
    mumps_.nrhs = static_cast<MUMPS_INT>(X.cols());
    mumps_.lrhs = mumps_.n;
    call(3);
    mumps_.rhs = nullptr;
    return X;
  }

  /// Selected entries of the inverse (ICNTL(30); Amestoy et al., SIAM J. Sci. Comput. 34 (2012) A1975): MUMPS visits
  /// only the part of the elimination tree that right-hand sides and wanted rows reach.
  Matrix inverse_block(const std::vector<int>& indices) const override {
    if (indices.empty()) return {};
    std::vector<int> distinct = indices;  // each only once
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    ensure(distinct.size() < 46341, "MUMPS counts entries of the inverse with 32 bits");
    std::vector<MUMPS_INT> starts(static_cast<std::size_t>(mumps_.n) + 1), rows, pattern;
    for (const int row : distinct) rows.push_back(row + 1);
    pattern.reserve(rows.size() * rows.size());
    for (std::size_t j = 0; j < distinct.size(); ++j) pattern.insert(pattern.end(), rows.begin(), rows.end());
    std::size_t next = 0;
    for (int j = 0; j <= mumps_.n; ++j) {
      starts[static_cast<std::size_t>(j)] = static_cast<MUMPS_INT>(next * rows.size() + 1);
      if (next < distinct.size() && distinct[next] == j) ++next;
    }
    const auto m = static_cast<Eigen::Index>(distinct.size());
    Matrix values = Matrix::Zero(m, m);
    icntl(20) = 0;
    icntl(30) = 1;
    icntl(27) = 128;  // columns at a time
    mumps_.nrhs = mumps_.n;
    mumps_.nz_rhs = static_cast<MUMPS_INT>(pattern.size());
    mumps_.rhs_sparse = values.data();
    mumps_.irhs_sparse = pattern.data();
    mumps_.irhs_ptr = starts.data();
    call(3);
    icntl(30) = 0;
    mumps_.rhs_sparse = nullptr;
    mumps_.irhs_sparse = mumps_.irhs_ptr = nullptr;
    std::vector<Eigen::Index> places;
    for (const int index : indices)
      places.push_back(std::lower_bound(distinct.begin(), distinct.end(), index) - distinct.begin());
    const Matrix block = values(places, places);
    return 0.5 * (block + block.transpose());
  }

 private:
  MUMPS_INT& icntl(int number) const { return mumps_.icntl[number - 1]; }

  /// Job -1: begin, 1: analyse, 2: factorise, 3: solve, -2: end. If memory was estimated too small, it is doubled until
  /// `most_relaxed` per cent.
  int call(MUMPS_INT job, MUMPS_INT most_relaxed = 0) const {
    static std::mutex one_at_a_time;  // its Fortran has global variables
    const std::lock_guard lock(one_at_a_time);
    for (;;) {
      mumps_.job = job;
      mumps_function()(&mumps_);
      const MUMPS_INT error = mumps_.infog[0];
      if (error >= 0 || job == -2) return 0;
      const bool too_small = error == -8 || error == -9;
      if (too_small && icntl(14) < most_relaxed) {
        icntl(14) = 2 * std::max<MUMPS_INT>(icntl(14), 20);
        continue;
      }
      if (too_small || error == -5 || error == -7 || error == -13 || error == -19) throw std::bad_alloc();
      if (error == -10 || error == -40 || error == -6) throw NotPositiveDefinite();
      throw BrokenInvariant("MUMPS reports error " + std::to_string(error) + " in its job " + std::to_string(job));
    }
  }
  void release() { call(-2); }

  mutable DMUMPS_STRUC_C mumps_{};
};

}  // namespace

bool is_built_in(SparseLibrary library) { return library == SparseLibrary::cholmod || mumps_function() != nullptr; }

std::unique_ptr<SparseFactor> factorise_by_mumps(const SparseMatrix& A, const SparseOptions& options,
                                                 FactorisationCosts& costs) {
  return std::make_unique<MumpsFactor>(A, options, costs);
}

#else

bool is_built_in(SparseLibrary library) { return library == SparseLibrary::cholmod; }

std::unique_ptr<SparseFactor> factorise_by_mumps(const SparseMatrix&, const SparseOptions&, FactorisationCosts&) {
  throw BrokenInvariant("this program was built without MUMPS");
}

#endif

}  // namespace scabo::linalg
