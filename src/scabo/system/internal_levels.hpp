// The internal levels of the bodies of a part that are one super-element each, bounded, of materials with mass
// (element/sbfem/internal_level.hpp): unknowns w beside the displacements of the part, with
//
//     mass [M, -Z; -Z, Q],     stiffness [K, 0; 0, Z],     load Z r                                          (1)
//
// r = a - g of the acceleration a of the moving ground and of gravity g, the same at every node: a body that falls
// freely, or that rests on shaking ground without deforming, has no forces of inertia inside. In a time step of system/
// inertia.hpp, whose unknowns are h y+ with y the velocity of w, the levels are eliminated:
//
//     A_ww = (1/h^2 + theta a/h) Q + (theta b/h + theta^2) Z,     A_uw = -c Z,   c = 1/h^2 + theta a/h         (2)
//
// with the damping a M + b K.
#pragma once

#include <memory>
#include <vector>

#include "scabo/element/cell_library.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/body_system.hpp"
#include "scabo/system/dofs.hpp"

namespace scabo::system {

struct BodyLevel {
  int body = 0;
  std::vector<int> dofs;  ///< of the body in its part, in the order of w
  std::shared_ptr<const element::InternalLevel> matrices;
  double of_mass = 0.0, of_stiffness = 0.0;  ///< a and b of its damping
  Eigen::Index first = 0;                    ///< of w among those of the part

  const Matrix& Z() const { return matrices->Z; }
  const Matrix& Q() const { return matrices->Q; }
  Eigen::Index size() const { return Z().rows(); }
  template <typename Internal>
  auto own(Internal& of_part) const {
    return of_part.segment(first, size());
  }
};

std::vector<BodyLevel> levels_of(const model::Model& model, const mesh::Mesh& mesh,
                                 const std::vector<element::SolvedCells>& cells, const Dofs& dofs, std::size_t part);

/// How many w a part with these levels has.
Eigen::Index size_of(const std::vector<BodyLevel>& levels);

/// What moves inside a body with a level, for w; nothing for one without.
element::InternalMotion internal_motion(const model::Model& model, const mesh::Mesh& mesh,
                                        const std::vector<element::SolvedCells>& cells, int body, Vector w);

/// A translation of all nodes of a level.
Vector translation_of(const BodyLevel& level, const Vec2& by);

/// Stiffness and mass of a part with the unknowns of its levels behind its own.
struct WithLevels {
  Stiffness K, M;
};
WithLevels with_levels(const Stiffness& K, const Stiffness& M, const std::vector<BodyLevel>& levels);

/// A level in time steps of one size, eq. (2).
struct LevelInTime {
  double coupling = 0.0;  ///< c
  Eigen::LLT<Matrix> A;   ///< of A_ww
};
LevelInTime level_in_time(const BodyLevel& level, double theta, double h);

/// Takes c Z A_ww^-1 Z c away from the stiffness of a part in time.
void eliminate(const std::vector<BodyLevel>& levels, const std::vector<LevelInTime>& in_time, Stiffness& A);

}  // namespace scabo::system
