// The steps of a static analysis: Model -> Mesh -> super-elements -> systems -> contact -> results of every
// increment. Nothing is written to files here (result/).
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scabo/contact/solution.hpp"
#include "scabo/element/modal_solution.hpp"
#include "scabo/element/sectors.hpp"
#include "scabo/element/stress_intensity.hpp"
#include "scabo/mesh/mesh.hpp"
#include "scabo/model/model.hpp"

namespace scabo::analysis {

/// One pair of contact points after an increment. Numbered from 1 along its contact.
struct PairResult {
  int pair = 0;
  Vec2 position = Vec2::Zero();   ///< undeformed, on A
  Vec2 normal = Vec2::Zero();     ///< n, unit, out of A
  double gap = 0.0;               ///< length, > 0 open
  double slip = 0.0;              ///< length, since the start, of B relative to A along t
  double normal_force = 0.0;      ///< on B along n, >= 0: compression
  double tangential_force = 0.0;  ///< on B along t
  double pressure = 0.0;          ///< force / length^2, over the pair's tributary length
  double shear = 0.0;             ///< force / length^2, on B along t
  contact::ContactState state = contact::ContactState::open;
  Vec2 displacement_a = Vec2::Zero();  ///< of the point of A, along [n, t]
  Vec2 displacement_b = Vec2::Zero();  ///< of the point of B, along [n, t]
};

struct ContactResult {
  std::string name;
  std::vector<PairResult> pairs;
  double normal_force = 0.0;      ///< sum of the pairs' normal forces
  double tangential_force = 0.0;  ///< sum of the pairs' tangential forces
  int open = 0, stick = 0, slip = 0;
  std::optional<int> broken;  ///< pairs that lost cohesion and tensile strength; nothing where the contact has none
  double max_gap = 0.0;       ///< of the open pairs; 0 when none is open
  double max_pressure = 0.0;
  std::optional<int> first_in_contact, last_in_contact;  ///< pair numbers; nothing when all are open
};

/// Work since the start, force times length.
struct Energy {
  double external = 0.0;  ///< of loads and of reactions at prescribed displacements
  double elastic = 0.0;   ///< stored
  double friction = 0.0;  ///< dissipated
};

/// A crack, or a corner at a scaling centre, after an increment.
struct CrackResult {
  std::string name;  ///< `body.crack`, or `body.corner`
  element::StressIntensity factors;
};

/// How the contact solver went in one attempt at an increment, or at a part of it where it was halved.
struct AttemptResult {
  std::vector<contact::Iteration> iterations;
  bool accepted = false;
};

/// Estimated error of discretisation in the energy norm |u| = sqrt(u'K u) (element/two_orders.hpp).
struct BodyError {
  double absolute = 0.0;  ///< sqrt(force times length)
  double relative = 0.0;  ///< to the norm of the whole model's displacement
};

struct ErrorEstimate {
  double relative = 0.0;                         ///< of the whole model
  std::vector<std::optional<BodyError>> bodies;  ///< nothing for rigid and FE bodies
};

/// What is known of other solutions of an increment (contact/uniqueness.hpp), for `solver: {uniqueness: true}`.
struct UniquenessResult {
  std::string verdict;    ///< `proven`, `several found`, `not decided`
  int others = 0;         ///< other solutions found
  bool complete = false;  ///< there are no more
  double bound = 0.0;     ///< below 1: proven; infinite where the condition does not apply
  int index = 0;          ///< sign of det H'; 0: on a kink or not computed
};

struct IncrementResult {
  int step = 0;  ///< from 1
  std::string step_name;
  int increment = 0;                      ///< from 1 within the step
  std::map<std::string, double> factors;  ///< of loads and of supports with prescribed displacements
  bool converged = false;
  int newton_iterations = 0;
  int coarse_iterations =
      0;             ///< of problems of fewer pairs that made the start (contact/cold_start.hpp); not counted above
  int halvings = 0;  ///< how often the increment was halved
  double residual = 0.0;
  std::vector<ContactResult> contacts;
  std::vector<Vec2> reactions;  ///< one for each support of the model, in its order: force on the body
  double largest_force =
      0.0;  ///< at a node or a pair, applied, of contact or of a support: what others are small beside
  contact::Certificate certificate;
  double lost_to_rounding = 0.0;  ///< estimated relative error of displacements, of the rounding of stiffness
  Energy energy;
  std::optional<ErrorEstimate> error;  ///< when asked for
  /// Per body: 2 per node; of a rigid body [u_x, u_y, rotation] about its centroid. As the stiffness of a body that
  /// reaches to infinity knows them (element/stiffness.hpp, eq. 6): a translation would not leave its forces as they
  /// are.
  std::vector<Vector> displacements;
  /// Displacement of the point that is said to stand still (analysis/outside.hpp). Results show all displacements less
  /// this; those of the pairs above have it taken off already.
  Vec2 reference_displacement = Vec2::Zero();
  std::vector<element::InteriorLoads> interior;  ///< per body: what acts inside it
  std::vector<CrackResult> cracks;               ///< of all bounded open super-elements
  std::string reason;                            ///< why it did not converge
  std::optional<UniquenessResult> uniqueness;    ///< where asked for
  std::vector<AttemptResult> attempts;           ///< one; more where the increment was halved
};

/// The discrete problem of one attempt: a value that can be saved and solved alone (contact/fclib.hpp).
struct DiscreteProblem {
  contact::Problem problem;
  contact::Start start;  ///< the accepted state before
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

/// A super-element solved once for all bodies that are alike.
struct SolvedSuperElement {
  element::Ring ring;
  element::Sectors sectors;
  double thickness = 1.0;
  element::Domain domain;
  int threads = 1;  ///< for its modes
  element::SuperElementSolution solution;
  /// Modes for the interior, found when they are asked for first.
  const element::ModalSolution& modes() const;
  /// The same for the factors of its crack or corner; the ring must be open.
  const element::CornerAnalysis& corner() const;

 private:
  mutable std::unique_ptr<element::CornerAnalysis> corner_;
  mutable std::unique_ptr<element::ModalSolution> modes_;
};

/// One pass of refinement (adaptive.hpp).
struct RefinementPass {
  int dofs = 0;
  double error = 0.0;           ///< the largest of all increments
  int raised = 0, divided = 0;  ///< elements changed after it
};

/// mechanism: the loads of an increment are more than supports, contact and friction can carry, which is proven and no
/// failure of the solver.
enum class Outcome { solved, not_converged, mechanism, interrupted };

struct StaticSolution {
  model::Model model;
  mesh::Mesh mesh;
  std::vector<std::shared_ptr<const SolvedSuperElement>> super_elements;  ///< per body; null for rigid and FE bodies
  std::vector<IncrementResult> increments;  ///< converged ones, then at most one that is not
  std::vector<RefinementPass> passes;       ///< where the mesh was refined for a tolerance
  std::vector<std::string> warnings;
  Outcome outcome = Outcome::solved;
  std::string reason;  ///< when not solved
  Timing timing;
};

struct Options {
  int threads = 1;                          ///< at most: for BLAS and for super-elements that differ, where it pays
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: end after the current increment
  std::function<void(const StaticSolution&, const IncrementResult&)> on_increment;  ///< after each increment
  /// After each increment with contact pairs: the problems of its attempts, in the order of IncrementResult::attempts.
  std::function<void(const IncrementResult&, const std::vector<DiscreteProblem>&)> on_problems;
  std::function<void(const StaticSolution&)> on_mesh;      ///< once super-elements and systems stand
  std::function<void(const std::string& stage)> on_stage;  ///< what is being done, for progress
};

/// Meshes the model and looks whether every body is held (modal: it need not be) and every output point lies in one,
/// without solving anything. Throws InputError.
mesh::Mesh check(const model::Model& model);

/// Runs all steps. Throws InputError for models that cannot be analysed; an increment that does not converge is part of
/// the result.
StaticSolution solve_static(model::Model model, const Options& options = {});

/// The same on a mesh of the model, once: without refinement or estimate of the error.
StaticSolution solve_on_mesh(model::Model model, mesh::Mesh mesh, const Options& options);

}  // namespace scabo::analysis
