#include "scabo/analysis/adaptive/adaptive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scabo/analysis/adaptive/error_estimate.hpp"
#include "scabo/analysis/adaptive/frozen_elements.hpp"
#include "scabo/analysis/adaptive/refinement.hpp"
#include "scabo/analysis/quasistatic/run.hpp"
#include "scabo/mesh/matched_side.hpp"

namespace scabo::analysis {

namespace {

/// Fraction of the tolerance that the estimate must reach, because it is smaller than the error; 0.77 is the least
/// effectivity measured on meshes produced by refinement.
constexpr double aim = 0.7;

}  // namespace

void hold_near_places(model::Model& model, const mesh::Mesh& mesh) {
  const auto hold = [&](model::Place& place) {
    if (place.kind != model::Place::Kind::near) return;
    const std::vector<int> nodes = mesh::nodes_of(place, mesh).nodes;
    if (!nodes.empty())
      place.near = mesh.bodies[static_cast<std::size_t>(place.body)].nodes[static_cast<std::size_t>(nodes.front())];
  };
  for (model::Support& support : model.supports) hold(support.on);
  for (model::Spring& spring : model.springs) hold(spring.on);
  for (model::Load& load : model.loads)
    if (load.on) hold(*load.on);
}

Options quiet(const Options& options, const std::string& what) {
  Options silent;
  silent.threads = options.threads;
  silent.stop = options.stop;
  silent.on_iteration = options.on_iteration;
  if (options.on_stage)
    silent.on_stage = [&options, what](const std::string& stage) { options.on_stage(what + ": " + stage); };
  return silent;
}

void replay(StaticSolution& solution, const Options& options) {
  if (solution.outcome == Outcome::solved && options.stop && *options.stop) {
    solution.outcome = Outcome::interrupted;
    solution.reason = "interrupted: errors were not computed to the end";
  }
  if (options.on_mesh) options.on_mesh(solution);
  std::vector<IncrementResult> increments = std::move(solution.increments);
  solution.increments.clear();
  for (IncrementResult& increment : increments) {
    solution.increments.push_back(std::move(increment));
    if (options.on_increment) options.on_increment(solution, solution.increments.back());
  }
}

namespace {

/// Elements of refined bodies of one super-element that end at the corner of a point force.
std::vector<mesh::EdgeElement> elements_at_forces(const model::Model& model, const mesh::Division& division) {
  std::vector<mesh::EdgeElement> elements;
  for (const model::Load& load : model.loads) {
    if (!load.on || load.on->kind != model::Place::Kind::corner || !std::holds_alternative<model::Force>(load.kind))
      continue;
    const int b = load.on->body, corner = load.on->index;
    const mesh::BodyDivision& body = division[static_cast<std::size_t>(b)];
    if (!model.bodies[static_cast<std::size_t>(b)].mesh.tolerance || body.empty()) continue;
    const int count = static_cast<int>(body.size()), before = (corner + count - 1) % count;
    elements.push_back({b, corner, 0});
    elements.push_back({b, before, static_cast<int>(body[static_cast<std::size_t>(before)].orders.size()) - 1});
  }
  return elements;
}

/// The analysis on the mesh of higher order; nothing, with the reason in `why`, if it does not have the same
/// increments.
std::optional<StaticSolution> solve_wider(const StaticSolution& solution, const Options& options,
                                          const std::string& what, std::string& why) {
  try {
    mesh::Mesh mesh = mesh::enriched(solution.model, solution.mesh, frozen_elements(solution, true));
    StaticSolution wider = solve_on_mesh(solution.model, std::move(mesh), quiet(options, what));
    if (wider.outcome == Outcome::solved) return wider;
    why = wider.reason;
  } catch (const InputError& error) {
    why = error.diagnostics().empty() ? error.what() : error.diagnostics().front().message;
  }
  return std::nullopt;
}

void warn_of_point_forces(StaticSolution& solution) {
  std::map<std::string, bool> places;  // whether in a body of many cells
  const auto add = [&](const model::Place& place) {
    const auto b = static_cast<std::size_t>(place.body);
    if (has_estimate(solution, b)) places[place.text] = model::is_divided_inside(solution.model.bodies[b]);
  };
  for (const model::Load& load : solution.model.loads)
    if (load.on && is_point(*load.on) && std::holds_alternative<model::Force>(load.kind)) add(*load.on);
  for (const auto& [place, in_cells] : places)
    solution.warnings.push_back(
        {WarningKind::infinite_stress, place,
         fmt::format("stress under the point force at {} is infinite: for the estimated error {}", place,
                     in_cells ? "the adjacent cells are left out"
                              : "the force is distributed over the adjacent elements, which are not refined")});
}

/// Error measures that control refinement.
struct Judgement {
  double sum = 0.0;    ///< eq. (1) of the worst increment
  double error = 0.0;  ///< largest relative error of the whole model
  std::size_t worst = 0;
};
Judgement judge(const StaticSolution& solution) {
  Judgement judgement;
  for (std::size_t i = 0; i < solution.increments.size(); ++i) {
    const auto& error = solution.increments[i].error;
    if (!error) continue;
    double sum = 0.0;
    for (std::size_t b = 0; b < solution.model.bodies.size(); ++b)
      if (const auto& tolerance = solution.model.bodies[b].mesh.tolerance; tolerance && error->bodies[b])
        sum += std::pow(error->bodies[b]->relative / *tolerance, 2);
    if (sum > judgement.sum) judgement.sum = sum, judgement.worst = i;
    judgement.error = std::max(judgement.error, error->relative);
  }
  return judgement;
}

/// Parts that boundary elements, or cells, have in the sum in the worst increment.
MeshErrors errors_of(const StaticSolution& solution, const StaticSolution& wider, std::size_t worst) {
  MeshErrors errors{solution.mesh, {}, frozen_elements(solution, true)};
  errors.shares.resize(solution.model.bodies.size());
  const IncrementResult &increment = solution.increments[worst], &wider_increment = wider.increments[worst];
  for (std::size_t b = 0; b < errors.shares.size(); ++b) {
    const model::Body& body = solution.model.bodies[b];
    if (!body.mesh.tolerance || !has_estimate(solution, b)) continue;
    const std::vector<double> of_parts = model::is_divided_inside(body)
                                             ? cell_errors(solution, increment, wider, wider_increment, b)
                                             : element_errors(solution, increment, wider, wider_increment, b);
    for (const double error : of_parts) errors.shares[b].push_back(std::pow(error / *body.mesh.tolerance, 2));
  }
  return errors;
}

StaticSolution not_reached(StaticSolution solution, const std::string& why) {
  if (solution.outcome != Outcome::solved) return solution;
  solution.outcome = Outcome::not_converged;
  solution.reason = fmt::format("mesh.tolerance was not reached: {}", why);
  return solution;
}

}  // namespace

bool wants_refinement(const model::Model& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(),
                     [](const model::Body& body) { return body.mesh.tolerance.has_value(); });
}

void check_refinable(const model::Model& model, const mesh::Mesh& mesh) {
  if (!wants_refinement(model)) return;
  std::vector<Diagnostic> mistakes;
  const std::vector<mesh::Joint> joints = mesh::joints_of(model);
  const auto is_refined_alike = [&](const mesh::EdgeElement& at) {
    const auto is_side = [&](const model::Place& place) { return place.body == at.body && place.index == at.edge; };
    return std::any_of(joints.begin(), joints.end(), [&](const mesh::Joint& joint) {
      return (is_side(joint.a) || is_side(joint.b)) && mesh::is_refined_alike(model, joint);
    });
  };
  for (const mesh::EdgeElement& at : mesh::paired_elements(model, mesh).alone) {
    const model::Body& body = model.bodies[static_cast<std::size_t>(at.body)];
    if (!is_refined_alike(at) || !mistakes.empty()) continue;
    const std::string edge = body.name + "." + body.outline.edges[static_cast<std::size_t>(at.edge)].names.back();
    mistakes.push_back(
        {body.mesh.source,
         fmt::format(
             "element {} of {} has no matching element on the other side of its contact or tie, so that the two sides "
             "cannot be refined alike: give both bodies the same 'size' and 'order', and let the ends of the "
             "shorter edge fall on ends of elements of the longer one",
             at.element + 1, edge)});
  }
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
}

StaticSolution solve_with_error(model::Model model, mesh::Mesh mesh, const Options& options) {
  hold_near_places(model, mesh);
  StaticSolution solution = solve_on_mesh(std::move(model), std::move(mesh), quiet(options, "mesh"));
  std::string why;
  if (solution.outcome == Outcome::solved) {
    if (const auto wider = solve_wider(solution, options, "error", why))
      estimate_all(solution, *wider);
    else
      solution.warnings.push_back(
          {WarningKind::no_estimate, "", fmt::format("no error was estimated: on the mesh of higher order, {}", why)});
    warn_of_point_forces(solution);
  }
  replay(solution, options);
  return solution;
}

namespace {

/// Solution and estimate of one pass; without `wider` the loop ends with `solution`.
struct SolvedPass {
  StaticSolution solution;
  std::optional<StaticSolution> wider;
};

/// Solve and estimate.
SolvedPass solve_pass(const model::Model& model, mesh::Mesh mesh, const Options& options, const std::string& name) {
  SolvedPass pass{solve_on_mesh(model, std::move(mesh), quiet(options, name)), {}};
  if (pass.solution.outcome != Outcome::solved) return pass;
  std::string why;
  pass.wider = solve_wider(pass.solution, options, name + ", error", why);
  if (pass.wider) {
    estimate_all(pass.solution, *pass.wider);
  } else if (options.stop && *options.stop) {
    pass.solution.outcome = Outcome::interrupted;
    pass.solution.reason = "interrupted: the results are those of a mesh whose error is not known";
  } else {
    pass.solution =
        not_reached(std::move(pass.solution), "no error was estimated: on the mesh of higher order, " + why);
  }
  return pass;
}

/// Why no further pass is made after those of which `sums` are those of eq. (1); empty if one is.
std::string obstacle_after(const std::vector<double>& sums, const RefinementLimits& limits, const std::string& at) {
  const auto back = static_cast<std::size_t>(limits.without_progress);
  if (sums.size() > back && sums.back() > 0.8 * sums[sums.size() - 1 - back])
    return at + ", and further refinement does not reduce it";
  if (static_cast<int>(sums.size()) == limits.passes) return fmt::format("after {} passes {}", limits.passes, at);
  return {};
}

/// Why the next mesh is not made; empty if it is.
std::string too_fine(const ModelRefinement& next, const mesh::Mesh& mesh, const RefinementLimits& limits,
                     const std::string& at) {
  int present = 0;
  for (const mesh::BodyMesh& body : mesh.bodies)
    if (body.cells.size() == 1)
      present = std::max(present, static_cast<int>(mesh.components().count(body.nodes.size())));
  const int dofs = next.boundaries.largest_body(), of_cells = next.cells.largest_body();
  const auto text = [&](const char* about, int would, int most) {
    return fmt::format("{}; a finer mesh would have {}{} in one body, more than {}", at, about, would, most);
  };
  if (dofs > std::max(limits.dofs, present)) return text("", dofs, limits.dofs);
  if (of_cells > limits.dofs_of_cells) return text("about ", of_cells, limits.dofs_of_cells);
  return {};
}

}  // namespace

StaticSolution solve_refined(model::Model model, const Options& options, const RefinementLimits& limits) {
  ModelRefinement refinement(model);
  mesh::Mesh mesh = refinement.mesh();
  hold_near_places(model, mesh);
  refinement.boundaries.divide_at_corners(mesh, elements_at_forces(model, refinement.boundaries.division()));
  for (const model::Load& load : model.loads)
    if (load.on && is_point(*load.on) && std::holds_alternative<model::Force>(load.kind))
      refinement.cells.divide_at(mesh, *load.on, spread_of_force);
  mesh = refinement.mesh();
  std::vector<RefinementPass> passes;
  std::vector<double> sums;
  const auto end = [&](StaticSolution solution) {
    solution.passes = passes;
    if (solution.outcome != Outcome::interrupted) warn_of_point_forces(solution);
    replay(solution, options);
    return solution;
  };
  std::optional<StaticSolution> last;
  while (true) {
    SolvedPass pass;
    try {
      if (last) mesh = refinement.mesh();
      pass = solve_pass(model, std::move(mesh), options, fmt::format("pass {}", passes.size() + 1));
    } catch (const InputError& error) {
      if (!last) throw;
      return end(not_reached(std::move(*last), error.diagnostics().front().message));
    }
    auto& [solution, wider] = pass;
    if (!wider && last && solution.outcome == Outcome::interrupted && solution.increments.empty()) {
      last->outcome = Outcome::interrupted;
      last->reason = "interrupted: the tolerance is not reached";
      return end(std::move(*last));
    }
    if (!wider) return end(std::move(solution));
    const Judgement judgement = judge(solution);
    passes.push_back({solution.mesh.dofs(), judgement.error, 0, 0});
    sums.push_back(judgement.sum);
    if (judgement.sum <= aim * aim) return end(std::move(solution));

    const std::string at =
        fmt::format("the estimated error is {:.3g} with {} degrees of freedom", judgement.error, passes.back().dofs);
    std::string obstacle = obstacle_after(sums, limits, at);
    if (obstacle.empty()) {
      const MeshErrors errors = errors_of(solution, *wider, judgement.worst);
      const RefinementPass refined = refinement.refine(errors, mark(refinement.parts(errors)));
      passes.back().raised = refined.raised;
      passes.back().divided = refined.divided;
      obstacle = refined.raised + refined.divided == 0 ? at + ", and no element can be refined further"
                                                       : too_fine(refinement, solution.mesh, limits, at);
    }
    // Where refinement cannot continue, an estimate between the aim and the tolerance is accepted.
    if (!obstacle.empty())
      return end(judgement.sum <= 1.0 ? std::move(solution) : not_reached(std::move(solution), obstacle));
    last = std::move(solution);
  }
}

}  // namespace scabo::analysis
