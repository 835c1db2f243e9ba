// Products and triangular solves of matrices of up to a few hundred rows, in tiles that stay in the vector registers.
//
// BLAS packs its operands first and solves triangles slowly: at 40 rows it reaches a quarter of the speed of these, at
// 160 half (docs/methods/02). The same source (tile_kernel_lanes.hpp) is compiled once for each instruction set; which
// ones this processor has is asked when the program runs. Matrices are column-major, a stride is from column to column.
#pragma once

namespace scabo::linalg {

struct TileKernel {
  const char* instructions;  ///< name of the instruction set

  /// C <- C - A A', the lower triangle (above it entries beside the diagonal may be changed); C n x n, A n x depth.
  void (*subtract_square)(const double* A, long a_stride, int n, int depth, double* C, long c_stride);

  /// A <- L, its Cholesky factor (lower triangle); `over`: n, 1 / L_ii. False where A is not positive definite.
  bool (*cholesky)(double* A, long stride, int n, double* over);

  /// B <- B L^-T, or B L^-1 when `transposed`; B rows x n, L and `over` as cholesky left them.
  void (*divide)(const double* L, long stride, const double* over, int n, double* B, long b_stride, int rows,
                 bool transposed);
};

/// The kernels that this processor can run, the fastest first: a pointer for `rank` 0, 1 ..., then null. One at least.
const TileKernel* tile_kernel(int rank);

}  // namespace scabo::linalg
