#define SCABO_KERNEL batch_avx2
#define SCABO_LANES 4
#define SCABO_TILE 3
#define SCABO_INSTRUCTIONS "AVX2"
#include "scabo/element/plane/batch_kernel_lanes.hpp"
