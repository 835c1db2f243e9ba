// The version of Scabo, as written into results.
#pragma once

#include <string_view>

namespace scabo::result {

std::string_view version();  ///< as in `0.1.0`

}  // namespace scabo::result
