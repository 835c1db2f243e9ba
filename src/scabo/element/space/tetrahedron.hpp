// Tetrahedra with 4 or 10 nodes as finite elements of linear elasticity in space.
//
// Nodes as geometry::SimplexBasis has them, 3 x n; the corners are such that the Jacobian det(x,xi) is positive.
// Displacements have three components for each node. With the gradients g_i of the shape functions,
//
//     strain = [xx, yy, zz, xy, yz, zx] (shear strains as angles) = B u,   stress = D strain,   K = int B'D B dV
//
// By the rule of degree 3, which is exact for K if the edges are straight, and for the forces of a constant stress,
// int B' dV, also if they are curved: the patch test holds for every mesh.
#pragma once

#include "scabo/geometry/simplex_basis.hpp"

namespace scabo::element {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Isotropic; young > 0, -1 < poisson < 1/2.
Mat6 elasticity_in_space(double young, double poisson);

/// K, 3n x 3n, symmetric.
Matrix tetrahedron_stiffness(const Matrix& nodes, const Mat6& D);

/// int N dV, n numbers: times a force per volume, the nodal forces of it.
Vector volume_weights(const Matrix& nodes);

/// int B' stress T dV, 3n numbers: nodal forces of a stress times T, which has a value at every node.
Vector forces_of_stress(const Matrix& nodes, const Vec6& stress, const Vector& T);

/// int T^2 dV of T with a value at every node.
double integral_of_square(const Matrix& nodes, const Vector& T);

/// The least Jacobian at nodes and points of the rule, over the cube of the size of the box around it; positive: the
/// element is not folded.
double least_jacobian(const Matrix& nodes);

/// Strain of displacements u (3n) at a point.
Vec6 strain_at(const Matrix& nodes, const Vector& u, const Vector& lambda);

}  // namespace scabo::element
