#include "scabo/analysis/adaptive/adaptive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scabo/analysis/adaptive/error_estimate.hpp"
#include "scabo/analysis/adaptive/frozen_elements.hpp"
#include "scabo/analysis/quasistatic/run.hpp"
#include "scabo/mesh/plane/matched_side.hpp"

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
  for (model::Bar& bar : model.bars)
    for (model::Bar::End& end : bar.between)
      if (end.on) hold(*end.on);
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

std::optional<StaticSolution> solve_wider(const StaticSolution& solution, bool frozen_at_singular_places,
                                          const Options& options, std::string& why) {
  try {
    mesh::Mesh mesh =
        mesh::enriched(solution.model, solution.mesh, frozen_elements(solution, frozen_at_singular_places));
    StaticSolution wider = solve_on_mesh(solution.model, std::move(mesh), options);
    if (wider.outcome == Outcome::solved) return wider;
    why = wider.reason;
  } catch (const InputError& error) {
    why = error.diagnostics().empty() ? error.what() : error.diagnostics().front().message;
  }
  return std::nullopt;
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

StaticSolution without_tolerance(StaticSolution solution, const std::string& why) {
  solution.outcome = Outcome::not_converged;
  solution.reason = fmt::format("mesh.tolerance was not reached: {}", why);
  return solution;
}

/// Eq. (1).
class TolerancesOfBodies : public Aim {
 public:
  TolerancesOfBodies(const model::Model& model, const Options& options) : model_(model), options_(options) {}

  StaticSolution solve(mesh::Mesh mesh, const std::string& name) override {
    wider_.reset();
    StaticSolution solution = solve_on_mesh(model_, std::move(mesh), quiet(options_, name));
    if (solution.outcome == Outcome::solved)
      wider_ = solve_wider(solution, true, quiet(options_, name + ", error"), why_);
    return solution;
  }

  std::optional<Estimate> estimate(StaticSolution& solution, const ModelRefinement&) override {
    if (solution.outcome != Outcome::solved) return std::nullopt;
    if (wider_) {
      estimate_all(solution, *wider_);
      judgement_ = judge(solution);
      return Estimate{judgement_.error, judgement_.sum, judgement_.sum <= aim * aim};
    }
    if (options_.stop && *options_.stop) {
      solution.outcome = Outcome::interrupted;
      solution.reason = "interrupted: the results are those of a mesh whose error is not known";
    } else {
      solution = without_tolerance(std::move(solution), "no error was estimated: on the mesh of higher order, " + why_);
    }
    return std::nullopt;
  }

  MeshErrors errors(const StaticSolution& solution) override { return errors_of(solution, *wider_, judgement_.worst); }

  /// An estimate between the aim and the tolerance is accepted.
  StaticSolution not_reached(StaticSolution solution, const ModelRefinement&, const std::string& why) override {
    if (judgement_.sum <= 1.0) return solution;
    const std::string at =
        fmt::format("the estimated error is {:.3g} with {} degrees of freedom", judgement_.error, solution.mesh.dofs());
    return without_tolerance(std::move(solution), at + ", and " + why);
  }

 private:
  const model::Model& model_;
  const Options& options_;
  // Of the solution that was solved last:
  std::optional<StaticSolution> wider_;
  std::string why_;  // it is not there
  Judgement judgement_;
};

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
    if (const auto wider = solve_wider(solution, true, quiet(options, "error"), why))
      estimate_all(solution, *wider);
    else
      solution.warnings.push_back(
          {WarningKind::no_estimate, "", fmt::format("no error was estimated: on the mesh of higher order, {}", why)});
    warn_of_point_forces(solution);
  }
  replay(solution, options);
  return solution;
}

StaticSolution solve_refined(model::Model model, const Options& options, const RefinementLimits& limits) {
  ModelRefinement refinement(model);
  const mesh::Mesh mesh = refinement.mesh();
  hold_near_places(model, mesh);
  refinement.boundaries.divide_at_corners(mesh, elements_at_forces(model, refinement.boundaries.division()));
  for (const model::Load& load : model.loads)
    if (load.on && is_point(*load.on) && std::holds_alternative<model::Force>(load.kind))
      refinement.cells.divide_at(mesh, *load.on, spread_of_force);
  TolerancesOfBodies tolerances(model, options);
  StaticSolution solution = refine(tolerances, refinement, limits);
  if (solution.outcome != Outcome::interrupted) warn_of_point_forces(solution);
  replay(solution, options);
  return solution;
}

}  // namespace scabo::analysis
