#include "scabo/analysis/goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scabo/analysis/quantities.hpp"
#include "scabo/analysis/refinement.hpp"
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
  double size = 1.0;         ///< of elements and cells, relative
  int raised = 0;            ///< orders
  double finite_size = 1.0;  ///< of finite elements, relative
};
constexpr Richer same_elements{1.0, 1, 0.5}, halved{0.5, 1, 0.25}, halved_and_raised{0.5, 2, 0.25},
    raised_twice{1.0, 2, 0.25};

std::vector<const model::Quantity*> quantities_of(const model::Model& model) {
  std::vector<const model::Quantity*> quantities;
  if (model.tolerance) quantities.push_back(&model.tolerance->of);
  for (const model::Quantity& quantity : model.output.error_of)
    if (!model.tolerance || quantity.name != model.tolerance->of.name) quantities.push_back(&quantity);
  return quantities;
}

constexpr int highest_order = 16;

/// The model whose meshes are richer than those of `model`.
model::Model enriched_model(model::Model model, const Richer& richer) {
  for (model::Body& body : model.bodies) {
    if (body.rigid) continue;
    model::MeshOptions& mesh = body.mesh;
    const bool finite = mesh.kind == model::MeshKind::fem;
    const double factor = finite ? richer.finite_size : richer.size;
    mesh.size *= factor;
    mesh.min_size *= factor;
    for (model::LocalSize& local : mesh.refine) local.size *= factor;
    if (!finite) mesh.order = std::min(mesh.order + richer.raised, highest_order);
  }
  return model;
}

/// The division with every element divided and raised.
mesh::Division enriched_division(mesh::Division division, const Richer& richer) {
  const int parts = static_cast<int>(std::lround(1.0 / richer.size));
  for (mesh::BodyDivision& body : division)
    for (mesh::EdgeDivision& edge : body) {
      mesh::EdgeDivision fine;
      fine.breaks = {edge.breaks.front()};
      for (std::size_t k = 0; k < edge.orders.size(); ++k)
        for (int part = 1; part <= parts; ++part) {
          fine.breaks.push_back(part == parts ? edge.breaks[k + 1]
                                              : std::lerp(edge.breaks[k], edge.breaks[k + 1],
                                                          static_cast<double>(part) / parts));
          fine.orders.push_back(std::min(edge.orders[k] + richer.raised, highest_order));
        }
      edge = std::move(fine);
    }
  return division;
}

/// Where the mesh of the results comes from.
struct MeshSource {
  const model::Model& model;
  const ModelRefinement* refinement = nullptr;  ///< null: from the options of the bodies
};

mesh::Mesh richer_mesh(const MeshSource& source, const model::Model& model, const Richer& richer) {
  if (!source.refinement) return mesh::make_mesh(model);
  return mesh::make_mesh(model, enriched_division(source.refinement->boundaries.division(), richer),
                         source.refinement->cells.scaled_sizes(richer.size));
}

/// Whether the richer mesh would take too long, judged by the present one.
bool is_too_large(const mesh::Mesh& mesh, const model::Model& model, const Richer& richer) {
  double all = 0.0;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    const mesh::BodyMesh& body = mesh.bodies[b];
    const model::MeshOptions& options = model.bodies[b].mesh;
    const bool one = body.cells.size() == 1, finite = options.kind == model::MeshKind::fem;
    const double factor = finite ? richer.finite_size : richer.size, order = std::max(options.order, 1);
    const double raised = finite ? 1.0 : (order + richer.raised) / order;
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
    model::Model model = enriched_model(source.model, richer);
    mesh::Mesh mesh = richer_mesh(source, model, richer);
    StaticSolution solution = solve_on_mesh(std::move(model), std::move(mesh), quiet(options, what));
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
  const bool small = !is_too_large(solution.mesh, source.model, halved);
  RicherValues richer;
  for (const Richer& next : {same_elements, small ? halved : raised_twice, halved_and_raised}) {
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
    solution.warnings.push_back(fmt::format("no error bars were computed: on a finer mesh, {}", richer.why));
    return;
  }
  if (richer.values.size() < 2)
    solution.warnings.push_back(
        fmt::format("error bars come from one finer mesh only, and may be too small: on the next, {}", richer.why));
  const auto quantities = quantities_of(model);
  const Values J = values_of(solution, quantities);
  for (std::size_t i = 0; i < J.size(); ++i)
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      if (!solution.increments[i].converged) continue;
      std::vector<double> finer;
      for (const Values& values : richer.values) finer.push_back(values[i][k]);
      QuantityResult result{quantities[k]->name, J[i][k], bar_of(J[i][k], finer), finer.back(), {}};
      // What the certificate of contact allows, and rounding, are not discretisation errors, but errors.
      result.bar = std::max(result.bar, model.solver.tolerance * std::abs(result.value));
      if (model.tolerance && k == 0) result.wanted = model.tolerance->relative;
      solution.increments[i].quantities.push_back(std::move(result));
    }
}

}  // namespace

double QuantityResult::relative() const {
  if (bar == 0.0) return 0.0;
  return value == 0.0 ? std::numeric_limits<double>::infinity() : bar / std::abs(value);
}

bool wants_bars(const model::Model& model) { return model.tolerance || !model.output.error_of.empty(); }

void check_bars(const model::Model& model, const mesh::Mesh& mesh) {
  if (wants_bars(model)) check_quantities(model, mesh);
}

StaticSolution solve_with_bars(model::Model model, mesh::Mesh mesh, const Options& options,
                               const RefinementLimits& limits) {
  (void)limits;
  hold_near_places(model, mesh);
  StaticSolution solution = solve_on_mesh(model, std::move(mesh), quiet(options, "mesh"));
  if (solution.outcome == Outcome::solved)
    add_bars(solution, model, richer_values({model}, solution, options));
  replay(solution, options);
  return solution;
}

}  // namespace scabo::analysis
