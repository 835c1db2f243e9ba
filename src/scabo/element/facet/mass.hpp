// Mass of the boundary of a super-element, by integrals over its facets, and the mass matrix that follows from it
// (sbfem/mass.hpp).
#pragma once

#include <vector>

#include "scabo/element/facet/coefficient_matrices.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

/// M0 = int N' rho N |J| deta times thickness, n x n. `density`: mass / length^3, one for all boundary elements or one
/// for each. The integration is exact, also on curved elements.
Eigen::SparseMatrix<double> boundary_mass(const Ring& ring, const std::vector<double>& density, double thickness);

/// Whether all densities are equal.
bool is_uniform(const std::vector<double>& density);

/// M, n x n, mass: symmetric, positive definite where the density is positive. `solution` and `modal` are those of the
/// ring. If all densities are equal, symmetry blocks do not interact and only k = l is solved.
Matrix mass_matrix(const Ring& ring, const SuperElementSolution& solution, const ModalSolution& modal,
                   const std::vector<double>& density, double thickness, int threads = 1);

}  // namespace scabo::element
