// Displacement, strain and stress at single points, without an output mesh.
#pragma once

#include <array>
#include <optional>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/element/interior_field.hpp"
#include "scabo/element/plane_element8.hpp"
#include "scabo/element/radial_table.hpp"

namespace scabo::result {

/// Values of one body after one increment at any point (x, y) of its undeformed shape. Keeps references to the solution
/// and the increment.
class Probe {
 public:
  Probe(const analysis::StaticSolution& solution, const analysis::IncrementResult& increment, int body);

  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  /// Prepares for many points: fields of super-elements are then interpolated along xi, to rounding accuracy.
  void expect_many();

  /// Nothing if the point lies outside the body. Between finite elements (in super-elements: boundary elements) the
  /// value of one of them is returned. A rigid body has only a displacement.
  std::optional<element::PointValues> at(const Vec2& x) const;
  /// The same for known scaled boundary coordinates.
  element::PointValues at(const Vec2& x, const element::ScaledPoint& place) const;

 private:
  std::optional<element::PointValues> in_finite_elements(const Vec2& x) const;

  const analysis::StaticSolution& solution_;
  std::size_t body_;
  const Vector& u_;
  Vec2 reference_displacement_;
  const element::InteriorLoads& interior_;
  std::optional<element::RadialField> field_;  // of a super-element
  std::optional<element::RadialTable> table_;  // of field_
};

/// The same for a single point.
std::optional<element::PointValues> value_at(const analysis::StaticSolution& solution,
                                             const analysis::IncrementResult& increment, int body, const Vec2& x);

/// Corners and displacements of a finite element.
struct FiniteElementState {
  element::Corners8 x;
  element::Vector16 u;
};
FiniteElementState finite_element_state(const mesh::BodyMesh& mesh, const mesh::PlaneElement8& element,
                                        const Vector& u);

/// Natural coordinates of `x` in an element; nothing if it lies outside.
std::optional<Vec2> natural_coordinates(const element::Corners8& corners, const Vec2& x);

/// Displacement of a point of a rigid body at `arm` from its centroid; `motion` = [u_x, u_y, rotation], small.
Vec2 rigid_displacement(const Vector& motion, const Vec2& arm);

}  // namespace scabo::result
