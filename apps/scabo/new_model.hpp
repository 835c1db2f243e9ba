// The models that `scabo new` writes: short, commented and ready to run.
#pragma once

#include <string_view>
#include <vector>

namespace scabo::app {

struct StarterModel {
  std::string_view name, subject, text;
};

/// In the order in which they are offered; apps/scabo/models holds their files.
const std::vector<StarterModel>& starter_models();

}  // namespace scabo::app
