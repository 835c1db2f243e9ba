// `springs` of models in space.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scabo/input/space/space_reader.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::input {

using namespace model;

/// A number along the normal of a face; `[x, y, z]` of nodes or a body.
void SpaceReader::spring_at_rest(const Value& value, SpaceSpring& spring) {
  if (!spring.along_face) {
    spring.at_rest = vector(value);
    for (int k = 0; k < 3; ++k)
      if (spring.at_rest[k] != 0.0 && spring.stiffness[k] == 0.0)
        report_.error(value, fmt::format("has no effect along {0}, because k_{0} is 0: write 0 there", "xyz"[k]));
    return;
  }
  spring.at_rest[0] = number(value);
  if (spring.at_rest[0] != 0.0 && spring.normal == 0.0)
    report_.error(value, "is a displacement along the normal of the face, and k_n is 0: give k_n");
}

void SpaceReader::spring(const Value& value) {
  const MapReader map(report_, value, {"on", "k_n", "k_t", "k_x", "k_y", "k_z", "at_rest", "name"},
                      "{on: block.bottom, k_n: 50e6}",
                      {{"k", "write k_n, along the normal of a face, and k_t, across it"},
                       {"stiffness", "write k_n, along the normal of a face, and k_t, across it"}});
  if (!map.is_map()) return;
  const std::size_t before = report_.count();
  SpaceSpring spring;
  const auto on = map.need("on");
  const auto found = on ? place(*on, "a spring") : std::nullopt;
  if (found) spring.on = *found;
  const bool of_face = map.has("k_n") || map.has("k_t"), of_axes = map.has("k_x") || map.has("k_y") || map.has("k_z");
  spring.along_face = of_face;
  spring.normal = number_from(map.get("k_n"), 0.0, true);
  spring.tangential = number_from(map.get("k_t"), 0.0, true);
  for (int k = 0; k < 3; ++k)
    spring.stiffness[k] = number_from(map.get(std::array{"k_x", "k_y", "k_z"}[static_cast<std::size_t>(k)]), 0.0, true);
  if (of_face == of_axes) {
    if (of_face || map.all_known())
      report_.error(
          value,
          "needs k_n or k_t, on a face (N/m3), or k_x, k_y or k_z, on a point, a set of nodes or a rigid body "
          "(N/m) or an edge (N/m2)");
  } else if (found && of_face && found->is_body()) {
    report_.error(*on, fmt::format("is a whole body, on which k_x, k_y and k_z act: name a face, as in {}.bottom",
                                   body_at(found->body).name));
  } else if (found && of_face && (found->is_edge() || found->is_point())) {
    report_.error(*on, "is no face, on which k_n and k_t act: give it k_x, k_y and k_z");
  } else if (found && of_axes && !found->is_body() && !found->is_set_of_nodes() && !found->is_edge() &&
             !found->is_point()) {
    report_.error(*on,
                  "is a face, on which k_n and k_t act: k_x, k_y and k_z are those of an edge, a point, a set of "
                  "nodes or a rigid body");
  } else if (report_.count() == before &&
             std::max({spring.normal, spring.tangential, spring.stiffness.maxCoeff()}) == 0.0) {
    report_.error(value, "has no stiffness above 0: one of them must be");
  }
  if (const auto at_rest = map.get("at_rest")) {
    spring_at_rest(*at_rest, spring);
    if (!map.has("name")) map.refuse("at_rest", "needs a 'name' beside it, by which steps give it a factor");
  }
  if (const auto name = map.get("name")) {
    const auto text = read_text(report_, *name);
    if (text && check_name(report_, name->source(), *text)) spring.name = *text;
    for (const SpaceSpring& other : model_.springs)
      if (text && other.name == *text) report_.error(*name, fmt::format("two springs are called '{}'", *text));
  }
  model_.springs.push_back(std::move(spring));
}

void SpaceReader::springs(const Value& value) {
  for (const Value& item : read_list(report_, value, "[{on: block.bottom, k_n: 50e6}]").value_or(std::vector<Value>{}))
    spring(item);
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(model_.springs.begin(), model_.springs.end(),
                       [&](const SpaceSpring& other) { return other.name == name; });
  };
  for (std::size_t i = 0; i < model_.springs.size(); ++i) {
    SpaceSpring& spring = model_.springs[i];
    std::string name = spring.on.text;  // as in the plane
    for (int k = 2; spring.name.empty() && is_taken(name); ++k) name = fmt::format("{} ({})", spring.on.text, k);
    if (spring.name.empty()) spring.name = name;
    if (spring.at_rest.isZero(0.0)) continue;
    SpaceLoad load;
    load.name = spring.name;
    load.kind = SpaceLoad::Kind::at_rest;
    load.on = spring.on;
    load.spring = static_cast<int>(i);
    model_.loads.push_back(std::move(load));
  }
}

}  // namespace scabo::input
