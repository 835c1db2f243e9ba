#include "scabo/linalg/twofold_kernel.hpp"

#include <cstddef>

#include "scabo/linalg/instruction_sets.hpp"

namespace scabo::linalg {

namespace twofold_avx512 {
extern const TwofoldKernel kernel;
}
namespace twofold_avx2 {
extern const TwofoldKernel kernel;
}
namespace twofold_baseline {
extern const TwofoldKernel kernel;
}

const TwofoldKernel* twofold_kernel(int rank) {
  static const auto kernels = runnable(twofold_avx512::kernel, twofold_avx2::kernel, twofold_baseline::kernel);
  return rank < static_cast<int>(kernels.size()) ? kernels[static_cast<std::size_t>(rank)] : nullptr;
}

}  // namespace scabo::linalg
