#define SCABO_KERNEL tiles_avx512
#define SCABO_LANES 8
#define SCABO_TILE_VECTORS 3
#define SCABO_TILE_COLUMNS 8
#define SCABO_INSTRUCTIONS "AVX-512"
#include "scabo/linalg/tile_kernel_lanes.hpp"
