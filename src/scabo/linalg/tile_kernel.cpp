#include "scabo/linalg/tile_kernel.hpp"

#include <cstddef>
#include <vector>

namespace scabo::linalg {

#if defined(__x86_64__)
namespace tiles_avx512 {
extern const TileKernel kernel;
}
namespace tiles_avx2 {
extern const TileKernel kernel;
}
#endif
namespace tiles_baseline {
extern const TileKernel kernel;
}

const TileKernel* tile_kernel(int rank) {
  static const std::vector<const TileKernel*> kernels = [] {
    std::vector<const TileKernel*> found;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) found.push_back(&tiles_avx512::kernel);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) found.push_back(&tiles_avx2::kernel);
#endif
    found.push_back(&tiles_baseline::kernel);
    return found;
  }();
  return rank < static_cast<int>(kernels.size()) ? kernels[static_cast<std::size_t>(rank)] : nullptr;
}

}  // namespace scabo::linalg
