// Columns of products in twice the working precision (twofold.hpp), for all rows at once.
//
// Without instructions for a b + c in one rounding, every exact product is a call of a function: 13 ns an entry, 1 ns
// with AVX-512. The same source (twofold_kernel_lanes.hpp) is compiled once for each instruction set; those that the
// processor supports are determined at run time. All give the same bits.
#pragma once

namespace scabo::linalg {

struct TwofoldKernel {
  const char* instructions;  ///< name of the instruction set

  /// y <- y + a x for all rows; y = high + low, the low part not normalised.
  void (*add_column)(const double* a, long rows, double x_high, double x_low, double* high, double* low);
};

/// The kernels that this processor can run, the fastest first: a pointer for `rank` 0, 1 ..., then null. There is at
/// least one.
const TwofoldKernel* twofold_kernel(int rank);

}  // namespace scabo::linalg
