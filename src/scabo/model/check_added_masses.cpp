// Validation of water that moves with edges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/model/checking.hpp"
#include "scabo/model/materials_of.hpp"

namespace scabo::model {

namespace {

void check_edge(Checking& checking, const std::string& path, const Place& on) {
  if (!check_place(checking, path + ".on", on)) return;
  const Body& body = checking.body(on.body);
  const auto has_mass = [&](int material) {
    return checking.model.materials[static_cast<std::size_t>(material)].density.value_or(0.0) > 0.0;
  };
  if (on.kind != Place::Kind::edge)
    checking.error(
        path, "on",
        fmt::format("'{}' is no edge: water moves with an edge, as in dam.upstream", text_of(checking.model, on)));
  else if (body.rigid || body.outside)
    checking.error(path, "on",
                   fmt::format("body '{}' is {}: water moves with elastic bodies of finite size", body.name,
                               body.rigid ? "rigid" : "unbounded"));
  else if (const auto materials = materials_of(checking.model, body);
           !checking.gaps.materials && !std::all_of(materials.begin(), materials.end(), has_mass))
    checking.error(path, "on",
                   fmt::format("body '{}' has a material without mass: water moves with bodies of which every material "
                               "has a density above 0",
                               body.name));
}

}  // namespace

void check_added_masses(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.added_masses.size(); ++i) {
    const AddedMass& water = model.added_masses[i];
    const std::string path = path_of("added_mass", water.source, i);
    checking.enter(water.source);
    if (!is_dynamic(model) && model.analysis.type != AnalysisType::modal && !checking.gaps.steps)
      checking.error(path, "", "has no effect: no step is one in time, and the analysis is not modal");
    if (model.analysis.revolved()) checking.error(path, "", "is for plane models: bodies of revolution have none");
    const bool level = checking.number(path, "level", water.level);
    checking.positive(path, "density", water.density);
    if (water.bottom && checking.number(path, "bottom", *water.bottom) && level && !(*water.bottom < water.level))
      checking.error(
          path, "bottom",
          fmt::format("must be below the level, {}, not {}", number_text(water.level), number_text(*water.bottom)));
    if (!(std::abs(water.up.norm() - 1.0) <= 1e-9))
      checking.error(path, "up", "must not be [0, 0]: it is the direction in which the depth decreases, as in [0, 1]");
    if (water.on)
      check_edge(checking, path, *water.on);
    else if (!checking.gaps.places && !checking.gaps.bodies)
      checking.error(path, "on", "names no edge");
  }
}

}  // namespace scabo::model
