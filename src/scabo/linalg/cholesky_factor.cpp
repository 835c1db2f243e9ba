#include "scabo/linalg/cholesky_factor.hpp"

#include <cblas.h>

#include <algorithm>
#include <cstddef>
#include <memory>

#include "scabo/base/error.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/linalg/tile_kernel.hpp"

namespace scabo::linalg {

namespace {

constexpr int most_by_tiles = 200;  // rows: there BLAS is as fast with AVX-512
constexpr int largest_block = 32;
/// Multiplications and additions between two interruption points: a third of a second.
constexpr double most_at_once = 1e10;

/// How many rows or columns are treated at once if each takes `each` operations.
int at_once(double each) { return std::max(64, static_cast<int>(std::min(1e9, most_at_once / each))); }

const TileKernel& tiles() {
  static const TileKernel& fastest = *tile_kernel(0);
  return fastest;
}

/// Inverse of a small lower triangular matrix, column by column, with m as stride; zeros above.
void invert_lower(const double* l, std::ptrdiff_t stride, int m, const double* over, double* inverse) {
  for (int j = 0; j < m; ++j) {
    double* const x = inverse + j * m;
    std::fill(x, x + m, 0.0);
    x[j] = 1.0;
    for (int k = j; k < m; ++k) {
      const double* const column = l + k * stride;
      const double value = x[k] * over[k];
      x[k] = value;
      for (int i = k + 1; i < m; ++i) x[i] -= value * column[i];
    }
  }
}

}  // namespace

const double* CholeskyFactor::inverse(int block) const {
  return inverses_.data() + block * largest_block * largest_block;
}

bool CholeskyFactor::factorise() {
  ensure(A.rows() == A.cols(), "CholeskyFactor needs a square matrix");
  const int n = static_cast<int>(A.rows());
  if (n <= most_by_tiles) {
    starts_ = {0, n};
    inverses_.resize(static_cast<std::size_t>(n));
    return tiles().cholesky(A.data(), n, n, inverses_.data());
  }
  const int count = (n + largest_block - 1) / largest_block;
  starts_.resize(static_cast<std::size_t>(count) + 1);
  for (int k = 0; k <= count; ++k)
    starts_[static_cast<std::size_t>(k)] = static_cast<int>(static_cast<long>(n) * k / count);
  inverses_.resize(static_cast<std::size_t>(count) * largest_block * largest_block);
  return factorise_blocks(0, count);
}

/// Blocks first to last - 1 on the diagonal.
bool CholeskyFactor::factorise_blocks(int first, int last) {
  const int n = static_cast<int>(A.rows()), at = start(first), end = start(last);
  if (last - first == 1) {
    interruption_point();
    double over[largest_block];
    if (!tiles().cholesky(&A(at, at), n, end - at, over)) return false;
    invert_lower(&A(at, at), n, end - at, over, inverses_.data() + first * largest_block * largest_block);
    return true;
  }
  const int middle = (first + last) / 2, half = start(middle);
  if (!factorise_blocks(first, middle)) return false;
  divide_by_blocks(first, middle, {&A(half, 0), end - half, n}, false);
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, end - half, half - at, -1.0, &A(half, at), n, 1.0,
              &A(half, half), n);
  return factorise_blocks(middle, last);
}

void CholeskyFactor::multiply_by_inverse(int block, Rows B, bool transposed) const {
  const int at = start(block), m = start(block + 1) - at;
  double* const columns = B.at + static_cast<std::ptrdiff_t>(at) * B.stride;
  const auto copy =
      std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(B.count) * static_cast<std::size_t>(m));
  for (std::ptrdiff_t j = 0; j < m; ++j) std::copy_n(columns + j * B.stride, B.count, copy.get() + j * B.count);
  cblas_dgemm(CblasColMajor, CblasNoTrans, transposed ? CblasNoTrans : CblasTrans, B.count, m, m, 1.0, copy.get(),
              B.count, inverse(block), m, 0.0, columns, B.stride);
}

/// Columns of B that belong to the blocks first to last - 1.
void CholeskyFactor::divide_by_blocks(int first, int last, Rows B, bool transposed) const {
  if (last - first == 1) return multiply_by_inverse(first, B, transposed);
  const int middle = (first + last) / 2, at = start(first), half = start(middle), end = start(last),
            n = static_cast<int>(A.rows());
  double *const left = B.at + static_cast<std::ptrdiff_t>(at) * B.stride, *const right =
                                                                              B.at + static_cast<std::ptrdiff_t>(half) *
                                                                                         B.stride;
  if (transposed) {
    divide_by_blocks(middle, last, B, true);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, B.count, half - at, end - half, -1.0, right, B.stride,
                &A(half, at), n, 1.0, left, B.stride);
    divide_by_blocks(first, middle, B, true);
  } else {
    divide_by_blocks(first, middle, B, false);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, B.count, end - half, half - at, -1.0, left, B.stride,
                &A(half, at), n, 1.0, right, B.stride);
    divide_by_blocks(middle, last, B, false);
  }
}

void CholeskyFactor::divide(Matrix& B, bool transposed) const {
  ensure(B.cols() == A.rows(), "CholeskyFactor: sizes differ");
  if (B.size() == 0) return;
  const int n = static_cast<int>(A.rows()), rows = static_cast<int>(B.rows());
  if (blocks() == 1) {
    tiles().divide(A.data(), n, inverses_.data(), n, B.data(), rows, rows, transposed);
    return;
  }
  const int piece = at_once(static_cast<double>(n) * n);
  for (int first = 0; first < rows; first += piece) {
    interruption_point();
    divide_by_blocks(0, blocks(), {B.data() + first, std::min(piece, rows - first), rows}, transposed);
  }
}

void subtract_square(const Matrix& A, Matrix& C) {
  ensure(C.rows() == A.rows() && C.cols() == A.rows(), "subtract_square: sizes differ");
  if (A.size() == 0) return;
  const int n = static_cast<int>(A.rows()), depth = static_cast<int>(A.cols());
  if (n <= 2 * most_by_tiles) {
    tiles().subtract_square(A.data(), n, n, depth, C.data(), n);
    return;
  }
  const int piece = at_once(static_cast<double>(n) * depth);
  for (int first = 0; first < n; first += piece) {  // columns of C
    interruption_point();
    const int count = std::min(piece, n - first), below = n - first - count;
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, count, depth, -1.0, &A(first, 0), n, 1.0, &C(first, first), n);
    if (below > 0)
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, below, count, depth, -1.0, &A(first + count, 0), n,
                  &A(first, 0), n, 1.0, &C(first + count, first), n);
  }
}

}  // namespace scabo::linalg
