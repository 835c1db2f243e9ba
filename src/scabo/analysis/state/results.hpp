// Results of one increment: plain values. No files are written here (result/).
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scabo/contact/solution.hpp"
#include "scabo/element/cell_library.hpp"
#include "scabo/element/plane/initial_stress.hpp"

namespace scabo::analysis {

/// Results of a contact pair after an increment. Pairs are numbered from 1 along their contact.
struct PairResult {
  int pair = 0;
  Vec2 position = Vec2::Zero();   ///< on A, undeformed; with large slip where A has moved when the pair was found
  Vec2 normal = Vec2::Zero();     ///< n, unit, out of A
  double gap = 0.0;               ///< length, > 0 if open
  double slip = 0.0;              ///< length: motion of B relative to A along t since the start
  double normal_force = 0.0;      ///< on B along n; compression is positive
  double tangential_force = 0.0;  ///< on B along t
  double pressure = 0.0;          ///< force / length^2: normal force over tributary length and thickness
  double shear = 0.0;             ///< force / length^2, on B along t
  contact::ContactState state = contact::ContactState::open;
  Vec2 displacement_a = Vec2::Zero();  ///< of the point on A, in [n, t]; from where the pair was found
  Vec2 displacement_b = Vec2::Zero();  ///< of the point on B, in [n, t]; from where the pair was found
};

struct ContactResult {
  std::string name;
  std::vector<PairResult> pairs;
  double normal_force = 0.0;               ///< sum over the pairs
  double tangential_force = 0.0;           ///< sum over the pairs
  Vec2 force = Vec2::Zero();               ///< resultant on B
  double moment = 0.0;                     ///< of the forces on B about the contact's `about`, counter-clockwise
  std::optional<Vec2> centre_of_pressure;  ///< mean position of the pairs, weighted by their normal forces, if positive
  /// Sum over all pairs of the forces of pore pressure along n, on B; empty if none acts. Normal forces of the pairs
  /// are effective ones, and the total is the sum.
  std::optional<double> pore_force;
  int open = 0, stick = 0, slip = 0;
  std::optional<int> broken;  ///< pairs that lost cohesion and tensile strength; empty if the contact has none
  double max_gap = 0.0;       ///< of the open pairs; 0 if none is open
  double min_gap = std::numeric_limits<double>::infinity();  ///< of all pairs; infinite without pairs
  double max_pressure = 0.0;
  std::optional<int> first_in_contact, last_in_contact;  ///< pair numbers; empty if all pairs are open
};

/// Work since the start, force times length. In time
///
///     kinetic + elastic + friction + damping + impact + projection + massless = external
struct Energy {
  /// Of loads and of reactions at prescribed displacements; with the kinetic energy of initial velocities.
  double external = 0.0;
  double elastic = 0.0;   ///< stored in bodies and springs
  double friction = 0.0;  ///< dissipated
  /// `friction`, and `external` with it, are known to +- this: pairs began or ended to slip within increments in which
  /// their pressure changed.
  double friction_error = 0.0;
  // In time:
  double kinetic = 0.0;
  double damping = 0.0;     ///< dissipated
  double impact = 0.0;      ///< taken by normal impulses; negative where they gave some
  double projection = 0.0;  ///< taken by removing overlaps; negative where that gave some
  double massless = 0.0;    ///< lost by parts without mass, which have no oscillations
};

/// A crack, or a corner at a scaling centre, after an increment.
struct CrackResult {
  std::string name;  ///< `body.crack`, or `body.corner`
  element::StressIntensity factors;
  bool held = false;  ///< a support holds one of its faces, so that its stress is not that of free faces
};

/// What acts on a body through one of its edges (edge_forces.hpp).
struct EdgeForces {
  Vec2 force = Vec2::Zero();  ///< on the body
  double moment = 0.0;        ///< counter-clockwise
};

/// Convergence history of the contact solver in one attempt at an increment, or at a part of it if it was halved.
struct AttemptResult {
  std::vector<contact::Iteration> iterations;
  bool accepted = false;
};

/// Estimated discretisation error in the energy norm |u| = sqrt(u'K u) (element/plane/two_orders.hpp).
struct BodyError {
  double absolute = 0.0;  ///< sqrt(force times length)
  double relative = 0.0;  ///< relative to the norm of the displacement of the whole model
};

struct ErrorEstimate {
  double relative = 0.0;                         ///< of the whole model
  std::vector<std::optional<BodyError>> bodies;  ///< empty for rigid and finite element bodies
};

/// Information on other solutions of an increment (contact/questions/uniqueness.hpp), for `solver: {uniqueness: true}`.
struct UniquenessResult {
  std::string verdict;    ///< `proven`, `several found`, `not decided`
  int others = 0;         ///< other solutions found
  bool complete = false;  ///< there are no other solutions than those found
  double bound = 0.0;     ///< below 1: proven; infinite where the condition does not apply
  int index = 0;          ///< sign of det H'; 0: on a kink or not computed
};

/// What the fields of all bodies at one time follow from (result/).
struct FieldState {
  /// Per body: 2 per node; for a rigid body [u_x, u_y, rotation] about its centroid. For an unbounded body they are
  /// those of its stiffness (element/plane/stiffness.hpp, eq. 6), because a translation would change its forces.
  std::vector<Vector> displacements;
  /// Per body, as the displacements; empty: not in time.
  std::vector<Vector> velocities;
  /// Per body: displacement of the reference point to which it belongs (analysis/state/outside.hpp), or zero; empty:
  /// there is none. Displacements shown in results are relative to it; those of contact pairs (PairResult) are already
  /// relative.
  std::vector<Vec2> reference_displacements;
  std::vector<element::CellLoads> interior;  ///< [body][cell]: loads inside; empty for a body without any
  /// Per body: stress that it has without any displacement; empty: none has any.
  std::vector<element::InitialStress> initial;

  const element::InitialStress& initial_of(std::size_t body) const;
  Vec2 reference_displacement(std::size_t body) const {
    return reference_displacements.empty() ? Vec2(Vec2::Zero()) : reference_displacements[body];
  }
};

/// A number with its error bar (goal.hpp).
struct QuantityResult {
  std::string of;                ///< its name, model::Quantity::name
  double value = 0.0;            ///< on the mesh of the results
  double bar = 0.0;              ///< the exact value is expected within value - bar and value + bar
  double finer = 0.0;            ///< on the finest mesh from which the bar was computed
  std::optional<double> wanted;  ///< largest bar that is wanted, relative to the value

  double relative() const;  ///< bar / |value|; infinite of a value of 0
  bool reached() const { return !wanted || relative() <= *wanted; }
};

/// Pairs that were found anew within an increment (large_slip.hpp).
struct PairsFound {
  int times = 0;
  double jump = 0.0;  ///< largest change of the force of a contact by it, relative to the force before
};

/// A tip that may grow, in the state in which the leading one is critical.
struct TipResult {
  std::string name;              ///< `plate.flaw.end`
  Vec2 position = Vec2::Zero();  ///< undeformed
  double length = 0.0;           ///< of its crack
  double opening = 0.0;          ///< the largest one of its crack, along the normal of the faces, length
  double K_I = 0.0, K_II = 0.0;  ///< force / length^(3/2)
  std::optional<double> T, G;
  double kink = 0.0;            ///< counter-clockwise from the direction of the crack, radians
  double load_factor = 0.0;     ///< at which it would be critical
  bool grows = false;           ///< in the step that follows
  std::optional<double> range;  ///< under cycles of load: Delta K of the equivalent factor
  std::optional<Vec2> meets;    ///< where it ends in the step that follows, while others go on
};

/// Of the growth between two states on the mesh of the second, force times length. First the crack, whose new part is
/// closed, opens under the load and the pair forces of the first, then these become those of the second: external =
/// elastic + contact + released.
struct GrowthEnergy {
  double external = 0.0;  ///< work of loads, and of supports that move
  double elastic = 0.0;   ///< by which the stored energy becomes larger
  double contact = 0.0;   ///< taken by contact pairs: mean forces times changes of gap and slip
  double released = 0.0;  ///< by which growth under the load of the first state makes the potential energy smaller
  double integral = 0.0;  ///< of G over the growth of all tips under that load: what is released, from the factors
  /// By which the potential energy of the first state becomes smaller on the mesh of the second, its tips where they
  /// were; not in `external` and `elastic`.
  double remeshing = 0.0;
};

/// Where cracks stand in an increment of a step in which they grow.
struct GrowthResult {
  double load_factor = 0.0;      ///< lambda, at which the leading tip is critical; 1 under cycles of load
  std::optional<double> cycles;  ///< of load so far
  // Of growth under a load, force times length: what the scaled loads and the scaled supports would work at factor 1.
  std::optional<double>
      displacement;  ///< forces of the loads on the displacements of the state; none without such loads
  std::optional<double>
      reaction;  ///< reactions of the state on the prescribed displacements; none without such supports
  std::optional<GrowthEnergy> energy;  ///< of the growth since the state before; none under cycles of load
  std::vector<TipResult> tips;         ///< in the order of bodies and cracks, the start of a crack before its end
};

struct IncrementResult {
  int step = 0;  ///< from 1
  std::string step_name;
  int increment = 0;                      ///< from 1 within the step
  double reached = 1.0;                   ///< part of the step at its end, more than 0, 1 in its last increment
  std::optional<double> time;             ///< since the begin of the first step in time; empty: not in time
  std::map<std::string, double> factors;  ///< factors of loads and of supports with prescribed displacements
  bool converged = false;
  int newton_iterations = 0;
  /// On the problems of fewer pairs from which the start was computed (contact/newton/coarse_start.hpp); not counted
  /// above.
  int coarse_iterations = 0;
  int halvings = 0;                       ///< number of times that the increment was halved
  std::optional<PairsFound> pairs_found;  ///< of a model with large slip
  double residual = 0.0;
  std::vector<ContactResult> contacts;
  std::vector<Vec2> reactions;  ///< one for each support of the model, in its order: force on the body
  bool is_absent(int body) const;
  /// One for each support of the model: moment on the body about the point of a support that prescribes a rotation.
  std::vector<std::optional<double>> moments;
  std::vector<EdgeForces> edges;  ///< one for each model::EdgeResultant of the history, in its order
  std::vector<Vec2> springs;      ///< one for each of the model, in its order: force on the body
  std::vector<double> bars;       ///< tension of each of the model, in its order; pressure is negative
  std::vector<int> absent;        ///< bodies that are not there: not yet added, or removed; ascending
  /// Largest applied force, contact force or reaction at a node or pair: the scale for judging other forces. Where all
  /// of these are rounding, the forces by which the stiffness would resist displacements as large.
  double largest_force = 0.0;
  contact::Certificate certificate;
  double lost_to_rounding = 0.0;  ///< estimated relative error of displacements, of the rounding of stiffness
  Energy energy;
  std::optional<ErrorEstimate> error;      ///< if requested
  std::vector<QuantityResult> quantities;  ///< numbers with an error bar, if requested
  FieldState fields;
  std::vector<CrackResult> cracks;             ///< of all bounded open super-elements
  std::optional<GrowthResult> growth;          ///< of a step in which cracks grow
  std::string reason;                          ///< why it did not converge
  std::optional<UniquenessResult> uniqueness;  ///< if requested
  std::vector<AttemptResult> attempts;         ///< one, or more if the increment was halved
};

/// Velocities in the place of displacements, and nothing else: what gives the displacement of a point gives its
/// velocity. They are 0 before the first step in time.
IncrementResult with_velocities(const IncrementResult& increment);

}  // namespace scabo::analysis
