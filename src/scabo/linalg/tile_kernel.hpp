// Products and triangular solves for matrices of up to a few hundred rows, in tiles that fit in the vector registers.
//
// BLAS first packs its operands and solves triangular systems slowly: at 40 rows it reaches a quarter of the speed of
// these kernels, at 160 half (docs/methods/02_ring_doubling.md). The same source (tile_kernel_lanes.hpp) is compiled
// once for each instruction set; those that the processor supports are determined at run time. Matrices are
// column-major; a stride is the distance between columns.
#pragma once

namespace scabo::linalg {

struct TileKernel {
  const char* instructions;  ///< name of the instruction set

  /// C <- C - A A', lower triangle (entries above it near the diagonal may be changed); C n x n, A n x depth.
  void (*subtract_square)(const double* A, long a_stride, int n, int depth, double* C, long c_stride);

  /// A <- L, its Cholesky factor (lower triangle); `over`: n values 1 / L_ii. False if A is not positive definite.
  bool (*cholesky)(double* A, long stride, int n, double* over);

  /// B <- B L^-T, or B L^-1 when `transposed`; B rows x n, L and `over` as cholesky left them.
  void (*divide)(const double* L, long stride, const double* over, int n, double* B, long b_stride, int rows,
                 bool transposed);
};

/// The kernels that this processor can run, the fastest first: a pointer for `rank` 0, 1 ..., then null. There is at
/// least one.
const TileKernel* tile_kernel(int rank);

}  // namespace scabo::linalg
