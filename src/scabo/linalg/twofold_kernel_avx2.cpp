#define SCABO_KERNEL twofold_avx2
#define SCABO_INSTRUCTIONS "AVX2"
#include "scabo/linalg/twofold_kernel_lanes.hpp"
