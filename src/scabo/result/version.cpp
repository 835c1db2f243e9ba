#include "scabo/result/version.hpp"

namespace scabo::result {

std::string_view version() { return SCABO_VERSION; }  // from CMake

}  // namespace scabo::result
