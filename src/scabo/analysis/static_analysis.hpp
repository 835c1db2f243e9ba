// The steps of a static analysis: Model -> Mesh -> super-elements -> systems -> contact -> results of every increment.
// No files are written here (result/).
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scabo/contact/solution.hpp"
#include "scabo/element/cell_library.hpp"
#include "scabo/element/initial_stress.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/model/model.hpp"

namespace scabo::system {
class Ranks;  // ranks.hpp
}

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

/// Work since the start, force times length.
struct Energy {
  double external = 0.0;  ///< of loads and of reactions at prescribed displacements
  double elastic = 0.0;   ///< stored in bodies and springs
  double friction = 0.0;  ///< dissipated
  /// `friction`, and `external` with it, are known to +- this: pairs began or ended to slip within increments in which
  /// their pressure changed.
  double friction_error = 0.0;
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

/// Estimated discretisation error in the energy norm |u| = sqrt(u'K u) (element/two_orders.hpp).
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
  /// those of its stiffness (element/stiffness.hpp, eq. 6), because a translation would change its forces.
  std::vector<Vector> displacements;
  /// Per body: displacement of the reference point to which it belongs (analysis/outside.hpp), or zero; empty: there is
  /// none. Displacements shown in results are relative to it; those of contact pairs (PairResult) are already relative.
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

struct IncrementResult {
  int step = 0;  ///< from 1
  std::string step_name;
  int increment = 0;                      ///< from 1 within the step
  double reached = 1.0;                   ///< part of the step at its end, more than 0, 1 in its last increment
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
  std::string reason;                          ///< why it did not converge
  std::optional<UniquenessResult> uniqueness;  ///< if requested
  std::vector<AttemptResult> attempts;         ///< one, or more if the increment was halved
};

/// The discrete problem of one attempt, as a value that can be saved and solved separately (contact/files/fclib.hpp).
struct DiscreteProblem {
  contact::Problem problem;
  contact::Start start;  ///< the previous accepted state
  contact::Solution solution;
  bool accepted = false;
  double force_scale = 0.0;          ///< contact::SolverOptions::force_scale
  std::vector<int> contact_of_pair;  ///< index into Model::contacts, one for each pair of the problem
  std::vector<int> number_of_pair;   ///< PairResult::pair
};

/// Seconds.
struct Timing {
  double read = 0.0, mesh = 0.0, super_elements = 0.0, assemble = 0.0, factorise = 0.0, condense = 0.0, newton = 0.0,
         recover = 0.0, write = 0.0, total = 0.0;
};

/// One pass of refinement (adaptive.hpp).
struct RefinementPass {
  int dofs = 0;
  double error = 0.0;           ///< largest error of all increments
  int raised = 0, divided = 0;  ///< number of elements changed after it
};

/// mechanism: the loads of an increment exceed what supports, contact and friction can carry. This is proven and is not
/// a failure of the solver. collapse: the equilibria that the loads pass through end before the increment does, as
/// bodies then move on without any further load; that no other equilibrium exists elsewhere is not proven.
enum class Outcome { solved, not_converged, mechanism, collapse, interrupted };

/// Which rule the slip of a motion follows. coulomb: joints slide without opening, and friction opposes slip.
/// associated: joints that slide open by u_n = mu |u_t| or more, as the motion does that proves a mechanism.
enum class FlowRule { coulomb, associated };

/// Motion of a body without deformation, of a mechanism (Mechanism): its displacement is shift + rotation x (x -
/// about).
struct BodyMotion {
  Vec2 about = Vec2::Zero();  ///< a point of the plane
  Vec2 shift = Vec2::Zero();  ///< displacement of that point, length
  double rotation = 0.0;      ///< counter-clockwise, radians
  double largest = 0.0;       ///< largest displacement of any of its points, length
  double size = 0.0;          ///< half of that of the body, or of those that are tied to it, length
  bool present = true;        ///< the body is there (IncrementResult::absent)

  Vec2 at(const Vec2& x) const { return shift + rotation * Vec2(about.y() - x.y(), x.x() - about.x()); }
  /// The point that stays, if the body turns.
  std::optional<Vec2> centre() const;
  /// Whether it is more than rounding beside the largest displacement of all bodies, which is 1.
  bool moves() const { return largest > 1e-4; }
};

/// Motion of a pair of a mechanism: B relative to A.
struct PairMotion {
  int contact = 0;               ///< index into Model::contacts
  int pair = 0;                  ///< PairResult::pair
  Vec2 position = Vec2::Zero();  ///< of the point on A before any motion
  Vec2 normal = Vec2::Zero();    ///< n, unit, out of A
  double opening = 0.0;          ///< along n, length
  double slip = 0.0;             ///< along t, length
};

/// How bodies begin to move where an analysis ends as a mechanism or collapse (mechanism.hpp): a motion without
/// deformation, from where the bodies are at the start, of any size: its largest displacement is 1.
struct Mechanism {
  FlowRule rule = FlowRule::coulomb;
  std::vector<BodyMotion> bodies;  ///< one for each of the model; those at rest, and absent ones, have a zero motion
  std::vector<PairMotion> pairs;   ///< of all that can move, contact by contact
  double work = 0.0;               ///< of the loads over the motion, force times length
  Vector rigid;                    ///< the motion as amplitudes of the rigid motions of the contact problem

  int present() const;  ///< number of bodies that are there
  int moving() const;   ///< number of bodies that move
  /// Index of the body with the largest displacement; of equal ones the first.
  std::size_t most() const;
};

struct StaticSolution {
  model::Model model;
  mesh::Mesh mesh;
  std::vector<element::SolvedCells> cells;  ///< [body][cell]; null for finite elements
  /// Number of times that mesh and cells were replaced because pairs were found anew. Fields of increments before the
  /// last time are not kept.
  int pairings = 0;
  std::vector<IncrementResult> increments;  ///< converged increments, then at most one that is not
  std::vector<RefinementPass> passes;       ///< if the mesh was refined for a tolerance
  std::vector<Warning> warnings;
  Outcome outcome = Outcome::solved;
  std::string reason;                  ///< if not solved
  std::optional<Mechanism> mechanism;  ///< of outcomes mechanism and collapse
  int threads = 1;                     ///< of the analysis; worthwhile for its fields as well
  system::Ranks* ranks = nullptr;      ///< processes among which large bodies are divided; null: this one alone
  Timing timing;
};

/// An increment that is about to be computed.
struct IncrementBegin {
  int step = 0;  ///< from 1
  std::string step_name;
  int increment = 0;              ///< from 1 within the step
  std::optional<int> increments;  ///< of the step; empty if their size is automatic
};

/// Thrown by Options::on_iteration, on_stage or at an interruption point (base/interruption.hpp) to end the analysis:
/// it is then `interrupted`, and the finished increments are kept. `stop` must be set as well.
struct EndAtOnce {};

struct Prepared;  // increment.hpp
struct State;
struct Continuation;  // continuation.hpp
struct EndState;      // restart.hpp
struct RunState;

struct Options {
  /// false: displacements, loads inside cells and pairs are kept of the last converged increment only, so that memory
  /// hardly grows with the number of increments; `on_increment` sees those of every increment.
  bool keep_fields = true;
  int threads = 1;  ///< upper limit, for BLAS and for distinct super-elements
  /// Processes among which large bodies are divided; null: this one alone. Analyses on several meshes use only this
  /// one.
  system::Ranks* ranks = nullptr;
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: end after the current increment
  std::function<void(const StaticSolution&, const IncrementResult&)> on_increment;  ///< after each increment
  /// After each increment with contact pairs: the problems of its attempts, in the order of IncrementResult::attempts.
  std::function<void(const IncrementResult&, const std::vector<DiscreteProblem>&)> on_problems;
  /// After each converged increment, before `on_increment`: its accepted state.
  std::function<void(const Prepared&, const State&, const StaticSolution&)> on_state;
  /// After each converged increment and `on_increment`, of analyses that compute increments one after the other (not of
  /// those with an estimated error, whose increments are reported together at the end): all that the next increment
  /// starts from.
  std::function<void(const RunState&, const StaticSolution&)> on_accepted;
  /// After the last increment of an analysis that was solved, of the same ones as on_accepted: what another run may
  /// start from.
  std::function<void(const EndState&)> on_end;
  const Continuation* from = nullptr;                      ///< continues from there; only for such analyses
  std::function<void(const StaticSolution&)> on_mesh;      ///< when super-elements and systems are ready
  std::function<void(const std::string& stage)> on_stage;  ///< current stage, for display of progress
  /// Before each increment, and before `on_stage`. Not of analyses on several meshes, whose increments are reported
  /// together at the end.
  std::function<void(const IncrementBegin&)> on_increment_begin;
  /// Every iteration of the contact solver, within an increment; may throw EndAtOnce.
  std::function<void(const contact::Iteration&)> on_iteration;
};

/// Validates the model (model/validate.hpp), meshes it and checks, without solving anything, that every body is held
/// (not required for a modal analysis) and that every output point lies in a body. Throws InputError.
mesh::Mesh check(const model::Model& model);

/// Whether large bodies can be divided among ranks (Options::ranks); otherwise `why_no_ranks` says why not.
bool can_use_ranks(const model::Model& model);
inline constexpr const char* why_no_ranks =
    "modal analyses and those on several meshes (error bars, `tolerance`, `error`) are not divided among ranks";

/// Runs all steps. Throws InputError for models that cannot be analysed; an increment that does not converge is part of
/// the result.
StaticSolution solve_static(model::Model model, const Options& options = {});

/// The same on a given mesh, once: without refinement or error estimate.
StaticSolution solve_on_mesh(model::Model model, mesh::Mesh mesh, const Options& options);

}  // namespace scabo::analysis
