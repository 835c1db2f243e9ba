#include "scabo/analysis/goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "scabo/analysis/error_estimate.hpp"
#include "scabo/analysis/frozen_elements.hpp"
#include "scabo/analysis/quantities.hpp"
#include "scabo/analysis/refinement.hpp"
#include "scabo/element/two_orders.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/model/validate.hpp"

namespace scabo::analysis {

namespace {

/// Eq. (1): the bar over the difference from the richest mesh.
constexpr double bar_factor = 2.0;
/// The last two meshes agree if they differ by at most this part of the difference from the last.
constexpr double agreement = 0.5;
/// Degrees of freedom of a richer mesh, at most: of a body that is one super-element, whose time grows with their cube,
/// and of all bodies.
constexpr double most_of_boundary = 4000, most_of_cells = 1e6;

/// How a richer mesh differs from that of the results.
struct Richer {
  double size = 1.0;  ///< of elements and cells, relative
  int raised = 0;     ///< orders
};
constexpr Richer same_elements{1.0, 1}, halved{0.5, 1}, halved_and_raised{0.5, 2}, raised_twice{1.0, 2},
    raised_thrice{1.0, 3};

std::vector<const model::Quantity*> quantities_of(const model::Model& model) {
  std::vector<const model::Quantity*> quantities;
  if (model.tolerance) quantities.push_back(&model.tolerance->of);
  for (const model::Quantity& quantity : model.output.error_of)
    if (!model.tolerance || quantity.name != model.tolerance->of.name) quantities.push_back(&quantity);
  return quantities;
}

constexpr int highest_order = 16;

/// Order of the sides of a body; mesh.order is the least one of a mesh from a file.
int order_of(const model::Body& body) {
  const bool quadratic =
      body.imported && std::any_of(body.imported->cells.begin(), body.imported->cells.end(),
                                   [](const files::ImportedCell& cell) { return files::is_quadratic(cell.kind); });
  return std::max(body.mesh.order, quadratic ? 2 : 1);
}

/// Whether any body is made of finite elements. They have no order that could be raised, but become super-elements of
/// the next order, and the other bodies with them.
bool has_finite_elements(const model::Model& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(),
                     [](const model::Body& body) { return !body.rigid && body.mesh.kind == model::MeshKind::fem; });
}

/// The model whose meshes are richer than those of `model`.
model::Model enriched_model(model::Model model, const Richer& richer) {
  for (model::Body& body : model.bodies) {
    if (body.rigid) continue;
    model::MeshOptions& mesh = body.mesh;
    mesh.size *= richer.size;
    mesh.min_size *= richer.size;
    for (model::LocalSize& local : mesh.refine) local.size *= richer.size;
    if (mesh.kind != model::MeshKind::fem) mesh.order = std::min(order_of(body) + richer.raised, highest_order);
  }
  return model;
}

/// The division with every element divided and raised.
mesh::Division enriched_division(mesh::Division division, const Richer& richer) {
  const int parts = static_cast<int>(std::lround(1.0 / richer.size));
  for (mesh::BodyDivision& body : division)
    for (mesh::EdgeDivision& edge : body) {
      if (edge.orders.empty()) continue;  // a side face
      mesh::EdgeDivision fine;
      fine.breaks = {edge.breaks.front()};
      for (std::size_t k = 0; k < edge.orders.size(); ++k)
        for (int part = 1; part <= parts; ++part) {
          fine.breaks.push_back(part == parts
                                    ? edge.breaks[k + 1]
                                    : std::lerp(edge.breaks[k], edge.breaks[k + 1], static_cast<double>(part) / parts));
          fine.orders.push_back(std::min(edge.orders[k] + richer.raised, highest_order));
        }
      edge = std::move(fine);
    }
  return division;
}

/// Where the mesh of the results comes from.
struct MeshSource {
  const model::Model& model;
  const ModelRefinement* refinement = nullptr;  ///< its division and sizes
  const mesh::Mesh* mesh = nullptr;             ///< a mesh refined for tolerances of bodies; only its orders are raised
};

mesh::Mesh richer_mesh(const MeshSource& source, const Richer& richer) {
  const bool raised_after = source.mesh || has_finite_elements(source.model);
  const Richer before{richer.size, raised_after ? 0 : richer.raised};
  const model::Model model = enriched_model(source.model, before);
  mesh::Mesh mesh = source.mesh ? *source.mesh
                    : source.refinement
                        ? mesh::make_mesh(model, enriched_division(source.refinement->boundaries.division(), before),
                                          source.refinement->cells.scaled_sizes(richer.size))
                        : mesh::make_mesh(model);
  for (int k = 0; raised_after && k < richer.raised; ++k) mesh = raised(model, mesh);
  return mesh;
}

/// Whether the richer mesh would take too long, judged by the present one.
bool is_too_large(const mesh::Mesh& mesh, const model::Model& model, const Richer& richer) {
  double all = 0.0;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    const mesh::BodyMesh& body = mesh.bodies[b];
    const model::MeshOptions& options = model.bodies[b].mesh;
    const bool one = body.cells.size() == 1;
    const double factor = richer.size, order = std::max(options.order, 1), raised = (order + richer.raised) / order;
    const double dofs = 2.0 * static_cast<double>(body.nodes.size()) * raised / (one ? factor : factor * factor);
    if (one && dofs > most_of_boundary) return true;
    all += dofs;
  }
  return all > most_of_cells;
}

/// Values of all quantities, [increment][quantity]; not a number where there is none.
using Values = std::vector<std::vector<double>>;
Values values_of(const StaticSolution& solution, const std::vector<const model::Quantity*>& quantities) {
  Values values;
  for (const IncrementResult& increment : solution.increments) {
    auto& row = values.emplace_back();
    for (const model::Quantity* quantity : quantities)
      row.push_back((increment.converged ? value_of(solution, increment, *quantity) : std::nullopt)
                        .value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return values;
}

/// The solution on a richer mesh; nothing, with the reason in `why`, if there is none.
std::optional<StaticSolution> solve_richer(const MeshSource& source, const Richer& richer, const Options& options,
                                           const std::string& what, std::string& why) {
  try {
    StaticSolution solution =
        solve_on_mesh(enriched_model(source.model, richer), richer_mesh(source, richer), quiet(options, what));
    if (solution.outcome == Outcome::solved) return solution;
    why = solution.reason;
  } catch (const InputError& error) {
    why = error.diagnostics().empty() ? error.what() : error.diagnostics().front().message;
  }
  return std::nullopt;
}

/// Values on richer meshes, the richest one last.
struct RicherValues {
  std::vector<Values> values;
  std::string why;  ///< if there are fewer than two of them
};

bool agree(const Values& J, const RicherValues& richer) {
  const Values &last = richer.values.back(), &before = richer.values[richer.values.size() - 2];
  for (std::size_t i = 0; i < J.size(); ++i)
    for (std::size_t k = 0; k < J[i].size(); ++k)
      if (std::abs(last[i][k] - before[i][k]) > agreement * std::abs(last[i][k] - J[i][k])) return false;
  return true;
}

RicherValues richer_values(const MeshSource& source, const StaticSolution& solution, const Options& options) {
  const auto quantities = quantities_of(source.model);
  const Values J = values_of(solution, quantities);
  // Cells of files and images have no size that could be halved everywhere.
  const bool given = std::any_of(source.model.bodies.begin(), source.model.bodies.end(),
                                 [](const model::Body& body) { return body.imported || body.image; });
  const bool divided = !source.mesh && !given && !is_too_large(solution.mesh, source.model, halved);
  RicherValues richer;
  for (const Richer& next :
       {same_elements, divided ? halved : raised_twice, divided ? halved_and_raised : raised_thrice}) {
    const std::size_t level = richer.values.size();
    if (level == 2 && (agree(J, richer) || is_too_large(solution.mesh, source.model, next))) break;
    const auto solved = solve_richer(source, next, options, fmt::format("error bar, mesh {}", level + 1), richer.why);
    if (!solved || solved->increments.size() != solution.increments.size()) break;
    richer.values.push_back(values_of(*solved, quantities));
  }
  return richer;
}

/// Eq. (1).
double bar_of(double J, const std::vector<double>& richer) {
  const double last = richer.back(), difference = std::abs(last - J);
  const double change = richer.size() > 1 ? std::abs(last - richer[richer.size() - 2]) : 0.0;
  return std::max(bar_factor * difference, change > difference ? change : 0.0);
}

void add_bars(StaticSolution& solution, const model::Model& model, const RicherValues& richer) {
  if (richer.values.empty()) {
    solution.warnings.push_back({WarningKind::no_estimate, "bars",
                                 fmt::format("no error bars were computed: on a finer mesh, {}", richer.why)});
    return;
  }
  if (richer.values.size() < 2)
    solution.warnings.push_back(
        {WarningKind::no_estimate, "bars",
         fmt::format("error bars come from one finer mesh only, and may be too small: on the next, {}", richer.why)});
  const auto quantities = quantities_of(model);
  const Values J = values_of(solution, quantities);
  for (std::size_t i = 0; i < J.size(); ++i)
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      if (!solution.increments[i].converged) continue;
      std::vector<double> finer;
      for (const Values& values : richer.values) finer.push_back(values[i][k]);
      QuantityResult result{quantities[k]->name, J[i][k], bar_of(J[i][k], finer), finer.back(), {}};
      // What the certificate of contact allows, and rounding, are not discretisation errors, but errors.
      result.bar =
          std::max(result.bar, rounding_of(solution, solution.increments[i], *quantities[k], model.solver.tolerance));
      if (model.tolerance && k == 0) result.wanted = model.tolerance->relative;
      solution.increments[i].quantities.push_back(std::move(result));
    }
}

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
      dual =
          of_bodies(prepared, dual_displacements(prepared, state, derivative_of(prepared, state, solution, quantity)));
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

double QuantityResult::relative() const {
  if (bar == 0.0) return 0.0;
  return value == 0.0 ? std::numeric_limits<double>::infinity() : bar / std::abs(value);
}

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
