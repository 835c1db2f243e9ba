// The solution of a static analysis: what was analysed, its increments, and how it ended. Plain values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/state/discretisation.hpp"
#include "scabo/analysis/state/results.hpp"

namespace scabo::analysis {

/// The discrete problem of one attempt, as a value that can be saved and solved separately (contact/files/fclib.hpp).
struct DiscreteProblem {
  contact::Problem problem;
  contact::Start start;  ///< the previous accepted state
  contact::Solution solution;
  bool accepted = false;
  double force_scale = 0.0;  ///< contact::SolverOptions::force_scale
  /// Index into Model::contacts, one for each pair of the problem; beyond them that of a bar, then that of a support
  /// among those that begin or end.
  std::vector<int> contact_of_pair;
  std::vector<int> number_of_pair;  ///< PairResult::pair
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

/// Largest displacement in ten-thousandths, by which bodies are ordered: those that move alike differ by rounding.
long rank(const BodyMotion& motion);

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

/// Cracks at the end of an analysis in which they grow.
struct GrownCracks {
  struct Path {
    std::string crack;  ///< `plate.flaw`
    std::vector<Vec2> points;
  };
  std::vector<Path> paths;  ///< of the cracks that may grow, up to what they meet
  std::string ended;        ///< why growth ended, as a sentence without full stop
  bool broken = false;      ///< the paths divide a body
};

/// Between the two factors of a step that looks for one (model::LimitStep) there is none with equilibrium.
struct Limit {
  double solved = 0.0;  ///< factor of the last equilibrium
  double beyond =
      0.0;  ///< nearest factor at which none was found, from the last one; infinite: found at all that were tried
  Outcome outcome = Outcome::solved;  ///< of the attempt at `beyond`; solved: there was none
  std::string reason;                 ///< of it
};

/// A discretisation, and the increments on it.
struct StaticSolution : Discretisation {
  /// Number of times that the discretisation was replaced because pairs were found anew or a crack grew. Fields of
  /// increments before the last time are not kept.
  int pairings = 0;
  std::vector<IncrementResult> increments;  ///< converged increments, then at most one that is not
  std::vector<RefinementPass> passes;       ///< if the mesh was refined for a tolerance
  std::vector<Warning> warnings;
  Outcome outcome = Outcome::solved;
  std::string reason;                  ///< if not solved
  std::optional<Mechanism> mechanism;  ///< of outcomes mechanism and collapse
  std::optional<GrownCracks> grown;    ///< if cracks grow
  std::optional<Limit> limit;          ///< if the last step looked for one; `mechanism` is then that beyond it
  Timing timing;
};

}  // namespace scabo::analysis
