#include "scabo/analysis/adaptive/goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scabo/analysis/adaptive/error_bars.hpp"
#include "scabo/analysis/adaptive/error_estimate.hpp"
#include "scabo/analysis/adaptive/frozen_elements.hpp"
#include "scabo/analysis/quasistatic/run.hpp"
#include "scabo/analysis/state/quantities.hpp"
#include "scabo/element/plane/two_orders.hpp"
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

/// Solutions, primal and dual, on the mesh and on the same elements with one order more.
struct GoalPass {
  const StaticSolution& solution;
  const StaticSolution& wider;
  const std::vector<Vector>&dual, &wider_dual;
};

/// Squared errors of the parts of a body (boundary elements or cells), force times length, of displacements `u` on the
/// mesh and `U` on that of one order more.
std::vector<double> squared_errors_of_parts(const GoalPass& pass, std::size_t b, const Vector& u, const Vector& U,
                                            bool loaded) {
  const StaticSolution& solution = pass.solution;
  const bool in_cells = model::is_divided_inside(solution.model.bodies[b]);
  std::vector<double> squared;
  for (std::size_t c = 0; c < solution.cells[b].size(); ++c) {
    const bool relaxed = !loaded || !element::loads_in(solution.increments.back().fields.interior[b], c).acts();
    const double whole = squared_difference(solution, u, pass.wider, U, b, c, relaxed);
    if (in_cells) {
      squared.push_back(whole);
      continue;
    }
    const element::SolvedSuperElement &narrow = *solution.cells[b][c], &wide = *pass.wider.cells[b][c];
    const Vector of_narrow = u(element::dofs_of(solution.mesh.bodies[b].cells[c])),
                 of_wide = U(element::dofs_of(pass.wider.mesh.bodies[b].cells[c]));
    const std::vector<double> sectors =
        element::sector_differences({narrow.ring, narrow.solution(), narrow.modes(), of_narrow},
                                    {wide.ring, wide.solution(), wide.modes(), of_wide}, wide.sectors.D);
    const double sum = std::accumulate(sectors.begin(), sectors.end(), 0.0);
    for (const double sector : sectors) squared.push_back(sum > 0.0 ? whole * std::max(sector, 0.0) / sum : 0.0);
  }
  return squared;
}

/// Products of the primal and dual errors of all parts, force times length.
struct Products {
  std::vector<std::vector<double>> of_parts;  ///< MeshErrors::shares
  double sum = 0.0;                           ///< also of bodies that are not refined
};
Products products_of(const GoalPass& pass) {
  const StaticSolution& solution = pass.solution;
  Products products;
  products.of_parts.resize(solution.model.bodies.size());
  for (std::size_t b = 0; b < products.of_parts.size(); ++b) {
    if (!has_estimate(solution, b)) continue;
    const std::vector<double> primal =
                                  squared_errors_of_parts(pass, b, solution.increments.back().fields.displacements[b],
                                                          pass.wider.increments.back().fields.displacements[b], true),
                              dual = squared_errors_of_parts(pass, b, pass.dual[b], pass.wider_dual[b], false);
    for (std::size_t k = 0; k < primal.size(); ++k) {
      const double product = std::sqrt(primal[k] * dual[k]);
      products.sum += product;
      if (solution.model.bodies[b].mesh.tolerance) products.of_parts[b].push_back(product);
    }
  }
  return products;
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

StaticSolution without_goal(StaticSolution solution, const model::Model& model, const std::string& why) {
  const QuantityResult* found = nullptr;
  if (!solution.increments.empty() && !solution.increments.back().quantities.empty())
    found = &solution.increments.back().quantities.front();
  solution.outcome = Outcome::not_converged;
  solution.reason = found
                        ? fmt::format(
                              "the tolerance of {} was not reached: its bar is {:.3g} of its value with {} degrees of "
                              "freedom, and {}",
                              model.tolerance->of.name, found->relative(), solution.mesh.dofs(), why)
                        : fmt::format("the tolerance of {} was not reached: {}", model.tolerance->of.name, why);
  return solution;
}

/// The bar of Model::tolerance.
class ToleranceOfNumber : public Aim {
 public:
  /// Of a model with_tolerances().
  ToleranceOfNumber(const model::Model& model, const Options& options) : model_(model), options_(options) {}

  StaticSolution solve(mesh::Mesh mesh, const std::string& name) override {
    wider_.reset();
    const model::Quantity& quantity = model_.tolerance->of;
    StaticSolution solution = solve_on_mesh(model_, std::move(mesh), with_dual(options_, quantity, name, dual_));
    if (solution.outcome == Outcome::solved)
      wider_ = solve_wider(solution, false, with_dual(options_, quantity, name + ", error", wider_dual_), why_);
    return solution;
  }

  std::optional<Estimate> estimate(StaticSolution& solution, const ModelRefinement& of) override {
    if (solution.outcome != Outcome::solved) return std::nullopt;
    if (!wider_) {
      solution = without_goal(std::move(solution), model_, "on the mesh of higher order, " + why_);
      return std::nullopt;
    }
    if (model_.output.error) estimate_errors(solution);
    const model::Quantity& quantity = model_.tolerance->of;
    const double J = value_of(solution, solution.increments.back(), quantity).value_or(0.0),
                 wider = value_of(*wider_, wider_->increments.back(), quantity).value_or(0.0);
    wanted_ = model_.tolerance->relative * std::abs(J);
    const double quick = bar_factor * std::abs(wider - J);
    Estimate estimate{J != 0.0 ? quick / std::abs(J) : 0.0, 0.0, false};
    const double rounding = rounding_of(solution, solution.increments.back(), quantity, model_.solver.tolerance);
    if (wanted_ < rounding) {
      solution = not_reached(std::move(solution), of, below_rounding(std::max(std::abs(J), std::abs(wider)), rounding));
      estimate.ends = true;
      return estimate;
    }
    products_ = products_of({solution, *wider_, dual_, wider_dual_});
    estimate.sum = products_.sum;
    if (quick <= wanted_) compare_bar(solution, of, estimate);
    return estimate;
  }

  /// Shares sum to about 1 when the bar is reached, which decides how much smaller polygons become.
  MeshErrors errors(const StaticSolution& solution) override {
    MeshErrors errors{solution.mesh, products_.of_parts, frozen_elements(solution, false)};
    for (std::vector<double>& of_body : errors.shares)
      for (double& share : of_body) share *= wanted_ > 0.0 ? bar_factor / wanted_ : 1.0;
    return errors;
  }

  StaticSolution not_reached(StaticSolution solution, const ModelRefinement& of, const std::string& why) override {
    add_own_bars(solution, of);
    return without_goal(std::move(solution), model_, why);
  }

 private:
  void estimate_errors(StaticSolution& solution) const {
    for (std::size_t i = 0; i < solution.increments.size(); ++i)
      solution.increments[i].error =
          analysis::estimate(solution, solution.increments[i], *wider_, wider_->increments[i]);
  }

  void add_own_bars(StaticSolution& solution, const ModelRefinement& of) const {
    if (solution.increments.back().quantities.empty())
      add_bars(solution, model_, richer_values({model_, &of, nullptr}, solution, options_));
  }

  /// The quick bar is as small as wanted: whether the one of several meshes is.
  void compare_bar(StaticSolution& solution, const ModelRefinement& of, Estimate& estimate) {
    add_own_bars(solution, of);
    const auto& quantities = solution.increments.back().quantities;
    if (!quantities.empty()) {
      estimate.error = quantities.front().relative();
      estimate.ends = quantities.front().reached();
    } else if (++without_bars_ == most_without_bars) {
      solution = without_goal(std::move(solution), model_, "no error bar could be computed on two meshes");
      estimate.ends = true;
    }
  }

  static std::string below_rounding(double value, double rounding) {
    if (value <= rounding)
      return "the value is zero but for rounding errors, so that no bar is small relative to it: ask for another "
             "number";
    return fmt::format(
        "the tolerance of the certificate and rounding do not allow a bar below {:.2g}: ask for a larger tolerance",
        rounding);
  }

  /// Where no richer mesh can be made, finer ones rarely help.
  static constexpr int most_without_bars = 2;

  const model::Model& model_;
  const Options& options_;
  int without_bars_ = 0;
  // Of the solution that was solved last:
  std::optional<StaticSolution> wider_;
  std::string why_;  // it is not there
  std::vector<Vector> dual_, wider_dual_;
  double wanted_ = 0.0;  // bar
  Products products_;
};

StaticSolution refine_for_goal(const model::Model& given, const Options& options, const RefinementLimits& limits) {
  const model::Model model = with_tolerances(given);
  ModelRefinement refinement(model);
  ToleranceOfNumber number(model, options);
  StaticSolution solution = refine(number, refinement, limits);
  solution.model = given;
  return solution;
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
