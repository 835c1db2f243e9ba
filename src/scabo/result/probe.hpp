// Displacement, strain and stress at single points, without an output mesh.
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/analysis/state/results.hpp"
#include "scabo/element/cell_locator.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/element/plane/interior_field.hpp"
#include "scabo/element/sbfem/radial_table.hpp"

namespace scabo::result {

using element::CellLocator;
using element::CellPlace;

/// Values of one body in one state at any point (x, y) of its undeformed shape. Keeps references to the discretisation
/// and the state.
class Probe {
 public:
  Probe(const analysis::Discretisation& discretisation, const analysis::FieldState& state, int body);

  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  ~Probe();

  /// Prepares for many points in few super-elements: their fields are then interpolated along xi, to rounding accuracy.
  void expect_many();

  /// Nothing if the point lies outside the body. Between cells and between boundary elements the value of one of them
  /// is returned. A rigid body has only a displacement.
  std::optional<element::PointValues> at(const Vec2& x) const;
  /// The same for a known place of an elastic body.
  element::PointValues at(const Vec2& x, const CellPlace& place) const;

 private:
  struct CellField;
  const CellLocator& locator() const;
  CellField& field_of(std::size_t cell) const;

  const analysis::Discretisation& discretisation_;
  const analysis::FieldState& state_;
  std::size_t body_;
  const Vector& u_;
  Vec2 reference_displacement_;
  const element::CellLoads& interior_;
  bool many_ = false;
  mutable std::optional<CellLocator> locator_;  // made when it is first needed
  /// Of super-elements, likewise: those that hold points, so that a probe costs nothing for the other cells.
  mutable std::unordered_map<std::size_t, std::unique_ptr<CellField>> fields_;
};

/// The same for a single point.
std::optional<element::PointValues> value_at(const analysis::Discretisation& discretisation,
                                             const analysis::FieldState& state, int body, const Vec2& x);

/// A finite element with its material and its values in one state.
class FiniteElementState {
 public:
  FiniteElementState(const analysis::Discretisation& discretisation, const analysis::FieldState& state,
                     std::size_t body, std::size_t cell);
  const element::FiniteElement& element() const { return element_; }
  /// Without the reference displacement; the change of temperature is taken out of the stress.
  element::PointValues at(const Vec2& natural) const;

 private:
  element::FiniteElement element_;
  element::ElementVector u_;
  element::SectionLaw law_;
  bool revolved_ = false;
  const element::InteriorLoads& interior_;
};

/// Displacement of a point of a rigid body at `arm` from its centroid; `motion` = [u_x, u_y, rotation], small.
Vec2 rigid_displacement(const Vector& motion, const Vec2& arm);

}  // namespace scabo::result
