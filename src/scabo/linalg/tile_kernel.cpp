#include "scabo/linalg/tile_kernel.hpp"

#include <cstddef>

#include "scabo/linalg/instruction_sets.hpp"

namespace scabo::linalg {

namespace tiles_avx512 {
extern const TileKernel kernel;
}
namespace tiles_avx2 {
extern const TileKernel kernel;
}
namespace tiles_baseline {
extern const TileKernel kernel;
}

const TileKernel* tile_kernel(int rank) {
  static const auto kernels = runnable(tiles_avx512::kernel, tiles_avx2::kernel, tiles_baseline::kernel);
  return rank < static_cast<int>(kernels.size()) ? kernels[static_cast<std::size_t>(rank)] : nullptr;
}

}  // namespace scabo::linalg
