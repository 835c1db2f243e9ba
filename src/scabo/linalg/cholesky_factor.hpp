// Cholesky factor A = L L' of a dense symmetric positive definite matrix, for many right-hand sides, which are stored
// as rows.
//
// Up to some hundred rows, tiles are used (tile_kernel.hpp); larger matrices use products of BLAS. L is divided into
// blocks of at most 32 rows, the inverses of the diagonal blocks are stored, and L is halved recursively: the
// triangular solve of BLAS reaches only half the speed of its product, and a quarter with AVX-512 kernels.
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

class CholeskyFactor {
 public:
  /// To be set to A (n x n, lower triangle used); factorise() leaves L in the lower triangle and undefined values
  /// above.
  Matrix A;

  /// False if A is not positive definite; divide() must not be called then.
  [[nodiscard]] bool factorise();

  /// B <- B L^-T, or B L^-1 when `transposed`; m x n.
  void divide(Matrix& B, bool transposed = false) const;

 private:
  struct Rows {
    double* at;
    int count, stride;
  };
  int start(int block) const { return starts_[static_cast<std::size_t>(block)]; }
  int blocks() const { return static_cast<int>(starts_.size()) - 1; }
  const double* inverse(int block) const;
  bool factorise_blocks(int first, int last);
  void divide_by_blocks(int first, int last, Rows B, bool transposed) const;
  void multiply_by_inverse(int block, Rows B, bool transposed) const;

  std::vector<int> starts_;       // first rows of the blocks, and n; a single block uses tiles
  std::vector<double> inverses_;  // of the diagonal blocks, stride: their size; single block: 1 / L_ii
};

/// C <- C - A A', lower triangle (undefined values above it); C n x n.
void subtract_square(const Matrix& A, Matrix& C);

}  // namespace scabo::linalg
