#include "scabo/analysis/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/cracks.hpp"
#include "scabo/element/cell_locator.hpp"
#include "scabo/element/elasticity.hpp"
#include "scabo/linalg/general_solver.hpp"
#include "scabo/mesh/output_points.hpp"

namespace scabo::analysis {

namespace {

using Kind = model::Quantity::Kind;

/// Bodies that hold the point of a quantity.
std::vector<int> bodies_of(const model::Model& model, const model::Quantity& quantity) {
  if (quantity.index >= 0) return {quantity.index};
  std::vector<int> bodies;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (mesh::holds(model.bodies[b], quantity.at)) bodies.push_back(static_cast<int>(b));
  return bodies;
}

/// Whether a crack tip has the name of a quantity, which may leave out the end if the crack has one tip only.
bool is_named(const std::string& tip, const model::Model& model, const model::Quantity& quantity) {
  const std::string name = model.bodies[static_cast<std::size_t>(quantity.index)].name + "." + quantity.crack;
  return tip == name || tip == name + ".start" || tip == name + ".end";
}

/// Displacement of a place in a cell, for displacements of the nodes of the cell.
Vec2 displacement_at(const StaticSolution& solution, std::size_t b, const element::CellPlace& place, const Vector& u,
                     const std::vector<element::RadialLoad>& loads) {
  const mesh::BodyMesh& mesh = solution.mesh.bodies[b];
  if (const auto& cell = solution.cells[b][place.cell]) {
    const element::RadialField field(cell->solution, cell->modes(), u, loads);
    return element::point_values(cell->ring, field.at(place.scaled.xi), cell->sectors.D, place.scaled.element,
                                 place.scaled.eta)
        .displacement;
  }
  const element::FiniteElement of = element::finite_element_of(mesh.cells[place.cell], mesh.nodes);
  return element::finite_element_values(of, u, element::Mat3::Identity(), place.natural).displacement;
}

std::vector<int> dofs_at(const StaticSolution& solution, std::size_t b, std::size_t cell) {
  const mesh::BodyMesh& mesh = solution.mesh.bodies[b];
  return solution.cells[b][cell] ? element::dofs_of(mesh.cells[cell])
                                 : element::dofs_of(element::finite_element_of(mesh.cells[cell], mesh.nodes));
}

std::optional<double> displacement_of_point(const StaticSolution& solution, const IncrementResult& increment,
                                            const model::Quantity& quantity) {
  const auto b = static_cast<std::size_t>(bodies_of(solution.model, quantity).front());
  const model::Body& body = solution.model.bodies[b];
  const Vector& u = increment.displacements[b];
  Vec2 at = Vec2::Zero();
  if (body.rigid) {
    const Vec2 arm = quantity.at - body.outline.centroid();
    at = Vec2(u[0] - u[2] * arm.y(), u[1] + u[2] * arm.x());
  } else {
    const auto place = element::CellLocator(solution.mesh.bodies[b], solution.cells[b]).nearest(quantity.at);
    at = displacement_at(solution, b, place, u(dofs_at(solution, b, place.cell)),
                         element::loads_in(increment.interior[b], place.cell).loads);
  }
  return (at - increment.reference_displacement)[quantity.component];
}

}  // namespace

std::optional<double> value_of(const StaticSolution& solution, const IncrementResult& increment,
                               const model::Quantity& quantity) {
  const auto index = static_cast<std::size_t>(std::max(quantity.index, 0));
  switch (quantity.kind) {
    case Kind::normal_force:
      return increment.contacts[index].normal_force;
    case Kind::tangential_force:
      return increment.contacts[index].tangential_force;
    case Kind::max_gap:
      return increment.contacts[index].max_gap;
    case Kind::reaction:
      return increment.reactions[index][quantity.component];
    case Kind::displacement:
      return displacement_of_point(solution, increment, quantity);
    case Kind::stress_intensity:
      for (const CrackResult& crack : increment.cracks)
        if (is_named(crack.name, solution.model, quantity)) {
          const double factor = quantity.component == 0 ? crack.factors.K_I : crack.factors.K_II;
          return std::isfinite(factor) ? std::optional(factor) : std::nullopt;
        }
      return std::nullopt;
    case Kind::elastic_energy:
      return increment.energy.elastic;
  }
  return std::nullopt;
}

void check_quantities(const model::Model& model, const mesh::Mesh& mesh) {
  std::vector<const model::Quantity*> all;
  for (const model::Quantity& quantity : model.output.error_of) all.push_back(&quantity);
  if (model.tolerance) all.push_back(&model.tolerance->of);
  std::vector<Diagnostic> mistakes;
  for (const model::Quantity* quantity : all) {
    if (quantity->kind == Kind::displacement) {
      const std::vector<int> bodies = bodies_of(model, *quantity);
      if (bodies.size() == 1) continue;
      if (bodies.empty())
        mistakes.push_back({quantity->source, "the point lies in no body"});
      else
        mistakes.push_back(
            {quantity->source,
             fmt::format("the point lies in body '{}' and in body '{}', which may move apart: give it a 'body'",
                         model.bodies[static_cast<std::size_t>(bodies[0])].name,
                         model.bodies[static_cast<std::size_t>(bodies[1])].name)});
    } else if (quantity->kind == Kind::stress_intensity) {
      const auto b = static_cast<std::size_t>(quantity->index);
      std::vector<std::string> tips;
      for (const mesh::Cell& cell : mesh.bodies[b].cells)
        if (cell.kind == mesh::CellKind::superelement && cell.is_open())
          if (std::string name = name_of_tip(model.bodies[b], cell.centre); is_named(name, model, *quantity))
            tips.push_back(std::move(name));
      if (tips.size() == 1) continue;
      const std::string word = quantity->component == 0 ? "K_I" : "K_II";
      mistakes.push_back({quantity->source,
                          tips.empty() ? fmt::format("'{}' is no crack tip: this end lies on the boundary or on another "
                                                     "crack",
                                                     quantity->crack)
                                       : fmt::format("the crack has two tips: write {1}.{0} or {2}.{0}", word, tips[0],
                                                     tips[1])});
    }
  }
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
}

}  // namespace scabo::analysis
