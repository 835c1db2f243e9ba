#define SCABO_KERNEL tiles_baseline
#define SCABO_LANES 2
#define SCABO_TILE_VECTORS 2
#define SCABO_TILE_COLUMNS 4
#define SCABO_INSTRUCTIONS "SSE2"
#include "scabo/linalg/tile_kernel_lanes.hpp"
