// Mass and damping of the parts of a structure, and the structure that a time step sees (docs/methods/23_dynamics.md):
//
//     M v+ = M v + h (f - C v_theta - K u_theta + B'p),   v_theta = (1 - theta) v + theta v+
//     u_theta = u + theta h v_theta,                       u+ = u + h v_theta
//
// With w = h v+, a length, this is the problem of a structure at rest,
//
//     (M/h^2 + theta C/h + theta^2 K) w = M v/h - K (u + theta (1 - theta) h v) - (1 - theta) C v + f + B'p      (1)
//
// whose stiffness is positive definite: no part with a mass has rigid motions. theta = 1/2, which keeps energy; 1 for
// parts without mass, whose forces would otherwise gain it.
#pragma once

#include <optional>
#include <vector>

#include "scabo/system/internal_levels.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::system {

/// Matrices of one part; of a rigid one 3 x 3, about its reference point.
struct PartInertia {
  Stiffness K;  ///< with springs
  Stiffness M;
  std::optional<Stiffness> C;  ///< empty: no damping
  std::vector<BodyLevel> levels;
  double theta = 0.5;
  bool moves = true;  ///< false: supports hold all of a rigid part, so that its mass says nothing

  bool is_massless() const { return moves && theta == 1.0; }

  Vector stiffness_times(const Vector& u) const { return u.size() > 0 ? Vector(K.times(u) + K.springs.times(u)) : u; }
  Vector damping_times(const Vector& v) const { return C ? C->times(v) : Vector(Vector::Zero(v.size())); }
};

/// Of every part of a structure that is not divided among processes. Every material, and every rigid body that can
/// move, needs a density.
std::vector<PartInertia> inertia_of(const Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
                                    const std::vector<element::SolvedCells>& cells, int threads);

/// The levels of all parts in time steps of size `h`.
std::vector<std::vector<LevelInTime>> levels_in_time(const std::vector<PartInertia>& inertia, double h);

/// Parts and degrees of freedom of eq. (1) for time steps of size `h`, without the internal levels; `motion`: of the
/// pairs, per part (ContactSystem::motion). It has no loads.
Structure structure_in_time(const Structure& structure, const model::Model& model,
                            const std::vector<PartInertia>& inertia,
                            const std::vector<std::vector<LevelInTime>>& levels,
                            const std::vector<Eigen::SparseMatrix<double>>& motion, double h, int threads);

}  // namespace scabo::system
