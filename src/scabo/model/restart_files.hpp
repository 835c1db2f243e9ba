// Files of a results directory that another run may start from (analysis/state/restart.hpp writes and reads them).
#pragma once

namespace scabo::model {

constexpr const char* state_at_end_file = "end.state";   ///< what every body and contact has, by its name
constexpr const char* factors_at_end_file = "end.yaml";  ///< factors of loads and supports, which steps start from

}  // namespace scabo::model
