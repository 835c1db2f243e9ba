// All bodies with their supports, springs and loads.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "scabo/element/cell_library.hpp"
#include "scabo/element/facet/radial_load.hpp"
#include "scabo/element/plane/initial_stress.hpp"
#include "scabo/system/bars.hpp"
#include "scabo/system/body_system.hpp"
#include "scabo/system/dofs.hpp"
#include "scabo/system/ranks.hpp"
#include "scabo/system/springs.hpp"
#include "scabo/system/thermal_energy.hpp"

namespace scabo::system {

/// Pressure of a fluid that enters a contact where it opens: of every pair of its interface, at factor 1.
struct EnteringPressure {
  int contact = -1;
  Vector forces;
};

struct Structure {
  Dofs dofs;
  std::vector<std::unique_ptr<BodySystem>> parts;  ///< one for each part of `dofs`
  ModelSprings springs;                            ///< those of the parts, spring by spring
  /// One for each of the model, then the points of supports that begin or end in steps (held_points.hpp).
  std::vector<BarSystem> bars;
  /// [load][part]: generalised forces at factor 1; empty where the load does not act on the part. Of loads that move
  /// see forces_of_moving_load().
  std::vector<std::vector<Vector>> loads;
  /// [load][part]: sum of arm . force of a load at factor 1 on a rigid body, arms from its reference point: force times
  /// length, by which the moment of the load changes with a rotation of the body. 0 of elastic parts.
  std::vector<std::vector<double>> outward;
  /// [load][body][cell]: loads inside the cells, at factor 1; empty where the load does not act inside the body.
  std::vector<std::vector<element::CellLoads>> interior;
  /// [load][body]: stress before the body deforms, at factor 1; zero where the load is none.
  std::vector<std::vector<element::InitialStress>> initial;
  std::vector<ThermalEnergy> thermal;  ///< one for each part; empty if no temperature changes
  /// [load][contact]: sum of the forces of pore pressure in the contact, at factor 1; empty where the load is none.
  std::vector<std::vector<std::optional<double>>> pores;
  /// [load]: fluids that enter contacts, which are not in `loads`: on which pairs they act is a part of the state.
  std::vector<std::vector<EnteringPressure>> entering;
  /// [load][body]: as `loads`, but apart for bodies that are tied, at the degrees of freedom of each; of pore pressure
  /// only what acts on the cells at the tips of cracks. Only if the history has edges (model::EdgeResultant).
  std::vector<std::vector<Vector>> of_bodies;
  double assembly_seconds = 0.0;  ///< of `make_structure`, for its stiffness matrices
};

/// Constraints of every part, from the supports of the model that last. Throws InputError for supports that contradict
/// each other.
std::vector<std::vector<Constraint>> constraints_of(const model::Model& model, const mesh::Mesh& mesh,
                                                    const Dofs& dofs);
/// What supports that begin or end in steps hold, of every part, where no other support holds it at all these times.
std::vector<std::vector<Constraint>> staged_constraints_of(const model::Model& model, const mesh::Mesh& mesh,
                                                           const Dofs& dofs);
/// What one support holds, whatever others do.
std::vector<std::vector<Constraint>> constraints_of_support(const model::Model& model, const mesh::Mesh& mesh,
                                                            const Dofs& dofs, std::size_t support);

/// Throws InputError for bodies and parts that are held neither by supports nor by springs nor by contact pairs.
void check_supports(const model::Model& model, const mesh::Mesh& mesh);

/// Factorises every part, on up to `threads` threads. `cells[body]`: its solved super-elements. `ranks`: the other
/// processes of the run, or null. `before`: on another mesh; elastic parts that are the same to the last bit keep their
/// factors. `like`: on a mesh that differs little, whose factors may serve for this one, or null.
Structure make_structure(const model::Model& model, const mesh::Mesh& mesh,
                         const std::vector<element::SolvedCells>& cells, int threads = 1, Ranks* ranks = nullptr,
                         const Structure* before = nullptr, const Structure* like = nullptr);

/// Adds the loads to a structure (apply_loads.cpp).
void add_loads(Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
               const std::vector<element::SolvedCells>& cells);

/// Generalised forces of a load that moves, at factor 1 and a time, as one of Structure::loads. There it stands in the
/// middle of its edge, for its size.
std::vector<Vector> forces_of_moving_load(const Structure& structure, const model::Model& model, const mesh::Mesh& mesh,
                                          const std::vector<element::SolvedCells>& cells, std::size_t load,
                                          double time);

/// Points of a rigid body that belong to a place.
std::vector<Vec2> rigid_points(const model::Place& place, const model::Body& body);

/// Half the diagonal of the box around an outline: L of a rigid body, whose motions are about its centroid.
double half_size(const model::Outline& outline);

}  // namespace scabo::system
