// The source of twofold_kernel.hpp, compiled in namespace SCABO_KERNEL. It includes no other header and has internal
// linkage throughout (tile_kernel_lanes.hpp tells why). Compilers make vectors of the loop; they must not contract its
// sums and products (-ffp-contract=off), so that the last bits are the same for all.

#include "scabo/linalg/twofold_kernel.hpp"

namespace scabo::linalg::SCABO_KERNEL {

namespace {

void add_column(const double* a, long rows, double x_high, double x_low, double* __restrict high,
                double* __restrict low) {
  for (long i = 0; i < rows; ++i) {
    const double product = a[i] * x_high, rest = __builtin_fma(a[i], x_high, -product);
    const double before = high[i], sum = before + product, part = sum - before;
    const double lost = (before - (sum - part)) + (product - part);
    high[i] = sum;
    low[i] += lost + rest + a[i] * x_low;
  }
}

}  // namespace

extern const TwofoldKernel kernel;
const TwofoldKernel kernel{SCABO_INSTRUCTIONS, add_column};

}  // namespace scabo::linalg::SCABO_KERNEL

#undef SCABO_KERNEL
#undef SCABO_INSTRUCTIONS
