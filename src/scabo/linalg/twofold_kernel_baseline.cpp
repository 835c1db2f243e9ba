#define SCABO_KERNEL twofold_baseline
#define SCABO_INSTRUCTIONS "SSE2"
#include "scabo/linalg/twofold_kernel_lanes.hpp"
