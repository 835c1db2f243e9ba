#include "scabo/analysis/modal/modal_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "scabo/base/components.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/linalg/dense.hpp"
#include "scabo/model/validate.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/natural_modes.hpp"
#include "scabo/system/structure.hpp"
#include "scabo/system/worthwhile_threads.hpp"

namespace scabo::analysis {

namespace {

NaturalMode describe_mode(const system::NaturalModes& modes, Eigen::Index k, const system::Dofs& dofs, std::size_t part,
                          const std::array<Vector, 2>& mass_of_translation,
                          const std::vector<system::BodyLevel>& levels) {
  NaturalMode mode;
  mode.bodies = dofs.bodies_of(part);
  mode.rigid = k < modes.rigid;
  mode.frequency = std::sqrt(modes.eigenvalues[k]) / (2.0 * std::numbers::pi);
  mode.residual = modes.residuals[k];
  const Vector all = modes.shapes.col(k);
  const Eigen::Index inner = system::size_of(levels);
  const Vector phi = all.head(all.size() - inner), w = all.tail(inner);
  for (std::size_t c = 0; c < 2; ++c) {
    const double participation = all.dot(mass_of_translation[c]);
    mode.effective_mass[static_cast<Eigen::Index>(c)] = participation * participation;  // phi' M phi = 1
  }
  // Nodes of a symmetric body move equally far but for rounding, which must not choose among them.
  const Vector distances = phi.reshaped(2, phi.size() / 2).colwise().norm();
  const double largest = distances.maxCoeff();
  const auto is_largest = [&](double distance) { return distance >= (1.0 - 1e-6) * largest; };
  const auto node =
      static_cast<Eigen::Index>(std::find_if(distances.begin(), distances.end(), is_largest) - distances.begin());
  const Vec2 motion = phi.segment<2>(place_of(node));
  const double leading = std::abs(motion.x()) >= (1.0 - 1e-6) * std::abs(motion.y()) ? motion.x() : motion.y();
  const double scale = (leading < 0.0 ? -1.0 : 1.0) / largest;
  for (const int body : mode.bodies) {
    mode.shape.push_back(dofs.of_body(body, scale * phi));
    mode.internal.emplace_back();
    for (const system::BodyLevel& level : levels)
      if (level.body == body) mode.internal.back() = scale * level.own(w);
  }
  mode.modal_mass = scale * scale;
  return mode;
}

/// The parts of a model, and what holds them.
struct Parts {
  system::Dofs dofs;
  std::vector<std::vector<system::Constraint>> constraints;
  system::ModelSprings springs;
};

/// Meshes the model of `on` and solves its super-elements.
Parts discretise(Discretisation& on, const Options& options, const OnStage& stage, ModalTiming& timing) {
  stage("mesh");
  Parts parts;
  {
    const Stopwatch stopwatch(timing.mesh);
    on.mesh = mesh::make_mesh(on.model);
    parts.dofs = system::Dofs(on.model, on.mesh);
    parts.constraints = system::constraints_of(on.model, on.mesh, parts.dofs);
    parts.springs = system::springs_of(on.model, on.mesh, parts.dofs);
  }
  on.threads = system::worthwhile_threads(on.model, on.mesh, options.threads);
  linalg::set_blas_threads(on.threads);
  stage("super-elements");
  const Stopwatch stopwatch(timing.super_elements);
  on.cells = element::solve_cells(on.model, on.mesh, on.threads);
  return parts;
}

/// Adds the modes of an elastic part, and its mass.
void add_modes(const Parts& parts, std::size_t part, system::MassLibrary& masses, const OnStage& stage,
               ModalResult& result) {
  const Discretisation& on = result.structure;
  system::Stiffness K, M;
  std::vector<system::BodyLevel> levels;
  stage("mass of " + parts.dofs.name_of(part, on.model));
  {
    const Stopwatch stopwatch(result.timing.mass);
    K = system::part_stiffness(on.model, on.mesh, on.cells, parts.dofs, part);
    K.springs = parts.springs.of_part[part];
    M = system::part_mass(on.model, on.mesh, on.cells, parts.dofs, part, masses);
    levels = system::levels_of(on.model, on.mesh, on.cells, parts.dofs, part);
  }
  stage("modes of " + parts.dofs.name_of(part, on.model));
  const Stopwatch stopwatch(result.timing.eigenvalues);
  std::array<Vector, 2> translations;
  for (int axis = 0; axis < 2; ++axis) {
    const Vector r = parts.dofs.translation(part, axis);
    Vector& translation = translations[static_cast<std::size_t>(axis)];
    translation.resize(M.size() + system::size_of(levels));
    translation.head(M.size()) = M.times(r);
    for (const system::BodyLevel& level : levels)
      translation.segment(M.size() + level.first, level.size()) = -level.Z() * r(level.dofs);
  }
  for (Eigen::Index i = 0; i < M.size(); i += 2) result.total_mass += translations[0][i];
  const system::NaturalModes modes =
      system::natural_modes(K, M, parts.dofs.nodes(part), parts.constraints[part], on.model.analysis.modes, levels);
  for (Eigen::Index k = 0; k < modes.eigenvalues.size(); ++k)
    result.modes.push_back(describe_mode(modes, k, parts.dofs, part, translations, levels));
}

/// The lowest modes of all parts.
void keep_lowest(int count, ModalResult& result) {
  std::stable_sort(result.modes.begin(), result.modes.end(),
                   [](const NaturalMode& a, const NaturalMode& b) { return a.frequency < b.frequency; });
  if (static_cast<int>(result.modes.size()) > count) result.modes.resize(static_cast<std::size_t>(count));
  if (static_cast<int>(result.modes.size()) < count)
    result.warnings.push_back({WarningKind::few_modes, "",
                               fmt::format("the model has {} modes only, not the {} asked for: use a smaller mesh size",
                                           result.modes.size(), count)});
}

}  // namespace

ModalResult solve_modal(model::Model model, const Options& options) {
  const OnStage stage = [&](const std::string& what) {
    if (options.on_stage) options.on_stage(what);
  };
  model::require_valid(model);
  ModalResult result;
  Discretisation& on = result.structure;
  on.model = std::move(model);
  on.model.contacts.clear();
  result.warnings = on.model.warnings;
  const Parts parts = discretise(on, options, stage, result.timing);
  system::MassLibrary masses = system::masses_of(on.model, on.threads);
  for (std::size_t part = 0; part < parts.dofs.parts(); ++part)
    if (!parts.dofs.is_rigid(part)) add_modes(parts, part, masses, stage, result);
  keep_lowest(on.model.analysis.modes, result);
  for (const NaturalMode& mode : result.modes)
    ensure(mode.residual < 1e-10, "a natural mode does not satisfy its equation");
  return result;
}

FieldState state_of(const ModalResult& result, const NaturalMode& mode) {
  const model::Model& model = result.structure.model;
  FieldState state;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto size = model.bodies[b].rigid ? Eigen::Index{3} : places_of(result.structure.mesh.bodies[b].nodes.size());
    state.displacements.push_back(Vector::Zero(size));
    state.interior.emplace_back();
  }
  const Discretisation& on = result.structure;
  for (std::size_t k = 0; k < mode.bodies.size(); ++k) {
    const auto body = static_cast<std::size_t>(mode.bodies[k]);
    state.displacements[body] = mode.shape[k];
    if (mode.internal[k].size() == 0) continue;
    state.interior[body].resize(1);
    state.interior[body].front().motion =
        system::internal_motion(model, on.mesh, on.cells, mode.bodies[k], mode.internal[k]);
  }
  return state;
}

}  // namespace scabo::analysis
