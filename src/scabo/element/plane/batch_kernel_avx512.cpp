#define SCABO_KERNEL batch_avx512
#define SCABO_LANES 8
#define SCABO_TILE 4
#define SCABO_INSTRUCTIONS "AVX-512"
#include "scabo/element/plane/batch_kernel_lanes.hpp"
