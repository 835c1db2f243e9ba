// Finite elements of the plane whose nodes all lie on their sides: triangles and quadrilaterals with linear or
// quadratic sides (CPS3, CPS6, CPS4 and CPS8 in other programs; PLANE82 is the last one). Full integration,
// isoparametric.
//
// clang-format off
//     3            3            4-------3      4---7---3      corners counter-clockwise, then the middles of the
//     | \          | \          |       |      |       |      sides 12, 23, ...
//     |   \        6   5        |       |      8       6
//     |     \      |     \      |       |      |       |
//     1------2     1---4--2     1-------2      1---5---2
// clang-format on
//
// Natural coordinates (r, s): corners (0, 0), (1, 0), (0, 1) of a triangle; [-1, 1]^2 of a quadrilateral.
//
//     K = int B' D B dA t,   M = int N' N rho dA t,   f = int N' b dA t,   f_T = int B' D eps_T dA t              (1)
//
// Of a body of revolution t is 2 pi x, and B has a fourth row, of the hoop strain N u_x / x. Integration points do not
// lie on the axis. Full integration is exact for what a uniform stress with xx = zz does on sides of any shape.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "scabo/base/extent.hpp"
#include "scabo/element/plane/elasticity.hpp"
#include "scabo/element/plane/interior_field.hpp"

namespace scabo::element {

enum class FiniteElementKind { triangle3, triangle6, quad4, quad8 };

struct FiniteElement {
  FiniteElementKind kind = FiniteElementKind::quad8;
  std::array<int, 8> numbers{};  ///< of its nodes in the body; only the first size() are used, likewise below
  std::array<Vec2, 8> x;         ///< their positions

  int corners() const;
  int size() const;  ///< number of nodes
  std::span<const int> nodes() const { return {numbers.data(), static_cast<std::size_t>(size())}; }
};

/// Kind and nodes of a finite element, in the order of the pictures. Throws BrokenInvariant unless it has three or four
/// sides, all of order 1 or all of order 2. `nodes`: of its body.
FiniteElement finite_element_of(const mesh::Cell& cell, const std::vector<Vec2>& nodes);

/// Numbers of the degrees of freedom in the body, two for each node.
std::vector<int> dofs_of(const FiniteElement& element);

/// Natural coordinates of the nodes.
std::span<const Vec2> natural_nodes(FiniteElementKind kind);

/// Smallest Jacobian, the ratio of areas dA / (dr ds), at corners, nodes and integration points. Negative: the element
/// is folded, or its nodes run clockwise. Zero at a node and positive elsewhere is allowed, as in elements with a node
/// at the quarter of a side.
double least_jacobian(const FiniteElement& element);
/// Whether the element has a stiffness: its Jacobian is positive at the integration points and, but for rounding, not
/// negative at the nodes.
bool is_well_shaped(const FiniteElement& element);

/// For 2 size() degrees of freedom, ux and uy of the first node, then of the second ...
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 16, 16>;
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 16, 1>;

/// Stiffness, force / length; `D` force / length^2.
ElementMatrix finite_element_stiffness(const FiniteElement& element, const SectionLaw& law, const Extent& extent);

/// Consistent mass; `density` mass / length^3.
ElementMatrix finite_element_mass(const FiniteElement& element, double density, const Extent& extent);

/// Nodal forces of a body force, force / length^3, given as functions of absolute (x, y).
ElementVector finite_element_body_force(const FiniteElement& element, const LinearField& b_x, const LinearField& b_y,
                                        const Extent& extent);

/// Nodal forces of the rotation of a body of revolution at the angular velocity `spin`, radians / time.
ElementVector finite_element_spin_force(const FiniteElement& element, double density, double spin,
                                        const Extent& extent);

/// Nodal forces of a change of temperature as a function of absolute (x, y).
ElementVector finite_element_thermal_force(const FiniteElement& element, const SectionLaw& law,
                                           const LinearField& temperature, const Extent& extent);

/// Integral of the product of two changes of temperature over the volume, by the same rule.
double finite_element_product(const FiniteElement& element, const LinearField& one, const LinearField& other,
                              const Extent& extent);

/// Values at natural coordinates: stress = D (strain - free strain at the change of `temperature`). `u`: 2 size().
/// Strain and stress are not numbers where the Jacobian is zero. `revolved`: of a body of revolution, whose hoop strain
/// u_x / x is the radial strain on the axis.
PointValues finite_element_values(const FiniteElement& element, const ElementVector& u, const SectionLaw& law,
                                  const Vec2& natural, double temperature = 0.0, bool revolved = false);

/// The point at natural coordinates, which may lie slightly outside of the element.
Vec2 position_in(const FiniteElement& element, const Vec2& natural);

/// Natural coordinates of the point `x`; nothing if it lies outside, by more than 1e-9 in natural coordinates.
std::optional<Vec2> natural_coordinates(const FiniteElement& element, const Vec2& x);

/// The point of the sides of an element that is nearest to `x`.
struct NearestOnSides {
  Vec2 natural = Vec2::Zero();
  double distance = 0.0;
};
NearestOnSides nearest_on_sides(const FiniteElement& element, const Vec2& x);

}  // namespace scabo::element
