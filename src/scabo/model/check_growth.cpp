// Validation of steps in which cracks grow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

std::string path_of_step(const Model& model, std::size_t index) {
  return path_of("steps", model.steps[index].source, index) + ".growth";
}

double length_of(const std::vector<Vec2>& path) {
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) length += (path[k + 1] - path[k]).norm();
  return length;
}

/// Bodies with cracks that grow.
std::vector<char> bodies_of(const Model& model, const GrowthStep& growth) {
  std::vector<char> bodies(model.bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    bodies[b] = !model.bodies[b].cracks.empty() &&
                (growth.cracks.empty() || std::any_of(growth.cracks.begin(), growth.cracks.end(), [&](const auto& one) {
                   return one.body == static_cast<int>(b);
                 }));
  return bodies;
}

bool check_names(Checking& checking, const std::string& path, const GrowthStep& growth) {
  const Model& model = checking.model;
  for (const GrowingCrack& crack : growth.cracks)
    if (!checking.is_body(crack.body) || crack.crack < 0 ||
        crack.crack >= static_cast<int>(checking.body(crack.body).cracks.size()))
      return checking.error(path, "cracks", "refers to a crack that does not exist"), false;
  if (growth.loads.size() != model.loads.size() || growth.supports.size() != model.supports.size())
    return checking.error(path, "scale", "must say of every load and support whether it is scaled"), false;
  const std::vector<char> bodies = bodies_of(model, growth);
  if (std::find(bodies.begin(), bodies.end(), 1) == bodies.end() && !checking.gaps.bodies)
    return checking.error(path, "", "the model has no crack that could grow: give a body 'cracks' with a path"), false;
  return true;
}

void check_bodies_of(Checking& checking, const GrowthStep& growth) {
  const Model& model = checking.model;
  const std::vector<char> bodies = bodies_of(model, growth);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]) continue;
    const Body& body = model.bodies[b];
    const std::string path = path_of("bodies", body.name, b);
    checking.enter(body.source);
    if (body.imported || body.image || (body.mesh.kind != MeshKind::polygons && body.mesh.kind != MeshKind::quadtree) ||
        !has_divided_faces(body))
      checking.error(path, "mesh",
                     "cracks grow between the cells of kind: polygons or kind: quadtree, with a 'path', in bodies with "
                     "a shape of their own");
    std::vector<int> materials{body.material};
    for (const Region& region : body.regions) materials.push_back(region.material);
    for (const int material : materials)
      if (material >= 0 && material < static_cast<int>(model.materials.size()) &&
          model.materials[static_cast<std::size_t>(material)].law)
        checking.error(path, "material",
                       fmt::format("'{}' is not isotropic, and where cracks grow then is not available in this version",
                                   model.materials[static_cast<std::size_t>(material)].name));
  }
}

/// The factors that lambda multiplies, and those along curves.
void check_scaled(Checking& checking, const std::string& path, const Step& step) {
  const GrowthStep& growth = *step.growth;
  const auto any = [](const std::vector<char>& scaled, const std::vector<double>& factors) {
    for (std::size_t i = 0; i < scaled.size(); ++i)
      if (scaled[i] && factors[i] != 0.0) return true;
    return false;
  };
  if (!any(growth.loads, step.load_factors) && !any(growth.supports, step.support_factors))
    checking.error(path, "scale",
                   "names no load or support with a factor in this step: name in the 'loads' of the step what makes "
                   "the crack grow");
  if (!step.load_curves.empty() || !step.support_curves.empty())
    checking.error(path, "",
                   "a factor follows a curve, which it cannot where the load follows from the growth: give a number");
}

/// Cycles of load.
void check_cycles(Checking& checking, const std::string& path, const Step& step) {
  const GrowthStep& growth = *step.growth;
  const LoadCycles& cycles = *growth.cycles;
  checking.positive(path, "C", cycles.C);
  checking.positive(path, "m", cycles.m);
  const auto of_law = [&](const char* key, const std::optional<double>& constant, bool wanted, const char* law) {
    if (wanted && !constant) checking.error(path, "", fmt::format("law: {} needs '{}'", law, key));
    if (constant && !wanted) checking.error(path, key, fmt::format("is a constant of law: {}: leave it out", law));
    return constant.has_value() && wanted;
  };
  if (of_law("gamma", cycles.gamma, cycles.law == FatigueLaw::walker, "walker"))
    checking.within(path, "gamma", *cycles.gamma, "0", "1");
  if (of_law("K_c", cycles.K_c, cycles.law == FatigueLaw::forman, "forman"))
    checking.positive(path, "K_c", *cycles.K_c);
  if (growth.G_c)
    checking.error(path, "toughness.G_c", "is not compared with cycles of load: give K_Ic, or leave 'toughness' out");
  if (growth.load_factor)
    checking.error(path, "until.load_factor", "has no meaning under cycles of load: give 'length' or 'steps'");
  for (const std::size_t end : {0u, 1u})
    if (cycles.loads[end].size() != checking.model.loads.size() ||
        cycles.supports[end].size() != checking.model.supports.size())
      return checking.error(path, "between", "must have a factor for every load and support");
  if (cycles.loads[0] == cycles.loads[1] && cycles.supports[0] == cycles.supports[1])
    checking.error(path, "between", "has the same factors twice: give the lowest and the highest load of a cycle");
  if (!step.load_curves.empty() || !step.support_curves.empty())
    checking.error(path, "", "a factor follows a curve, which it cannot under cycles of load: give a number");
}

/// A crack from one end to the other, and one of its ends.
struct CrackEnd {
  const Crack* crack = nullptr;
  bool last = false;
  const Vec2& at() const { return last ? crack->path.back() : crack->path.front(); }
  std::string name(const Body& body) const { return body.name + "." + crack->name + (last ? ".end" : ".start"); }
};

/// Ends of two cracks in one place, of which one is to grow.
void check_apart(Checking& checking, const std::string& path, const GrowthStep& growth) {
  for (std::size_t b = 0; b < checking.model.bodies.size(); ++b) {
    const Body& body = checking.model.bodies[b];
    if (!bodies_of(checking.model, growth)[b] || !checking.sound_shape(static_cast<int>(b))) continue;
    const double tolerance = 3e-9 * geometry::outline_size(body.outline);
    const auto grows = [&](std::size_t crack, bool last) {
      return growth.cracks.empty() || std::any_of(growth.cracks.begin(), growth.cracks.end(), [&](const auto& one) {
               return one.body == static_cast<int>(b) && one.crack == static_cast<int>(crack) &&
                      (last ? one.at_end : one.at_start);
             });
    };
    for (std::size_t c = 0; c < body.cracks.size(); ++c)
      for (std::size_t d = c + 1; d < body.cracks.size(); ++d)
        for (const bool last : {false, true})
          for (const bool other_last : {false, true}) {
            if (body.cracks[c].path.empty() || body.cracks[d].path.empty()) continue;
            const CrackEnd end{&body.cracks[c], last}, other{&body.cracks[d], other_last};
            if ((end.at() - other.at()).norm() > tolerance || !(grows(c, last) || grows(d, other_last))) continue;
            return checking.error(path, "",
                                  fmt::format("the tips '{}' and '{}' meet at {}, where neither can grow: make them "
                                              "one crack, or name in 'cracks' the ends that may grow",
                                              end.name(body), other.name(body), point_text(end.at())));
          }
  }
}

/// Positive, and known of all materials of the bodies in which cracks grow.
void check_toughness(Checking& checking, const std::string& path, const std::string& key, const GrowthStep& growth,
                     const Toughness& toughness) {
  const Model& model = checking.model;
  if (toughness.of_all) {
    checking.positive(path, key, *toughness.of_all);
    return;
  }
  if (toughness.of_material.size() != model.materials.size())
    return checking.error(path, key, "must be a number, or one for each material, as in {stone: 1e6, core: 2e6}");
  for (std::size_t m = 0; m < model.materials.size(); ++m)
    if (const auto& one = toughness.of_material[m]) checking.positive(path, key + "." + model.materials[m].name, *one);
  const std::vector<char> bodies = bodies_of(model, growth);
  const auto need = [&](int material, const std::string& of) {
    if (material < 0 || material >= static_cast<int>(model.materials.size()) ||
        toughness.of_material[static_cast<std::size_t>(material)])
      return;
    checking.error(path, key,
                   fmt::format("has no number for '{}', the material of {}, where cracks may grow",
                               model.materials[static_cast<std::size_t>(material)].name, of));
  };
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]) continue;
    need(model.bodies[b].material, fmt::format("body '{}'", model.bodies[b].name));
    for (const Region& region : model.bodies[b].regions)
      need(region.material, fmt::format("region '{}' of body '{}'", region.name, model.bodies[b].name));
  }
}

/// The distance from the tip at which T counts.
void check_distance(Checking& checking, const std::string& path, const GrowthStep& growth) {
  if (!checking.positive(path, "distance", *growth.distance)) return;
  if (growth.criterion != GrowthCriterion::hoop_stress)
    return checking.error(
        path, "distance",
        "is where criterion: hoop_stress takes the stress, and other criteria have none: leave it out");
  for (const Contact& contact : checking.model.contacts)
    if (contact.a.kind == Place::Kind::face)
      return checking.error(path, "distance",
                            "needs the T-stress, which cracks in contact do not have: leave it or the contact of the "
                            "faces out");
}

/// The place that a tip is to reach: within half a step of a body.
void check_place(Checking& checking, const std::string& path, const GrowthStep& growth) {
  if (!checking.vector(path, "until.tip", *growth.tip)) return;
  const std::vector<char> bodies = bodies_of(checking.model, growth);
  std::string names;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]) continue;
    const Body& body = checking.model.bodies[b];
    if (!checking.sound_shape(static_cast<int>(b)) || geometry::encloses(body.outline, *growth.tip) ||
        geometry::distance_to(body.outline, *growth.tip) <= 0.5 * growth.step)
      return;
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", body.name);
  }
  if (!names.empty())
    checking.error(path, "until.tip",
                   fmt::format("{} lies outside of {}, where cracks grow", point_text(*growth.tip), names));
}

/// Limits of growth, and what is left until them.
void check_until(Checking& checking, const std::string& path, const GrowthStep& growth) {
  if (growth.tip) check_place(checking, path, growth);
  if (growth.load_factor) checking.positive(path, "until.load_factor", *growth.load_factor);
  if (growth.steps) checking.whole(path, "until.steps", *growth.steps, limits::growth_steps);
  if (!growth.length || !checking.positive(path, "until.length", *growth.length)) return;
  for (std::size_t b = 0; b < checking.model.bodies.size(); ++b)
    for (std::size_t c = 0; c < checking.model.bodies[b].cracks.size(); ++c) {
      const Crack& crack = checking.model.bodies[b].cracks[c];
      const double left = *growth.length - length_of(crack.path);
      const bool grows = growth.cracks.empty() ||
                         std::any_of(growth.cracks.begin(), growth.cracks.end(), [&](const GrowingCrack& one) {
                           return one.body == static_cast<int>(b) && one.crack == static_cast<int>(c);
                         });
      if (!grows || !(growth.step > left * (1.0 + 1e-9))) continue;
      if (left > 0.0)
        checking.error(
            path, "step",
            fmt::format("is longer than what is left until the length {} of crack '{}', which is {:.6g} long",
                        number_text(*growth.length), crack.name, length_of(crack.path)));
      else
        checking.error(path, "until.length",
                       fmt::format("is no more than crack '{}' has at the beginning, {:.6g}: give a larger one",
                                   crack.name, length_of(crack.path)));
      return;
    }
}

/// Cells at tips are half a step, and a step ends within its body.
void check_step(Checking& checking, const std::string& path, const GrowthStep& growth) {
  constexpr double shortest = 1e-6;  // of the body
  for (std::size_t b = 0; b < checking.model.bodies.size(); ++b) {
    const Body& body = checking.model.bodies[b];
    if (body.cracks.empty() || !checking.sound_shape(static_cast<int>(b))) continue;
    const double size = geometry::outline_size(body.outline);
    if (growth.step >= shortest * size && growth.step <= size) continue;
    const std::string of_body = fmt::format("the size of body '{}', which is {:.3g}", body.name, size);
    checking.error(path, "step",
                   growth.step > size ? "is longer than " + of_body
                                      : fmt::format("must be at least {:.0e} of {}", shortest, of_body));
    return;
  }
}

/// What a model in which cracks grow cannot have.
void check_beside_growth(Checking& checking) {
  const Model& model = checking.model;
  const auto refuse = [&](const Source& at, const std::string& path, std::string message) {
    checking.enter(at);
    checking.error(path, "", std::move(message));
  };
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const std::string path = path_of_joint("contacts", contact.source, contact.name, c);
    const bool grows = contact.a.kind == Place::Kind::face;
    if (contact.large_slip)
      refuse(contact.source, path, "has slip: large, which is not available where cracks grow: give slip: small");
    else if (grows && (contact.bond || contact.gap != 0.0 || !contact.friction_along.empty()))
      refuse(contact.source, path,
             fmt::format("has {}, which new faces of a crack that grows do not have: leave it out",
                         contact.bond         ? "a bond"
                         : contact.gap != 0.0 ? "a gap"
                                              : "friction along its length"));
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const std::string path = path_of("bodies", model.bodies[b].name, b);
    if (model.bodies[b].is_staged())
      refuse(model.bodies[b].source, path, "comes or goes in a step, which is not available where cracks grow");
    if (model.bodies[b].mesh.tolerance)
      refuse(model.bodies[b].source, path + ".mesh",
             "has a tolerance, for which growth is not repeated on finer meshes: give 'size', and halve it to compare");
  }
  if (model.restart) refuse(model.restart->source, "restart", "is not available where cracks grow");
  if (model.tolerance || model.output.error || !model.output.error_of.empty())
    refuse(
        {}, model.tolerance ? "tolerance" : "output",
        "an error bar needs finer meshes, on which growth is not repeated: leave it out, and halve 'size' and 'step' "
        "to compare");
  if (model.output.discrete_problems)
    refuse({}, "output.discrete_problems", "is not available where cracks grow: leave it out");
  if (model.solver.uniqueness) refuse({}, "solver.uniqueness", "is not available where cracks grow: leave it out");
}

}  // namespace

void check_growth_steps(Checking& checking) {
  const Model& model = checking.model;
  if (model.analysis.type == AnalysisType::modal || checking.gaps.steps) return;
  for (std::size_t i = 0; i < model.steps.size(); ++i) {
    const Step& step = model.steps[i];
    if (!step.growth) continue;
    const GrowthStep& growth = *step.growth;
    const std::string path = path_of_step(model, i);
    checking.enter(step.source);
    if (i + 1 != model.steps.size())
      checking.error(path, "", "is followed by another step: cracks grow in the last one");
    if (step.dynamic || is_dynamic(model))
      checking.error(path, "", "is quasi-static and does not go with steps in time");
    if (step.automatic || step.increments != 1)
      checking.error(path, "", "has as many increments as it takes: leave 'increments' out");
    if (growth.cycles ? growth.K_Ic && growth.G_c : growth.K_Ic.has_value() == growth.G_c.has_value())
      checking.error(path, "toughness", "must be one of K_Ic and G_c, as in {K_Ic: 1e6}");
    if (growth.distance) check_distance(checking, path, growth);
    if (growth.K_Ic) check_toughness(checking, path, "toughness.K_Ic", growth, *growth.K_Ic);
    check_apart(checking, path, growth);
    if (growth.G_c) check_toughness(checking, path, "toughness.G_c", growth, *growth.G_c);
    if (checking.positive(path, "step", growth.step)) check_step(checking, path, growth);
    if (!check_names(checking, path, growth)) continue;
    if (growth.cycles)
      check_cycles(checking, path, step);
    else if (!checking.gaps.conditions)
      check_scaled(checking, path, step);
    check_until(checking, path, growth);
    check_bodies_of(checking, growth);
    check_beside_growth(checking);
  }
}

}  // namespace scabo::model
