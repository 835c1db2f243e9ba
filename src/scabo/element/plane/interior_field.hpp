// Displacement, strain and stress inside a super-element, from the displacements of its boundary.
#pragma once

#include <optional>

#include "scabo/element/facet/radial_load.hpp"
#include "scabo/element/plane/stiffness.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

struct PointValues {
  Vec2 displacement = Vec2::Zero();
  Vec3 strain = Vec3::Zero();  ///< [xx, yy, gamma_xy]
  Vec3 stress = Vec3::Zero();  ///< [xx, yy, xy]
  double strain_zz = 0.0;      ///< around the axis of a body of revolution
};

/// Scaled boundary coordinates of a point: it lies on the ray through `element` at eta, at the fraction xi of the
/// distance from the scaling centre (0) to the boundary (1), or beyond the boundary in an unbounded domain.
struct ScaledPoint {
  double xi = 0.0;
  int element = 0;
  double eta = 0.0;
};

/// The point of boundary element `element` at eta, relative to the scaling centre.
Vec2 boundary_position(const Ring& ring, int element, double eta);

/// Scaled boundary coordinates of (x, y), which is relative to the scaling centre; nothing if it lies outside the
/// domain. A point on a crack belongs to the face at the start of the ring.
std::optional<ScaledPoint> locate(const Ring& ring, const Vec2& x, bool unbounded = false);

/// Values at a point of a ring: `values` = RadialField::at(xi). stress = D (strain - initial_strain).
PointValues point_values(const Ring& ring, const RadialField::Values& values, const Elasticity& D, int element,
                         double eta, const Vec3& initial_strain = Vec3::Zero());

}  // namespace scabo::element
