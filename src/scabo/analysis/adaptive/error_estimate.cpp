#include "scabo/analysis/adaptive/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "scabo/base/components.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/element/plane/two_orders.hpp"

namespace scabo::analysis {

namespace {

/// The boundary and the stiffness of a cell, in the numbers of its own nodes; of a finite element, too.
struct CellStiffness {
  std::vector<mesh::LineElement> elements;
  Matrix k;
};
CellStiffness stiffness_of(const Discretisation& discretisation, std::size_t b, std::size_t c) {
  if (const auto& cell = discretisation.cells[b][c]) return {cell->ring.elements, cell->K()};
  const mesh::BodyMesh& mesh = discretisation.mesh.bodies[b];
  const mesh::Cell& cell = mesh.cells[c];
  std::map<int, int> own;
  for (const int node : cell.nodes()) own.emplace(node, static_cast<int>(own.size()));
  CellStiffness made{cell.boundary, Matrix::Zero(places_of(own.size()), places_of(own.size()))};
  for (mesh::LineElement& element : made.elements)
    for (int& node : element.nodes) node = own.at(node);
  const element::FiniteElement finite = element::finite_element_of(cell, mesh.nodes);
  const model::Model& model = discretisation.model;
  const model::Material& material = model.materials[static_cast<std::size_t>(cell.materials.front())];
  const element::ElementMatrix k = element::finite_element_stiffness(
      finite, element::section_law(material, model.analysis.plane), model::extent_of(model, static_cast<int>(b)));
  std::vector<int> dofs;
  for (const int node : finite.nodes())
    for (const int component : {0, 1}) dofs.push_back(static_cast<int>(place_of(own.at(node), component)));
  made.k(dofs, dofs) = k;
  return made;
}

/// Squared errors of the cells of a body, force times length; 0 for those left out.
std::vector<double> squared_errors(const Discretisation& discretisation, const IncrementResult& increment,
                                   const Discretisation& wider, const IncrementResult& wider_increment, std::size_t b,
                                   const std::vector<bool>& left_out) {
  std::vector<double> squared;
  for (std::size_t c = 0; c < discretisation.cells[b].size(); ++c) {
    if (left_out[c]) {
      squared.push_back(0.0);
      continue;
    }
    // Loads inside a cell are not among the forces on its boundary.
    const bool relaxed = !element::loads_in(increment.fields.interior[b], c).acts();
    squared.push_back(squared_difference(discretisation, increment.fields.displacements[b], wider,
                                         wider_increment.fields.displacements[b], b, c, relaxed));
  }
  return squared;
}

ErrorEstimate estimate(const StaticSolution& solution, const IncrementResult& increment, const StaticSolution& wider,
                       const IncrementResult& wider_increment, const Flags& left_out) {
  ErrorEstimate error;
  error.bodies.resize(solution.model.bodies.size());
  std::vector<double> squared(error.bodies.size(), 0.0);
  double energy = 0.0;
  for (std::size_t b = 0; b < error.bodies.size(); ++b) {
    if (!has_estimate(solution, b)) continue;
    for (const double of_cell : squared_errors(solution, increment, wider, wider_increment, b, left_out[b]))
      squared[b] += of_cell;
    for (std::size_t c = 0; c < solution.cells[b].size(); ++c) {
      const Vector U = displacement_of(wider, wider_increment, b, c);
      energy += U.dot(wider.cells[b][c]->K() * U);
    }
  }
  // Loads inside have energy too.
  energy = std::max(energy, 2.0 * wider_increment.energy.elastic);
  const double norm = std::sqrt(energy);
  const auto relative = [&](double square) { return norm > 0.0 ? std::sqrt(square) / norm : 0.0; };
  error.relative = relative(std::accumulate(squared.begin(), squared.end(), 0.0));
  for (std::size_t b = 0; b < error.bodies.size(); ++b)
    if (has_estimate(solution, b)) error.bodies[b] = BodyError{std::sqrt(squared[b]), relative(squared[b])};
  return error;
}

}  // namespace

Vector displacement_of(const Discretisation& discretisation, const IncrementResult& increment, std::size_t body,
                       std::size_t cell) {
  return increment.fields.displacements[body](element::dofs_of(discretisation.mesh.bodies[body].cells[cell]));
}

void estimate_all(StaticSolution& solution, const StaticSolution& wider) {
  const Flags left_out = left_out_cells(solution);
  for (std::size_t i = 0; i < std::min(solution.increments.size(), wider.increments.size()); ++i)
    if (solution.increments[i].converged && wider.increments[i].converged)
      solution.increments[i].error = estimate(solution, solution.increments[i], wider, wider.increments[i], left_out);
}

double squared_difference(const Discretisation& discretisation, const Vector& u, const Discretisation& wider,
                          const Vector& U, std::size_t body, std::size_t cell, bool relaxed) {
  const CellStiffness narrow = stiffness_of(discretisation, body, cell);
  const element::SolvedSuperElement& wide = *wider.cells[body][cell];
  return element::squared_difference(
      {narrow.elements, narrow.k, u(element::dofs_of(discretisation.mesh.bodies[body].cells[cell])), wide.ring.elements,
       wide.K(), U(element::dofs_of(wider.mesh.bodies[body].cells[cell])), relaxed});
}

ErrorEstimate estimate(const StaticSolution& solution, const IncrementResult& increment, const StaticSolution& wider,
                       const IncrementResult& wider_increment) {
  return estimate(solution, increment, wider, wider_increment, left_out_cells(solution));
}

std::vector<double> element_errors(const Discretisation& discretisation, const IncrementResult& increment,
                                   const Discretisation& wider, const IncrementResult& wider_increment,
                                   std::size_t body) {
  std::vector<double> errors;
  for (std::size_t c = 0; c < discretisation.cells[body].size(); ++c) {
    const element::SolvedSuperElement &narrow = *discretisation.cells[body][c], &wide = *wider.cells[body][c];
    const Vector u = displacement_of(discretisation, increment, body, c),
                 U = displacement_of(wider, wider_increment, body, c);
    for (const double error :
         element::sector_differences({narrow.ring, narrow.solution(), narrow.modes(), u},
                                     {wide.ring, wide.solution(), wide.modes(), U}, wide.sectors.D))
      errors.push_back(error);
  }
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  for (double& error : errors)
    error = sum > 0.0 ? increment.error->bodies[body]->relative * std::sqrt(error / sum) : 0.0;
  return errors;
}

std::vector<double> cell_errors(const StaticSolution& solution, const IncrementResult& increment,
                                const StaticSolution& wider, const IncrementResult& wider_increment, std::size_t body) {
  const BodyError& whole = *increment.error->bodies[body];
  std::vector<double> errors =
      squared_errors(solution, increment, wider, wider_increment, body, left_out_cells(solution)[body]);
  for (double& error : errors) error = error > 0.0 ? std::sqrt(error) * whole.relative / whole.absolute : 0.0;
  return errors;
}

}  // namespace scabo::analysis
