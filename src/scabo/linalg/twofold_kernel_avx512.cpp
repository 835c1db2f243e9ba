#define SCABO_KERNEL twofold_avx512
#define SCABO_INSTRUCTIONS "AVX-512"
#include "scabo/linalg/twofold_kernel_lanes.hpp"
