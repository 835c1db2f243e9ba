#include "scabo/analysis/adaptive/error_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scabo/analysis/adaptive/frozen_elements.hpp"
#include "scabo/analysis/quasistatic/run.hpp"
#include "scabo/analysis/state/quantities.hpp"

namespace scabo::analysis {

namespace {

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

constexpr int richest_order = 16;

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
    if (mesh.kind != model::MeshKind::fem) mesh.order = std::min(order_of(body) + richer.raised, richest_order);
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
          fine.orders.push_back(std::min(edge.orders[k] + richer.raised, richest_order));
        }
      edge = std::move(fine);
    }
  return division;
}

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

bool agree(const Values& J, const RicherValues& richer) {
  const Values &last = richer.values.back(), &before = richer.values[richer.values.size() - 2];
  for (std::size_t i = 0; i < J.size(); ++i)
    for (std::size_t k = 0; k < J[i].size(); ++k)
      if (std::abs(last[i][k] - before[i][k]) > agreement * std::abs(last[i][k] - J[i][k])) return false;
  return true;
}

/// Eq. (1).
double bar_of(double J, const std::vector<double>& richer) {
  const double last = richer.back(), difference = std::abs(last - J);
  const double change = richer.size() > 1 ? std::abs(last - richer[richer.size() - 2]) : 0.0;
  return std::max(bar_factor * difference, change > difference ? change : 0.0);
}

}  // namespace

std::vector<const model::Quantity*> quantities_of(const model::Model& model) {
  std::vector<const model::Quantity*> quantities;
  if (model.tolerance) quantities.push_back(&model.tolerance->of);
  for (const model::Quantity& quantity : model.output.error_of)
    if (!model.tolerance || quantity.name != model.tolerance->of.name) quantities.push_back(&quantity);
  return quantities;
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

}  // namespace scabo::analysis
