// Elastic materials, and how they are taken in the plane.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "scabo/base/error.hpp"
#include "scabo/base/types.hpp"

namespace scabo::model {

/// Plane stress, plane strain, or the half plane x >= 0 that is turned about the axis x = 0: x is the radius, y runs
/// along the axis, and zz goes around it.
enum class Plane { stress, strain, revolution };

/// Engineering constants along axes 1, 2 (in the plane) and 3. Axis 1 is turned by `angle` from x.
struct Orthotropic {
  double E1 = 0.0, E2 = 0.0, E3 = 0.0;        ///< force / length^2, > 0
  double nu12 = 0.0, nu13 = 0.0, nu23 = 0.0;  ///< minus strain along the second axis / strain along the first
  double G12 = 0.0;                           ///< force / length^2, > 0
  double angle = 0.0;                         ///< radians, counter-clockwise
};

/// Elastic law in the plane, stress = D [exx, eyy, gxy], for plane stress and plane strain alike.
struct Anisotropic {
  double D11 = 0.0, D12 = 0.0, D22 = 0.0, D16 = 0.0, D26 = 0.0, D66 = 0.0;  ///< force / length^2, positive definite
};

/// Rayleigh damping C = a M + b K with the same part of critical damping at two frequencies, between which it is less.
struct Damping {
  double ratio = 0.0;           ///< of critical damping, 0 to 1
  double from = 0.0, to = 0.0;  ///< frequencies, 1 / time, 0 < from < to

  double of_mass() const;       ///< a, 1 / time
  double of_stiffness() const;  ///< b, time
};

/// Linear elastic material: isotropic, orthotropic or anisotropic.
struct Material {
  std::string name;
  double young = 0.0;    ///< force / length^2, > 0
  double poisson = 0.0;  ///< -1 < poisson < 0.5 (plane strain), <= 0.5 (plane stress)
  std::optional<std::variant<Orthotropic, Anisotropic>> law;  ///< instead of young and poisson
  std::optional<double> density;  ///< mass / length^3, >= 0; needed for gravity, by a modal analysis and in time
  std::optional<Damping> damping;
  /// Thermal strain along axes 1, 2 and 3 (anisotropic: exx, eyy, gxy) per unit of temperature; needed only where a
  /// temperature acts.
  std::optional<std::array<double, 3>> expansion;
  Source source;
};

}  // namespace scabo::model
