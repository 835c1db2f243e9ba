#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "scabo/analysis/adaptive/error_bars.hpp"
#include "scabo/analysis/adaptive/error_estimate.hpp"
#include "scabo/analysis/adaptive/frozen_elements.hpp"
#include "scabo/analysis/adaptive/goal.hpp"
#include "scabo/analysis/adaptive/refinement.hpp"
#include "scabo/analysis/quasistatic/run.hpp"
#include "scabo/analysis/state/quantities.hpp"
#include "scabo/element/two_orders.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/model/validate.hpp"

namespace scabo::analysis {

namespace {

/// Displacements of every body, of those of the parts.
std::vector<Vector> of_bodies(const Prepared& prepared, const std::vector<Vector>& of_parts) {
  const system::Dofs& dofs = prepared.structure.dofs;
  std::vector<Vector> u;
  for (int b = 0; b < static_cast<int>(prepared.model.bodies.size()); ++b)
    u.push_back(dofs.of_body(b, of_parts[dofs.part_of(b)]));
  return u;
}

/// Sets up the dual solution of the last increment of a run into `dual`.
Options with_dual(const Options& options, const model::Quantity& quantity, const std::string& what,
                  std::vector<Vector>& dual) {
  Options with = quiet(options, what);
  with.on_state = [&quantity, &dual](const Prepared& prepared, const State& state, const StaticSolution& solution) {
    const IncrementResult& at = solution.increments.back();
    if (at.step == static_cast<int>(solution.model.steps.size()) && at.reached == 1.0)
      dual = of_bodies(prepared, dual_displacements(prepared, state, derivative_of(prepared, state, quantity)));
  };
  return with;
}

/// One pass: solutions, primal and dual, on the mesh and on the same elements with one order more.
struct GoalPass {
  StaticSolution solution;
  std::optional<StaticSolution> wider;
  std::vector<Vector> dual, wider_dual;
  std::string why;  ///< why there is no `wider`
};
GoalPass solve_goal_pass(const model::Model& model, mesh::Mesh mesh, const Options& options, const std::string& name) {
  GoalPass pass;
  const model::Quantity& quantity = model.tolerance->of;
  pass.solution = solve_on_mesh(model, std::move(mesh), with_dual(options, quantity, name, pass.dual));
  if (pass.solution.outcome != Outcome::solved) return pass;
  try {
    mesh::Mesh wider = mesh::enriched(model, pass.solution.mesh, frozen_elements(pass.solution, false));
    StaticSolution solution =
        solve_on_mesh(model, std::move(wider), with_dual(options, quantity, name + ", error", pass.wider_dual));
    if (solution.outcome == Outcome::solved)
      pass.wider = std::move(solution);
    else
      pass.why = solution.reason;
  } catch (const InputError& error) {
    pass.why = error.diagnostics().empty() ? error.what() : error.diagnostics().front().message;
  }
  return pass;
}

/// Squared errors of the parts of a body (boundary elements or cells), force times length, of displacements `u` on the
/// mesh and `U` on that of one order more.
std::vector<double> squared_errors_of_parts(const GoalPass& pass, std::size_t b, const Vector& u, const Vector& U,
                                            bool loaded) {
  const StaticSolution& solution = pass.solution;
  const bool in_cells = model::is_divided_inside(solution.model.bodies[b]);
  std::vector<double> squared;
  for (std::size_t c = 0; c < solution.cells[b].size(); ++c) {
    const bool relaxed = !loaded || !element::loads_in(solution.increments.back().fields.interior[b], c).acts();
    const double whole = squared_difference(solution, u, *pass.wider, U, b, c, relaxed);
    if (in_cells) {
      squared.push_back(whole);
      continue;
    }
    const element::SolvedSuperElement &narrow = *solution.cells[b][c], &wide = *pass.wider->cells[b][c];
    const Vector of_narrow = u(element::dofs_of(solution.mesh.bodies[b].cells[c])),
                 of_wide = U(element::dofs_of(pass.wider->mesh.bodies[b].cells[c]));
    const std::vector<double> sectors =
        element::sector_differences({narrow.ring, narrow.solution(), narrow.modes(), of_narrow},
                                    {wide.ring, wide.solution(), wide.modes(), of_wide}, wide.sectors.D);
    const double sum = std::accumulate(sectors.begin(), sectors.end(), 0.0);
    for (const double sector : sectors) squared.push_back(sum > 0.0 ? whole * std::max(sector, 0.0) / sum : 0.0);
  }
  return squared;
}

/// Products of the primal and dual errors of all parts; `sum`: their sum, force times length.
MeshErrors goal_errors(const GoalPass& pass, double& sum) {
  const StaticSolution& solution = pass.solution;
  MeshErrors errors{solution.mesh, {}, frozen_elements(solution, false)};
  errors.shares.resize(solution.model.bodies.size());
  sum = 0.0;
  for (std::size_t b = 0; b < errors.shares.size(); ++b) {
    if (!has_estimate(solution, b)) continue;
    const std::vector<double> primal =
                                  squared_errors_of_parts(pass, b, solution.increments.back().fields.displacements[b],
                                                          pass.wider->increments.back().fields.displacements[b], true),
                              dual = squared_errors_of_parts(pass, b, pass.dual[b], pass.wider_dual[b], false);
    for (std::size_t k = 0; k < primal.size(); ++k) {
      const double product = std::sqrt(primal[k] * dual[k]);
      sum += product;
      if (solution.model.bodies[b].mesh.tolerance) errors.shares[b].push_back(product);
    }
  }
  return errors;
}

/// Bodies that are refined get a tolerance, by which meshers and refinement recognise them. Where sides of contacts
/// cannot be refined alike, they are matched anew in every mesh.
model::Model with_tolerances(model::Model model) {
  for (model::Body& body : model.bodies) {
    if (body.rigid || body.image) continue;
    body.mesh.tolerance = model.tolerance->relative;
    if (body.mesh.kind == model::MeshKind::parts) body.mesh.kind = model::MeshKind::polygons;  // parts are too large
  }
  try {
    check_refinable(model, mesh::make_mesh(model));
  } catch (const InputError&) {
    for (model::Body& body : model.bodies) body.mesh.matched_anew = true;
  }
  return model;
}

/// Under a point force the displacement is infinite, and so is the energy: their values depend on the mesh.
void warn_of_infinite_values(StaticSolution& solution) {
  const model::Model& model = solution.model;
  for (const model::Load& load : model.loads) {
    if (!load.on || !std::holds_alternative<model::Force>(load.kind)) continue;
    const model::Place& place = *load.on;
    if (place.kind != model::Place::Kind::corner && place.kind != model::Place::Kind::near) continue;
    const model::Body& body = model.bodies[static_cast<std::size_t>(place.body)];
    if (body.rigid) continue;
    const Vec2 at = place.kind == model::Place::Kind::near
                        ? place.near
                        : body.outline.corners[static_cast<std::size_t>(place.index)].position;
    for (const model::Quantity* quantity : quantities_of(model)) {
      const bool there = quantity->kind == model::Quantity::Kind::displacement &&
                         (quantity->index < 0 || quantity->index == place.body) &&
                         (quantity->at - at).norm() <= 1e-9 * geometry::outline_size(body.outline);
      if (there || quantity->kind == model::Quantity::Kind::elastic_energy)
        solution.warnings.push_back(
            {WarningKind::infinite_stress, quantity->name,
             fmt::format("'{}' is infinite because of the point force at {}: its value and its error bar depend on the "
                         "mesh; distribute the force over an edge",
                         quantity->name, place.text)});
    }
  }
}

int degrees_of_freedom(const mesh::Mesh& mesh) { return 2 * mesh.nodes(); }

/// Why no further mesh is made; empty if one is.
std::string obstacle_of(const std::vector<double>& sums, const ModelRefinement& next, const RefinementPass& refined,
                        const mesh::Mesh& mesh, const RefinementLimits& limits) {
  const auto back = static_cast<std::size_t>(limits.without_progress);
  if (refined.raised + refined.divided == 0) return "no element can be refined further";
  if (sums.size() > back && sums.back() > 0.8 * sums[sums.size() - 1 - back])
    return "further refinement does not reduce it";
  if (static_cast<int>(sums.size()) >= limits.passes) return fmt::format("{} passes were made", limits.passes);
  int present = 0;
  for (const mesh::BodyMesh& body : mesh.bodies)
    if (body.cells.size() == 1) present = std::max(present, 2 * static_cast<int>(body.nodes.size()));
  if (next.boundaries.largest_body() > std::max(limits.dofs, present))
    return fmt::format("a finer mesh would have {} degrees of freedom in one body, more than {}",
                       next.boundaries.largest_body(), limits.dofs);
  if (next.cells.largest_body() > limits.dofs_of_cells)
    return fmt::format("a finer mesh would have about {} degrees of freedom in one body, more than {}",
                       next.cells.largest_body(), limits.dofs_of_cells);
  return {};
}

StaticSolution without_goal(StaticSolution solution, const model::Model& model, const std::string& why) {
  const QuantityResult* found = nullptr;
  if (!solution.increments.empty() && !solution.increments.back().quantities.empty())
    found = &solution.increments.back().quantities.front();
  solution.outcome = Outcome::not_converged;
  solution.reason = found
                        ? fmt::format(
                              "the tolerance of {} was not reached: its bar is {:.3g} of its value with {} degrees of "
                              "freedom, and {}",
                              model.tolerance->of.name, found->relative(), degrees_of_freedom(solution.mesh), why)
                        : fmt::format("the tolerance of {} was not reached: {}", model.tolerance->of.name, why);
  return solution;
}

/// Solve, estimate, mark and refine until the bar of Model::tolerance is small enough.
StaticSolution refine_for_goal(const model::Model& given, const Options& options, const RefinementLimits& limits) {
  const model::Model model = with_tolerances(given);
  const model::Quantity& quantity = model.tolerance->of;
  ModelRefinement refinement(model);
  std::vector<RefinementPass> passes;
  std::vector<double> sums;
  constexpr int most_without_bars = 2;
  int without_bars = 0;
  std::optional<StaticSolution> last;
  std::unique_ptr<const ModelRefinement> of_last;  // from which its mesh was made
  const auto add_own_bars = [&](StaticSolution& solution, const ModelRefinement& from) {
    if (solution.increments.back().quantities.empty())
      add_bars(solution, model, richer_values({model, &from, nullptr}, solution, options));
  };
  const auto end = [&](StaticSolution solution) {
    solution.model = given;
    solution.passes = passes;
    return solution;
  };
  while (true) {
    GoalPass pass;
    const std::string name = fmt::format("pass {}", passes.size() + 1);
    try {
      pass = solve_goal_pass(model, refinement.mesh(), options, name);
    } catch (const InputError& error) {
      if (!last) throw;
      add_own_bars(*last, *of_last);
      return end(without_goal(std::move(*last), model, error.diagnostics().front().message));
    }
    StaticSolution& solution = pass.solution;
    if (solution.outcome != Outcome::solved) return end(std::move(solution));
    if (!pass.wider) return end(without_goal(std::move(solution), model, "on the mesh of higher order, " + pass.why));
    if (model.output.error)
      for (std::size_t i = 0; i < solution.increments.size(); ++i)
        solution.increments[i].error =
            estimate(solution, solution.increments[i], *pass.wider, pass.wider->increments[i]);

    const double J = value_of(solution, solution.increments.back(), quantity).value_or(0.0),
                 wider = value_of(*pass.wider, pass.wider->increments.back(), quantity).value_or(0.0);
    const double wanted = model.tolerance->relative * std::abs(J), quick = bar_factor * std::abs(wider - J);
    const double rounding = rounding_of(solution, solution.increments.back(), quantity, model.solver.tolerance);
    if (wanted < rounding) {
      passes.push_back({degrees_of_freedom(solution.mesh), J != 0.0 ? quick / std::abs(J) : 0.0, 0, 0});
      add_own_bars(solution, refinement);
      return end(without_goal(
          std::move(solution), model,
          std::max(std::abs(J), std::abs(wider)) <= rounding
              ? "the value is zero but for rounding errors, so that no bar is small relative to it: ask for another "
                "number"
              : fmt::format("the tolerance of the certificate and rounding do not allow a bar below {:.2g}: ask for a "
                            "larger tolerance",
                            rounding)));
    }
    double sum = 0.0;
    MeshErrors errors = goal_errors(pass, sum);
    sums.push_back(sum);
    passes.push_back({degrees_of_freedom(solution.mesh), J != 0.0 ? quick / std::abs(J) : 0.0, 0, 0});
    if (quick <= wanted) {
      add_own_bars(solution, refinement);
      const auto& quantities = solution.increments.back().quantities;
      if (!quantities.empty()) passes.back().error = quantities.front().relative();
      if (!quantities.empty() && quantities.front().reached()) return end(std::move(solution));
      // Where no richer mesh can be made, finer ones rarely help.
      if (quantities.empty() && ++without_bars == most_without_bars)
        return end(without_goal(std::move(solution), model, "no error bar could be computed on two meshes"));
    }

    // Shares sum to about 1 when the bar is reached, which decides how much smaller polygons become.
    for (std::vector<double>& of_body : errors.shares)
      for (double& share : of_body) share *= wanted > 0.0 ? bar_factor / wanted : 1.0;
    of_last = std::make_unique<const ModelRefinement>(refinement);
    const RefinementPass refined = refinement.refine(errors, mark(refinement.parts(errors)));
    passes.back().raised = refined.raised;
    passes.back().divided = refined.divided;
    if (const std::string obstacle = obstacle_of(sums, refinement, refined, solution.mesh, limits); !obstacle.empty()) {
      add_own_bars(solution, *of_last);
      return end(without_goal(std::move(solution), model, obstacle));
    }
    last = std::move(solution);
  }
}

}  // namespace

bool wants_bars(const model::Model& model) { return model.tolerance || !model.output.error_of.empty(); }

void check_bars(const model::Model& model, const mesh::Mesh& mesh) {
  if (wants_bars(model) || !model.output.history.empty()) check_quantities(model, mesh);
}

StaticSolution solve_with_bars(model::Model model, mesh::Mesh mesh, const Options& options,
                               const RefinementLimits& limits) {
  hold_near_places(model, mesh);
  StaticSolution solution;
  if (model.tolerance) {
    solution = refine_for_goal(model, options, limits);
  } else {
    const Options silent = quiet(options, "mesh");
    const bool refined = wants_refinement(model);
    solution = refined              ? solve_refined(model, silent, limits)
               : model.output.error ? solve_with_error(model, std::move(mesh), silent)
                                    : solve_on_mesh(model, std::move(mesh), silent);
    if (solution.outcome == Outcome::solved)
      add_bars(solution, model, richer_values({model, nullptr, refined ? &solution.mesh : nullptr}, solution, options));
  }
  warn_of_infinite_values(solution);
  replay(solution, options);
  return solution;
}

}  // namespace scabo::analysis
