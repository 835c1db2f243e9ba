// Estimated errors in the energy norm: an analysis against the same on the mesh with boundary elements one order higher
// (element/plane/two_orders.hpp).
#pragma once

#include <vector>

#include "scabo/analysis/adaptive/frozen_elements.hpp"

namespace scabo::analysis {

/// Displacements of a cell's own nodes, length.
Vector displacement_of(const Discretisation& discretisation, const IncrementResult& increment, std::size_t body,
                       std::size_t cell);

/// Estimates of all increments that converged on both meshes.
void estimate_all(StaticSolution& solution, const StaticSolution& wider);

/// Estimated error of an increment: `increment` on the mesh of `solution`, `wider` on the mesh of higher order.
ErrorEstimate estimate(const StaticSolution& solution, const IncrementResult& increment, const StaticSolution& wider,
                       const IncrementResult& wider_increment);

/// Errors of the boundary elements of a body with an estimated error, relative like that of the body; the sum of their
/// squares is the square of the error of the body.
std::vector<double> element_errors(const Discretisation& discretisation, const IncrementResult& increment,
                                   const Discretisation& wider, const IncrementResult& wider_increment,
                                   std::size_t body);

/// Errors of the cells of a body with an estimated error, in the same way.
std::vector<double> cell_errors(const StaticSolution& solution, const IncrementResult& increment,
                                const StaticSolution& wider, const IncrementResult& wider_increment, std::size_t body);

/// Squared error in the energy norm of a cell, force times length, of displacements `u` of its body against `U` on the
/// mesh of higher order. `relaxed`: whether no loads act inside the cell.
double squared_difference(const Discretisation& discretisation, const Vector& u, const Discretisation& wider,
                          const Vector& U, std::size_t body, std::size_t cell, bool relaxed);

}  // namespace scabo::analysis
