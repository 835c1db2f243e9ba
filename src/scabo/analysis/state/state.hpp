// What increments on one mesh see of it, and the state between two of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/analysis/state/results.hpp"
#include "scabo/system/contact_system.hpp"

namespace scabo::analysis {

using OnIteration = std::function<void(const contact::Iteration&)>;

/// What increments see: a discretisation, and what of it is there at a stage of construction (stages.hpp).
struct Prepared {
  /// All parts of a discretisation with its systems, which outlives this.
  explicit Prepared(const Discretisation& of, OnIteration told = {}) : Prepared(of, *of.pairs, std::move(told), {}) {}
  /// The parts that are there, and the pairs between them.
  Prepared(const Discretisation& of, const system::ContactSystem& pairs, OnIteration told, std::vector<char> missing)
      : discretisation(of), contact(pairs), on_iteration(std::move(told)), absent(std::move(missing)) {}
  /// The same parts and pairs by other systems, without reference points (dynamics/time_step.hpp).
  Prepared(const Prepared& of, const system::Structure& by, const system::ContactSystem& pairs)
      : discretisation(of.discretisation),
        structure(by),
        contact(pairs),
        references(none),
        on_iteration(of.on_iteration),
        absent(of.absent) {}

  const Discretisation& discretisation;
  const model::Model& model = discretisation.model;
  const mesh::Mesh& mesh = discretisation.mesh;
  const system::Structure& structure = *discretisation.structure;
  const system::ContactSystem& contact;
  double force_scale = discretisation.force_scale;
  const std::vector<Reference>& references = discretisation.references;
  OnIteration on_iteration;  ///< Options::on_iteration
  std::vector<char> absent;  ///< per part: not there at this stage; empty: all are there
  static inline const std::vector<Reference> none;

  bool is_absent(std::size_t part) const { return !absent.empty() && absent[part] != 0; }
};

/// Of a contact, not of a bar.
const mesh::ContactPair& mesh_pair(const Prepared& prepared, const system::ContactSystem::Pair& at);
/// Whether a pair is a point of a support that begins or ends in a step (system/held_points.hpp).
bool is_held_point(const Prepared& prepared, const system::ContactSystem::Pair& at);
/// n of a pair: of a bar its direction.
Vec2 normal_of(const Prepared& prepared, const system::ContactSystem::Pair& at);
/// The part that a body belongs to.
const system::BodySystem& part_of(const Prepared& prepared, int body);

/// Displacement of a reference point: the results of its bodies are relative to it, and so are the work of their loads
/// and the elastic energy. `u`: per part.
Vec2 displacement_of(const Reference& reference, const Prepared& prepared, const std::vector<Vector>& u);

/// Factors of loads and supports at one time, and coefficients of friction.
struct Factors {
  std::vector<double> loads, supports;
  std::vector<double> friction;  ///< of every contact, forward, then backward; empty if no step changes one
  // Staged construction (stages.hpp):
  std::vector<double> presence = {};  ///< per body, part of its loads that acts, 0 to 1; empty: all of all
  double release = 0.0;               ///< part of State::released that acts
  std::vector<double> fits = {};      ///< per contact, part of its interferences that is there; empty: all of all
  std::vector<double> preloads = {};  ///< per bar, part of its preload that acts; empty: no bar has any
  double time = 0.0;                  ///< since the begin of the first step in time, of loads that move
  std::vector<double> entered = {};   ///< per pair, 1 where fluids have entered, else 0; empty: no fluid does
};
/// Part of its loads that acts on part `p`, 0 to 1.
double presence_of(const Prepared& prepared, const Factors& factors, std::size_t p);
Factors between(const Factors& from, const Factors& to, double part);
/// Initial gap of pair `i`, of which an interference is there in part; of a held point minus its displacement.
double gap_at(const Prepared& prepared, const Factors& factors, Eigen::Index i);
/// Factors::fits at the end of a step; step -1: before the first.
std::vector<double> fits_at(const model::Model& model, int step);
/// Factors::preloads at the end of a step; step -1: before the first.
std::vector<double> preloads_at(const model::Model& model, int step);
/// Coefficients of friction before the first step; empty if no step changes one.
std::vector<double> coefficients_at_start(const model::Model& model);

/// How the motions of pairs are counted since they were found anew (large_slip.hpp). All empty before that.
struct Replacing {
  mesh::Placement placement;  ///< in which they were found
  std::vector<Vec2> moved;    ///< per part: translation that State::u does not contain; zero on springs and unbounded
  Vector offset;              ///< 2N, [n, t]: part of the relative motions that is not in State::u
  Vector slip_before;         ///< N: slip up to then, not in State::slip
};

/// An accepted state, which is the history from which the next increment starts. It is a value: an increment that fails
/// does not change it.
struct State {
  Factors factors;
  Vector p;                  // 2N, contact forces on B
  Vector rigid_motion;       // m, amplitudes of the rigid motions of all parts
  Vector gap, slip;          // N; slip since the start
  contact::History history;  // N, of the laws
  std::vector<contact::ContactState> states;
  std::vector<Vector> u;           // per part
  std::vector<Vector> forces;      // per part: applied forces without contact
  std::vector<Vector> reactions;   // per part, one for each constraint
  std::vector<Vector> prescribed;  // per part, one for each constraint
  // Staged construction (stages.hpp); empty without stages:
  Vector offset;                 // 2N, [n, t]: added to the motion of a pair, which counts from its placing
  Vector held_offset;            // the same of held pairs
  std::vector<Vector> released;  // per part, what removed bodies and supports exerted on it; empty where nothing did
  /// Of these, per support: [F_x, F_y, moment] of what it exerted; empty if none is removed.
  std::vector<double> released_reactions;
  std::vector<Vec2> referred;  // per part, displacement of its reference point (outside.hpp) when it was put in place
  double largest_force = 0.0;  ///< largest force so far, against which forces are judged after failure and unloading
  Energy energy;
  Replacing replaced;
  // In time (dynamics/scheme.hpp); no velocities before the first time step:
  double time = 0.0;             ///< since the begin of the first step in time
  std::vector<Vector> velocity;  ///< per part, as u
  /// Per part: w of the internal levels of its bodies, one after another, and its velocity
  /// (system/internal_levels.hpp).
  std::vector<Vector> internal, internal_velocity;
  double largest_energy = 0.0;  ///< largest kinetic and elastic energy so far, against which errors are judged
};
State initial_state(const Prepared& prepared);

/// Laws of the pairs with the coefficients of friction of these factors.
contact::JointLaws laws_at(const Prepared& prepared, const Factors& factors);

/// Completes a state of which only the history is known (factors, forces and states of the pairs, rigid motions,
/// energy): displacements, applied forces, reactions and prescribed values follow from it, bit by bit as when the state
/// was reached. `without_motions`: displacements_without_motions() of the state, if they are known.
void complete(const Prepared& prepared, State& state, const std::vector<Vector>* without_motions = nullptr);

/// Displacement since the start, along x and y, of the point of a pair that belongs to side 0 (A) or 1 (B).
Vec2 displacement_of(const Prepared& prepared, const State& state, int contact, const mesh::ContactPair& pair,
                     int side);
/// Relative motion, B less A, along x and y, that a pair gets from the translations of its parts, less that of the
/// placement in which it was found.
Vec2 unplaced_motion(const Prepared& prepared, const Replacing& replaced, int contact);
/// Displacements of all parts under the loads, prescribed displacements and contact forces of a state, without rigid
/// motions.
std::vector<Vector> displacements_without_motions(const Prepared& prepared, const State& state);

/// Pairs whose points lie on each other, or overlap, as the bodies are drawn.
std::vector<bool> touching_pairs(const Prepared& prepared);

/// Tension of every bar: what acts of its preload, and the force of its stiffness.
std::vector<double> tensions_of(const Prepared& prepared, const State& state);

/// Of every support that begins or ends [F_x, F_y, moment] of what its points exert; zero of all others.
std::vector<Eigen::Vector3d> reactions_of_held_points(const Prepared& prepared, const State& state);

/// The results of an accepted state.
IncrementResult describe(const Prepared& prepared, const State& state);

/// `body 'upper': translation along (1, 0)` for rigid motions `a`; of many bodies the four parts that move most, and
/// how many others.
std::string describe_motions(const Prepared& prepared, const Vector& a);

}  // namespace scabo::analysis
