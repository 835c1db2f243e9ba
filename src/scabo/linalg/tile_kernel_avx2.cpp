#define SCABO_KERNEL tiles_avx2
#define SCABO_LANES 4
#define SCABO_TILE_VECTORS 3
#define SCABO_TILE_COLUMNS 4
#define SCABO_INSTRUCTIONS "AVX2"
#include "scabo/linalg/tile_kernel_lanes.hpp"
