// Loads inside a super-element: body forces, tractions on side faces, initial strains (temperature), as powers of xi
// (RadialLoad of sbfem/super_element.hpp, eq. 1).
//
//     body force b xi^k                     j = k + 2,  g = int N' b |J| deta t                              (2)
//     traction s xi^k on a side face        j = k + 1,  g = s l t at the face's node, l its length           (3)
//     initial strain eps0 xi^k              j = k + 1,  c = int B1' D eps0 |J| deta t,                       (4)
//                                                       g = int B2' D eps0 |J| deta t
//
// with the thickness t.
#pragma once

#include <vector>

#include "scabo/element/facet/coefficient_matrices.hpp"
#include "scabo/element/facet/temperature_table.hpp"
#include "scabo/element/sbfem/modal_solution.hpp"

namespace scabo::element {

/// Body force, force / length^3, as a function of (x, y) relative to the scaling centre, times `density`: one for all
/// boundary elements or one for each.
std::vector<RadialLoad> body_force_loads(const Ring& ring, const LinearField& b_x, const LinearField& b_y,
                                         double thickness, const std::vector<double>& density = {1.0});

/// A side face of an open super-element.
enum class Face { first, last };

/// Traction `value` xi^`power` (force / length^2, power > -1) on a side face.
RadialLoad face_load(const Ring& ring, Face face, double power, const Vec2& value, double thickness);

/// Outward unit normal of a side face.
Vec2 face_normal(const Ring& ring, Face face);

/// Change of temperature as a function of (x, y) relative to the scaling centre. `unit_strain`: free strain [xx, yy,
/// xy] per unit of temperature, one for all boundary elements or one for each.
std::vector<RadialLoad> thermal_loads(const Ring& ring, const Elasticity& D, const std::vector<Vec3>& unit_strain,
                                      const LinearField& temperature, double thickness);

/// Integral of `per_product` T T' over the volume inside, for two changes of temperature as functions of (x, y)
/// relative to the scaling centre; `per_product`: one for all boundary elements or one for each.
double integral_of_product(const Ring& ring, const LinearField& one, const LinearField& other,
                           const std::vector<double>& per_product, double thickness);

/// Everything that acts inside a body and is needed, in addition to its nodal forces, to recover its interior.
struct InteriorLoads {
  std::vector<RadialLoad> loads;                 ///< of a super-element
  LinearField temperature;                       ///< change of temperature as a function of absolute (x, y)
  std::vector<TemperatureRemainder> remainders;  ///< what tables add to it in a super-element of one material
  InternalMotion motion;                         ///< in time and in natural modes, of a body that is one super-element

  /// The whole change of temperature.
  double temperature_at(const Vec2& x) const;
  // Sums of the particular solutions, temperature_table.hpp (1); absolute (x, y).
  Vec2 particular_displacement(const Vec2& x) const;
  Vec3 particular_strain(const Vec2& x) const;
  /// Displacements `u` of the nodes of a super-element, without those of the particular solutions.
  Vector without_particular(const Ring& ring, const Vec2& centre, Vector u) const;

  /// Whether loads act inside of which its displacements at the boundary do not know.
  bool acts() const { return !loads.empty() || !remainders.empty() || motion.modes; }
  bool is_zero() const { return !acts() && temperature.is_zero(); }
};

/// Loads inside the cells of a body, one entry for each cell; empty: none.
using CellLoads = std::vector<InteriorLoads>;
const InteriorLoads& loads_in(const CellLoads& loads, std::size_t cell);

/// Adds `factor` times `loads` to `to`.
void add(InteriorLoads& to, const InteriorLoads& loads, double factor);
/// The same, combining loads of equal power.
void add_radial_loads(std::vector<RadialLoad>& to, const std::vector<RadialLoad>& loads, double factor);

}  // namespace scabo::element
