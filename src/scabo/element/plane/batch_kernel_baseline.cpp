#define SCABO_KERNEL batch_baseline
#define SCABO_LANES 2
#define SCABO_TILE 3
#define SCABO_INSTRUCTIONS "baseline"
#include "scabo/element/plane/batch_kernel_lanes.hpp"
