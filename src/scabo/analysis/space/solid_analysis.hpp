// Static analysis of elastic and rigid bodies in space with frictional contact and ties between faces that do not
// match.
//
// Bodies are tetrahedra as finite elements, hexahedra and wedges as super-elements, or rigid (system/rigid_solid.hpp).
// Every contact gives pairs (mesh/space/facet_pairs.hpp); the bodies are condensed to them, and an increment is one
// contact problem (contact/problem.hpp) in which q holds the gaps, the motion under loads and supports, and less the
// slip so far. Small displacements and rotations.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/state/results.hpp"
#include "scabo/analysis/state/solution.hpp"
#include "scabo/base/warning.hpp"
#include "scabo/contact/certificate.hpp"
#include "scabo/contact/laws/evolution.hpp"
#include "scabo/contact/solution.hpp"
#include "scabo/element/space/solid_cell.hpp"
#include "scabo/mesh/space/facet_pairs.hpp"
#include "scabo/model/contact.hpp"
#include "scabo/model/solid_model.hpp"
#include "scabo/model/stay.hpp"
#include "scabo/system/contact_system.hpp"
#include "scabo/system/solid_cut.hpp"
#include "scabo/system/solid_springs.hpp"

namespace scabo::analysis {

struct SolidBody {
  mesh::SolidMesh mesh;
  double young = 0.0, poisson = 0.0;              ///< force / length^2, > 0; -1 < poisson < 1/2
  std::vector<system::Constraint> supports = {};  ///< `support`: which factor they have
  double expansion = 0.0;                         ///< strain per change of temperature
  /// It does not deform; `supports` are system::held_motion of this point.
  std::optional<Eigen::Vector3d> rigid_at = {};
  std::string name = {};               ///< in messages
  element::SuperElements solved = {};  ///< of an elastic body
  model::Stay stay = {};
};

/// The body with its super-elements solved.
SolidBody with_super_elements(SolidBody body, int threads = 1);

/// Two faces of different bodies.
struct SolidContact {
  struct Side {
    int body = -1;
    std::vector<mesh::SolidFacet> facets;
  };
  Side a, b;
  model::Contact law;  ///< without directions of friction, and without friction that varies along the contact
  double gap = 0.0;    ///< added to that of the meshes; negative: an interference
  std::optional<model::SpaceFrictionAxes> friction_axes = {};
};

/// A bar between two points of bodies or the ground, as system::BarSystem: a pair that pulls and pushes alike.
struct SolidBar {
  system::PairSide a, b;
  Eigen::Vector3d direction;  ///< of length 1, from a to b
  double softness = 0.0;      ///< elongation per tension
  double preload = 0.0;       ///< tension when it is tightened; 0: it acts from the start
  model::Stay stay = {};      ///< steps in which its stiffness acts: those after the one in which it is tightened

  /// What a tension adds to the forces on the nodes of all bodies.
  void pull(double tension, std::vector<Vector>& forces) const;
};

/// A bolt that is tightened. Supports do not hold both of its parts along the normal of the cut.
struct SolidPreload {
  int body = -1;
  system::SolidCut cut;
  std::optional<double> force;  ///< tension when it is tightened; none: `shortening` is given
  double shortening = 0.0;
};

/// Springs between a body and the ground; without force at its displacement times the factor of a load, or at 0.
struct SolidSpringOfBody {
  int body = -1;
  system::SolidSpring spring;
  int load = -1;  ///< index into SolidModel::loads: its forces on a body that stays
};

/// What a support that begins or ends in a step holds: a node of an elastic body along a direction, or a motion of a
/// rigid one. It is a pair of the contact system whose other side is the ground, as a held point of the plane
/// (system/held_points.hpp).
struct SolidHeldPoint {
  int body = -1;
  system::Constraint held;
  model::Stay stay;
};

struct SolidModel {
  std::vector<SolidBody> bodies;
  std::vector<SolidContact> contacts;
  std::vector<std::vector<Vector>> loads;  ///< [load][body]: nodal forces at factor 1; empty where there are none
  /// [load][body]: of a change of temperature, that of the nodes at factor 1; empty where there is none. `loads` has
  /// its forces. As long as `loads`, or empty.
  std::vector<std::vector<Vector>> temperatures = {};
  /// [load][body]: force per volume at factor 1, which `loads` has too: fields inside super-elements depend on it. As
  /// long as `loads`, or empty.
  std::vector<std::vector<Eigen::Vector3d>> per_volume = {};
  std::vector<SolidPreload> preloads = {};
  std::vector<SolidSpringOfBody> springs = {};
  std::vector<SolidBar> bars = {};
  std::vector<SolidHeldPoint> held_points = {};

  /// Whether bodies or supports are put in place or taken away in steps.
  bool has_stages() const;
};

/// Factors of loads, supports and interferences at the end of an increment.
struct SolidFactors {
  Vector loads, supports;
  /// Coefficients of friction and lasting cohesions (model::coefficients_of); empty: those of the contacts.
  Vector coefficients = Vector();
  /// For each contact the part of the negative gaps of its pairs that is there, 0 to 1; empty: all of them.
  Vector fits = Vector();
  /// For each preload the part of it that is there, 0 to 1. One with a force has this part of it in increments in which
  /// the factor grows; in all others its shortening stays. Empty: none of them.
  Vector tightened = Vector();
  /// For each bar with preload the part of it that is there, 0 to 1; its stiffness acts in the increments after the one
  /// in which that is 1. Empty: there are no bars.
  Vector bars = Vector();
  // Staged construction (solid_stages.hpp):
  int step = 0;                ///< to which the increment belongs
  Vector presence = Vector();  ///< for each body the part of its loads that acts, 0 to 1; empty: all of them
  double release = 0.0;        ///< part of SolidState::released that acts

  /// Part of its loads that acts on a body.
  double presence_of(std::size_t body) const {
    return presence.size() > 0 ? presence[static_cast<Eigen::Index>(body)] : 1.0;
  }
};

/// A pair in a solution; vectors along the axes.
struct SolidPair {
  int contact = -1;
  int corner = -1;                                  ///< the node it stands for
  bool on_a = false;                                ///< whether that is one of side a
  Eigen::Vector3d point, normal;                    ///< the normal out of side a towards b
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< on side b
  Eigen::Vector3d slip = Eigen::Vector3d::Zero();   ///< of b relative to a, since the first increment
  double area = 0.0, gap = 0.0;
  contact::ContactState state = contact::ContactState::open;
  bool broken = false;  ///< it has lost its cohesion

  double normal_force() const { return force.dot(normal); }  ///< compression positive
};

struct SolidTension {
  double force = 0.0, shortening = 0.0;  ///< in the cut of a preload; tension positive
};

/// Of a body without deformation: u(x) = shift + rotation x (x - about).
struct SolidBodyMotion {
  Eigen::Vector3d about = Eigen::Vector3d::Zero(), shift = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
  double largest = 0.0, size = 0.0;  ///< largest displacement of a node, largest distance from `about`; length

  /// Whether it is more than rounding beside the largest displacement of all bodies, which is 1.
  bool moves() const { return largest > 1e-4; }
  /// The point nearest to `about` of the axis about which the body turns; none: it does not turn.
  std::optional<Eigen::Vector3d> axis() const;
  Eigen::Vector3d at(const Eigen::Vector3d& x) const { return shift + rotation.cross(x - about); }
};

/// How bodies begin to move where no forces balance the loads, as Mechanism in the plane: the largest displacement
/// is 1.
struct SolidMechanism {
  FlowRule rule = FlowRule::coulomb;
  std::vector<SolidBodyMotion> bodies;  ///< one for each of the model
  std::vector<int> bolts;               ///< bodies whose preload shortens without end
  std::vector<SolidPair> pairs;         ///< gap and slip are the motion of the pair; without forces
  double work = 0.0;                    ///< of the loads, force times length
  Vector motion;                        ///< as amplitudes of the contact problem
  std::vector<char> absent = {};        ///< [body], whether it is not there; empty: all are

  bool is_absent(std::size_t body) const { return !absent.empty() && absent[body] != 0; }
  /// Number of bodies that are there.
  std::ptrdiff_t present() const {
    return static_cast<std::ptrdiff_t>(bodies.size()) -
           std::count_if(absent.begin(), absent.end(), [](char is) { return is != 0; });
  }
};

struct SolidIncrement {
  SolidFactors factors;
  contact::Status status = contact::Status::not_converged;
  std::string reason;             ///< why it is not solved
  std::vector<char> absent;       ///< [body], whether it is not there; empty: all are
  std::vector<Vector> u;          ///< [body], three numbers for each node; 0 of one that is absent
  std::vector<Vector> reactions;  ///< [body], of its constraints
  Vector held;                    ///< reactions of the held points
  std::vector<Vector> heated;     ///< [body], change of temperature of the nodes; empty: none
  std::vector<SolidPair> pairs;   ///< between bodies that are there
  /// Of each contact: moments about the origin of its forces at the nodes of side a and of side b.
  std::vector<std::array<Eigen::Vector3d, 2>> moments_of_sides;
  std::vector<SolidTension> tensions;    ///< of each preload
  std::vector<double> bars;              ///< tension of each
  std::vector<Eigen::Vector3d> springs;  ///< of each, what they exert on their body
  contact::Certificate certificate;
  Energy energy;
  int iterations = 0;
  std::optional<SolidMechanism> mechanism;     ///< of a mechanism or collapse
  std::optional<UniquenessResult> uniqueness;  ///< if requested
  std::vector<Warning> warnings;               ///< that no increment before it has given

  bool is_absent(std::size_t body) const { return !absent.empty() && absent[body] != 0; }
};

/// All that the next increment depends on. Displacements follow from the factors, the contact forces and the motions.
struct SolidState {
  SolidFactors factors;  ///< empty before the first increment
  Vector slip, gap;      ///< of each pair that moves, the former so far, two numbers
  Vector p, a;           ///< contact forces, rigid motions
  Vector shortening;     ///< of each preload
  std::vector<contact::ContactState> states;
  contact::History history;
  double force_scale = 0.0;  ///< largest force so far
  Energy energy;
  // Staged construction (solid_stages.hpp); empty without stages:
  Vector offset;                 ///< of each pair that moves, three numbers: added to its motion, from its placing on
  Vector held_offset;            ///< the same of pairs that supports hold
  std::vector<Vector> released;  ///< [body], what removed bodies exerted on it; empty where nothing did
  Vector released_points;        ///< of each held point, its reaction when it ended
};

struct PreparedSolids;  // prepared_solids.hpp

struct SolidOptions {
  double tolerance = 1e-10;  ///< of the certificate
  int threads = 1;
  bool uniqueness = false;           ///< whether other solutions are searched for
  std::size_t first = 0;             ///< of the increments, those before it are done,
  const SolidState* from = nullptr;  ///< and this is the state after them; null: nothing is done
  /// Of an analysis that nothing is done of: the state from which it starts. Without it, that at rest.
  std::function<SolidState(const PreparedSolids&)> start;
  /// Told of the state after the last increment, if all are solved.
  std::function<void(const PreparedSolids&, const SolidState&)> on_end;
  /// Told of every increment as soon as it is known, with the state after it, which an unsolved one does not change.
  std::function<void(const SolidIncrement&, const SolidState&)> on_increment;
};

/// What acts inside the cells of an elastic body after an increment.
element::InsideCells inside_cells_of(const SolidModel& model, const SolidIncrement& increment, std::size_t body);

/// Number of pairs of every contact.
std::vector<int> count_pairs(const SolidModel& model);

/// Solves the increments from `first`, in their order; one that is not solved ends the analysis. None of them is kept.
/// Contacts have faces for which mesh::why_no_pairs gives no reason.
void solve_solids(const SolidModel& model, const std::vector<SolidFactors>& increments, const SolidOptions& options);

}  // namespace scabo::analysis
