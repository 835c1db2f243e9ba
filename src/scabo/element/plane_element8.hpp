// The 8-node serendipity element (PLANE82, CPS8 in other programs) with full 3 x 3 Gauss integration. It serves as an
// independent comparison for super-elements and uses the same contact solver.
#pragma once

#include <array>

#include "scabo/element/interior_field.hpp"

namespace scabo::element {

using Corners8 = std::array<Vec2, 8>;  ///< four corners counter-clockwise, then the middles of sides 12, 23, 34, 41
/// Node numbers of an 8-node cell in this order, and their positions.
std::array<int, 8> plane_element8_nodes_of(const mesh::Cell& cell);
Corners8 corners8_of(const mesh::Cell& cell, const std::vector<Vec2>& nodes);

using Matrix16 = Eigen::Matrix<double, 16, 16>;
using Vector16 = Eigen::Matrix<double, 16, 1>;

/// Stiffness, force / length; `D` force / length^2.
Matrix16 plane_element8_stiffness(const Corners8& x, const Mat3& D, double thickness);

/// Consistent mass of one component of the displacement, int N_i N_j rho dA thickness; `density` mass / length^3.
using Matrix8 = Eigen::Matrix<double, 8, 8>;
Matrix8 plane_element8_mass(const Corners8& x, double density, double thickness);

/// int N_i dA for every node; nodal forces of a body force are this times force / length^3 times thickness.
std::array<double, 8> plane_element8_areas(const Corners8& x);

/// Values at natural coordinates (r, s) in [-1, 1]^2.
PointValues plane_element8_values(const Corners8& x, const Vector16& u, const Mat3& D, double r, double s);

/// Natural coordinates of the eight nodes.
extern const std::array<Vec2, 8> plane_element8_nodes;

}  // namespace scabo::element
