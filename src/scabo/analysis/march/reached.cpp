#include "scabo/analysis/march/reached.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/diagnostics/warnings.hpp"
#include "scabo/analysis/diagnostics/wedged_points.hpp"
#include "scabo/analysis/state/balance.hpp"
#include "scabo/contact/laws/evolution.hpp"
#include "scabo/contact/questions/onset.hpp"
#include "scabo/contact/questions/uniqueness.hpp"

namespace scabo::analysis {

namespace {

/// Whether the model has joints whose strength is lost when they fail.
bool breaks(const Prepared& prepared) {
  const auto& contacts = prepared.model.contacts;
  return std::any_of(contacts.begin(), contacts.end(),
                     [](const model::Contact& contact) { return contact.cohesion > 0.0; });
}

std::string remedy_for(const Prepared& prepared, double figure) {
  return tolerance_to_set(figure, prepared.model.solver.tolerance, prepared.mesh.dofs());
}

/// The part that resists its displacements most.
std::string stiffest_part(const Prepared& prepared, const State& state) {
  std::size_t stiffest = 0;
  double largest = 0.0;
  for (std::size_t p = 0; p < state.u.size(); ++p)
    if (const double force = prepared.structure.parts[p]->stiff_force(state.u[p]); force > largest)
      largest = force, stiffest = p;
  return prepared.structure.dofs.name_of(stiffest, prepared.model);
}

/// Reason why an increment with a contact solution is not accepted.
std::string above_tolerance(const Prepared& prepared, const Attempt& tried, double tolerance) {
  const double worst = tried.certificate.worst();
  if (worst <= tolerance)  // in time
    return fmt::format(
        "the energies of a time step do not balance: {:.2g} of the largest energy is missing or too much, which is "
        "more "
        "than rounding of bodies that are not very much stiffer than what moves them; make such bodies rigid, or less "
        "stiff",
        tried.certificate.energy_balance);
  std::string reason =
      fmt::format("the largest figure of the certificate, {:.3g}, is above the tolerance {:.3g}", worst, tolerance);
  if (const std::string remedy = remedy_for(prepared, worst); !remedy.empty())
    reason += remedy;
  else if (worst == std::max(tried.certificate.equilibrium, tried.certificate.rigid_balance) && worst <= tried.rounding)
    reason += fmt::format(
        "; rounding of the displacements alone may leave {:.1g}, because {} would resist its largest displacement, of "
        "one "
        "node alone, by {:.0e} times the largest force: make it less stiff beside the other parts, or rigid, or raise "
        "solver.tolerance",
        tried.rounding, stiffest_part(prepared, tried.state), tried.rounding / rounding_of_resistance);
  else if (const std::string stiff = stiff_springs(prepared.model, prepared.structure, stiff_beside); !stiff.empty())
    reason += "; " + stiff;
  return reason;
}

/// How far all pairs are open without contact forces: a body that nothing else holds moves at least as far. 0 where one
/// is closed.
double smallest_opening(const contact::Problem& problem) {
  if (problem.pairs() == 0) return 0.0;
  double smallest = problem.q[0];
  for (Eigen::Index i = 0; i < problem.q.size(); i += problem.dimension) smallest = std::min(smallest, problem.q[i]);
  return std::max(smallest, 0.0);
}

/// Part of the largest force that rounding of a motion of this length leaves unbalanced.
double rounding_of_motion(const Prepared& prepared, const Attempt& tried, double motion) {
  const double scale = std::max(tried.force_scale, tried.state.largest_force);
  if (!(scale > 0.0)) return 0.0;
  double resisting = 0.0;
  for (std::size_t p = 0; p < tried.state.u.size(); ++p)
    resisting = std::max(resisting,
                         prepared.structure.parts[p]->stiff_force(Vector::Constant(tried.state.u[p].size(), motion)));
  return std::numeric_limits<double>::epsilon() * resisting / scale;
}

/// Where motions are so large beside deformations that forces are lost in rounding; empty where they are not.
std::string lost_in_rounding(const Prepared& prepared, const Attempt& tried, double tolerance) {
  constexpr double allowance = 1e-3;  // Attempt::rounding allows for a thousand roundings
  const double lost = allowance * tried.rounding;
  const double opening = smallest_opening(tried.problem), closing = rounding_of_motion(prepared, tried, opening);
  if (closing > std::max(0.1 * lost, tolerance) && std::isfinite(closing))
    return fmt::format(
        "; all pairs are open by {:.3g} or more at first, and the motion that closes them is so large beside the "
        "deformation of the bodies that rounding of the displacements may leave {:.1g} of the forces unbalanced: a "
        "smaller gap or a larger load is needed",
        opening, closing);
  if (!(lost > tolerance) || !std::isfinite(lost)) return {};
  return fmt::format(
      "; the motion is so large beside the deformation of the bodies that rounding of the displacements may leave "
      "{:.1g} of the forces unbalanced: a smaller motion, or a larger interference or load, is needed",
      lost);
}

/// By Coulomb's law, or, where that is not found, the motion that proves the mechanism.
void set_motion_of_mechanism(const Prepared& prepared, const Attempt& tried, Reached& reached) {
  const std::optional<Vector> onset = contact::onset_of_motion(tried.problem, inverse_mass(prepared));
  reached.motion = mechanism_of(prepared, onset ? *onset : tried.solution.motion,
                                onset ? FlowRule::coulomb : FlowRule::associated, tried.problem.f);
}

/// In an attempt to go from part `from` of an increment to part `to`; `motion`: of the bodies, m numbers.
std::string describe_collapse(const Prepared& prepared, const Vector& motion, double from, double to) {
  return fmt::format(
      "collapse: no equilibrium was found at {:.4g} of the increment, and the bodies begin to move when they are let "
      "go "
      "there ({}); the last equilibrium was found at {:.4g}",
      to, describe_motions(prepared, motion), from);
}

/// Whether no equilibrium was found because joints have broken, after which the bodies are a mechanism.
bool gives_up_broken(const Prepared& prepared, const Attempt& tried, Reached& reached) {
  if (!breaks(prepared)) return false;
  const auto motion =
      contact::mechanism_once_broken(tried.problem, laws_at(prepared, tried.state.factors), reached.state.history);
  if (!motion) return false;
  reached.mechanism = true;
  reached.motion = mechanism_of(prepared, *motion, FlowRule::associated, tried.problem.f);
  reached.reason = fmt::format(
      "mechanism: {}, which only the strength of the joints could prevent; no equilibrium was found with their "
      "remaining strength after {} halvings",
      describe_motions(prepared, *motion), reached.halvings);
  return true;
}

}  // namespace

bool is_far_from_solved(const Prepared& prepared, const Attempt& tried) {
  constexpr double far = 1e4;
  return tried.solution.status == contact::Status::not_converged &&
         tried.certificate.worst() > far * prepared.model.solver.tolerance;
}

void accept(Attempt tried, double part, Reached& reached) {
  reached.state = std::move(tried.state);
  reached.certificate = tried.certificate;
  reached.residual = tried.solution.residual;
  reached.undetermined = std::move(tried.solution.undetermined);
  reached.problem = std::move(tried.problem);
  reached.uniqueness = tried.uniqueness;
  reached.part = part;
}

void give_up(const Prepared& prepared, const Attempt& tried, double part, Reached& reached) {
  using contact::Status;
  const Status status = tried.solution.status;
  const double tolerance = prepared.model.solver.tolerance;
  reached.residual = tried.solution.residual;
  reached.certificate = tried.certificate;
  if ((status == Status::not_converged || status == Status::collapse) && gives_up_broken(prepared, tried, reached))
    return;
  reached.mechanism = status == Status::mechanism || !tried.rolls.empty();
  reached.collapse = status == Status::collapse;
  if (!tried.rolls.empty()) {
    const Vector motion = tried.state.rigid_motion - reached.state.rigid_motion;
    reached.motion = mechanism_of(prepared, motion.isZero(0.0) ? tried.state.rigid_motion : motion, FlowRule::coulomb,
                                  tried.problem.f);
    reached.reason = fmt::format("mechanism: {}", tried.rolls);
  } else if (status == Status::mechanism) {
    set_motion_of_mechanism(prepared, tried, reached);
    reached.reason = fmt::format("mechanism: {}, held neither by supports nor by contact and friction",
                                 describe_motions(prepared, reached.motion->rigid));
  } else if (status == Status::collapse) {
    set_motion_of_mechanism(prepared, tried, reached);
    reached.reason = describe_collapse(prepared, reached.motion->rigid, reached.part, part);
  } else if (!tried.beyond.empty())
    reached.reason = tried.beyond;
  else if (status == Status::solved)
    reached.reason = above_tolerance(prepared, tried, tolerance);
  else
    reached.reason =
        fmt::format("contact did not converge after {} halvings: {}", reached.halvings, tried.solution.reason);
  if (status != Status::not_converged) return;
  contact::SolverOptions solver;
  solver.tolerance = tolerance;
  solver.force_scale = tried.force_scale;
  if (const std::string why = contact::why_no_solution(tried.problem, solver); !why.empty())
    reached.reason += "; " + why;
  if (const std::string where = wedged_point(prepared, tried.problem); !where.empty()) {
    reached.reason += "; " + where;
    return;
  }
  const std::string remedy = remedy_for(prepared, tried.certificate.worst());
  reached.reason += remedy.empty() ? lost_in_rounding(prepared, tried, tolerance) : remedy;
}

void record(const Prepared& prepared, const Attempt& tried, const Options& options, Reached& reached) {
  reached.attempts.push_back({tried.solution.trace, tried.accepted});
  if (options.on_problems && tried.problem.pairs() > 0) reached.problems.push_back(discrete_problem(prepared, tried));
}

std::string tolerance_to_set(double figure, double tolerance, int degrees_of_freedom) {
  constexpr double margin = 3.0;  // figures of other increments and machines differ
  if (!(figure > tolerance && margin * figure < model::SolverOptions().tolerance)) return {};
  return fmt::format(
      "; rounding leaves {:.2g} in {} degrees of freedom: set solver.tolerance to 1e{} or leave it out, as its default "
      "of {:g} is far below the error of any mesh",
      figure, degrees_of_freedom, static_cast<int>(std::ceil(std::log10(margin * figure))),
      model::SolverOptions().tolerance);
}

}  // namespace scabo::analysis
