// Validation of springs.
#include <fmt/format.h>

#include "scabo/model/checking.hpp"

namespace scabo::model {

void check_springs(Checking& checking) {
  const Model& model = checking.model;
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const Spring& spring = model.springs[i];
    const std::string path = path_of("springs", spring.source, i);
    checking.enter(spring.source);
    if (spring.name.empty())
      checking.error(path, "name", "has no value: give one");
    else if (!names.insert(spring.name).second)
      checking.error(path, "name",
                     fmt::format("other springs are already named '{}': rename one of them", spring.name));
    bool good = check_place(checking, path + ".on", spring.on);
    if (checking.is_body(spring.on.body))
      checking.held[static_cast<std::size_t>(spring.on.body)] =
          checking.sprung[static_cast<std::size_t>(spring.on.body)] = 1;
    const bool on_edge = acts_along(spring);
    if (good && spring.on.kind == Place::Kind::body) {
      checking.error(
          path, "on",
          fmt::format("'{}' is a whole body: springs act on an edge, the face of a crack, a corner or a point",
                      text_of(model, spring.on)));
      good = false;
    }
    if (good && spring.on.kind == Place::Kind::face && checking.body(spring.on.body).outside) {
      checking.error(path, "on", endless_face(model, spring.on));
      good = false;
    }
    const char* keys[2] = {on_edge ? "k_n" : "k_x", on_edge ? "k_t" : "k_y"};
    for (std::size_t k = 0; k < 2; ++k)
      if (!checking.not_negative(path, keys[k], spring.stiffness[k])) good = false;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string key = fmt::format("at_rest.{}", k);
      if (!checking.number(path, key, spring.at_rest[k])) {
        good = false;
      } else if (good && spring.at_rest[k] != 0.0 && spring.stiffness[k] == 0.0) {
        checking.error(path, key,
                       fmt::format("has no effect, because {} is 0: write null, or give {}", keys[k], keys[k]));
        good = false;
      }
    }
    if (good && spring.stiffness[0] == 0.0 && spring.stiffness[1] == 0.0) {
      checking.error(path, "", fmt::format("{} and {} are 0: one of them must be more than 0", keys[0], keys[1]));
      good = false;
    }
    if (!good) checking.gaps.conditions = true;
  }
}

}  // namespace scabo::model
