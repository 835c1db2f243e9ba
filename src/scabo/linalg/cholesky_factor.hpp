// Cholesky factor A = L L' of a dense symmetric positive definite matrix, made for many right-hand sides, which are
// rows.
//
// Up to some hundred rows by tiles (tile_kernel.hpp). Larger ones by products of BLAS: L is cut into blocks of at most
// 32 rows, the inverses of those on the diagonal are kept, and halves of L are taken one after the other: BLAS's own
// triangular solve reaches half of the speed of its product, with AVX-512 kernels a quarter.
#pragma once

#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::linalg {

class CholeskyFactor {
 public:
  /// A (n x n, lower triangle read) is to be put here; factorise() leaves L in the lower triangle and nothing of use
  /// above.
  Matrix A;

  /// False when A is not positive definite: nothing can be divided by it then.
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

  std::vector<int> starts_;       // of blocks, and n; one block: by tiles
  std::vector<double> inverses_;  // of the blocks on the diagonal, each with its size as stride; of one block 1 / L_ii
};

/// C <- C - A A', the lower triangle (above it nothing of use is left); C n x n.
void subtract_square(const Matrix& A, Matrix& C);

}  // namespace scabo::linalg
