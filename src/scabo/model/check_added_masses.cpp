// Validation of water that moves with edges, and of point masses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/model/checking.hpp"
#include "scabo/model/materials_of.hpp"

namespace scabo::model {

namespace {

/// Whether all of a body has mass: parts without take another scheme in time.
bool has_mass(const Checking& checking, const Body& body) {
  if (body.rigid) return body.density.value_or(0.0) > 0.0;
  const auto materials = materials_of(checking.model, body);
  return checking.gaps.materials || std::all_of(materials.begin(), materials.end(), [&](int material) {
           return checking.model.materials[static_cast<std::size_t>(material)].density.value_or(0.0) > 0.0;
         });
}

void check_edge(Checking& checking, const std::string& path, const Place& on) {
  if (!check_place(checking, path + ".on", on)) return;
  const Body& body = checking.body(on.body);
  if (on.kind != Place::Kind::edge)
    checking.error(
        path, "on",
        fmt::format("'{}' is no edge: water moves with an edge, as in dam.upstream", text_of(checking.model, on)));
  else if (body.rigid || body.outside)
    checking.error(path, "on",
                   fmt::format("body '{}' is {}: water moves with elastic bodies of finite size", body.name,
                               body.rigid ? "rigid" : "unbounded"));
  else if (!has_mass(checking, body))
    checking.error(path, "on",
                   fmt::format("body '{}' has a material without mass: water moves with bodies of which every material "
                               "has a density above 0",
                               body.name));
}

void check_place_of_mass(Checking& checking, const std::string& path, const Place& on) {
  if (!check_place(checking, path + ".on", on)) return;
  const Body& body = checking.body(on.body);
  if (on.kind != Place::Kind::corner)
    checking.error(path, "on",
                   fmt::format("'{}' is no corner: a point mass stands on a corner of a body, as in tower.top_left",
                               text_of(checking.model, on)));
  else if (body.outside)
    checking.error(path, "on", fmt::format("body '{}' is unbounded, and has no inertia", body.name));
  else if (!has_mass(checking, body))
    checking.error(path, "on",
                   fmt::format("body '{}' has no mass of its own, or a material without: a point mass stands on bodies "
                               "of which every material, or the rigid body itself, has a density above 0",
                               body.name));
}

}  // namespace

void check_point_masses(Checking& checking) {
  const Model& model = checking.model;
  for (std::size_t i = 0; i < model.point_masses.size(); ++i) {
    const PointMass& point = model.point_masses[i];
    const std::string path = path_of("point_masses", point.source, i);
    checking.enter(point.source);
    const bool weighs = std::any_of(model.loads.begin(), model.loads.end(),
                                    [](const Load& load) { return std::holds_alternative<Gravity>(load.kind); });
    if (!is_dynamic(model) && model.analysis.type != AnalysisType::modal && !weighs && !checking.gaps.steps)
      checking.error(path, "",
                     "has no effect: no step is one in time, the analysis is not modal, and there is no gravity");
    if (model.analysis.revolved()) checking.error(path, "", "is for plane models: bodies of revolution have none");
    checking.positive(path, "mass", point.mass);
    if (point.on)
      check_place_of_mass(checking, path, *point.on);
    else if (!checking.gaps.places && !checking.gaps.bodies)
      checking.error(path, "on", "names no corner");
  }
}

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
