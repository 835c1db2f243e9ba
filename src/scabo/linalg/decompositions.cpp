#include "scabo/linalg/decompositions.hpp"

SCABO_DECOMPOSITIONS();
