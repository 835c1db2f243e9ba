#include "compare/solvers.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "compare/alart_curnier.hpp"
#include "compare/fischer_burmeister.hpp"
#include "compare/gauss_seidel.hpp"
#include "compare/proximal_point.hpp"
#include "compare/quadratic_programme.hpp"
#include "compare/siconos.hpp"
#include "compare/tresca.hpp"
#include "compare/trial_and_error.hpp"
#include "scabo/contact/newton/b_differentiable.hpp"
#include "scabo/contact/newton/newton.hpp"
#include "scabo/contact/questions/infeasibility.hpp"
#include "scabo/contact/questions/lemke.hpp"
#include "scabo/contact/questions/rigid_motions.hpp"

namespace scabo::compare {

namespace {

/// Name of a method and the problems that it handles.
struct Solver {
  Method method;
  const char* name;
  bool plane, space, friction, strength, rigid;
  Eigen::Index most = 0;  ///< largest number of contact unknowns, if its matrices are dense; 0: no limit
};
constexpr Eigen::Index dense = 6000;  // 0.3 GB a matrix
constexpr Solver solvers[] = {
    {Method::b_differentiable, "b_differentiable", true, true, true, true, true},
    {Method::newton_only, "newton_only", true, true, true, true, true},
    {Method::trial_and_error, "trial_and_error", true, true, true, false, true, dense},
    {Method::quadratic_programme, "quadratic_programme", true, true, false, false, false, dense},
    {Method::lemke, "lemke", true, false, true, false, false, dense / 2},
    {Method::fischer_burmeister, "fischer_burmeister", true, true, true, false, true, dense},
    {Method::alart_curnier, "alart_curnier", true, true, true, true, true, dense},
    {Method::gauss_seidel, "gauss_seidel", true, true, true, false, false},
    {Method::tresca, "tresca", true, true, true, true, true, dense},
    {Method::proximal_point, "proximal_point", true, true, true, true, true, dense},
    {Method::siconos_nsgs, "siconos_nsgs", true, true, true, false, false, dense},
    {Method::siconos_lemke, "siconos_lemke", true, false, true, false, false, dense / 2},
    {Method::siconos_nsn_ac, "siconos_nsn_ac", false, true, true, false, false, dense},
    {Method::siconos_nsn_fb, "siconos_nsn_fb", false, true, true, false, false, dense},
};

const Solver& solver_of(Method method) {
  for (const Solver& solver : solvers)
    if (solver.method == method) return solver;
  return solvers[0];
}

bool is_built(const Solver& solver) { return solver.method < Method::siconos_nsgs || siconos_is_built(); }

/// Why the method cannot be used; empty if it can.
std::string refusal(const Solver& solver, const Problem& problem) {
  const std::string who = std::string(solver.name) + " does not handle ";
  if (!is_built(solver)) return std::string(solver.name) + " is not in this build (CMake option SCABO_SICONOS)";
  if (problem.dimension == 2 && !solver.plane) return who + "problems in the plane";
  if (problem.dimension == 3 && !solver.space) return who + "problems in space";
  if (!solver.friction && problem.mu.size() > 0 && problem.mu.maxCoeff() > 0.0) return who + "friction: mu must be 0";
  if (solver.method != Method::b_differentiable && problem.mu_backward.size() > 0)
    return who + "coefficients of friction that differ by the direction of slip";
  const auto some = [](const Vector& v) { return v.size() > 0 && v.maxCoeff() > 0.0; };
  if (!solver.strength && (some(problem.cohesion) || some(problem.tension))) return who + "cohesion and tension";
  if (!solver.rigid && problem.G.cols() > 0) return who + "rigid motions that contact alone holds";
  if (solver.most > 0 && problem.q.size() > solver.most)
    return who + "more than " + std::to_string(solver.most) + " contact unknowns (its matrices are dense), here " +
           std::to_string(problem.q.size());
  return {};
}

End newton_only(const Problem& problem, const Vector& p, const Vector& a, const SolverOptions& options,
                const Control& control) {
  const BDifferentiableEquations equations(problem, options.r_factor);
  NewtonOptions how;
  how.small = control.small;
  how.iterations = control.iterations;
  how.deadline = control.deadline;
  NewtonEnd end = newton(equations, p, a, how);
  return {end.p,
          end.a,
          end.converged,
          end.iterations,
          end.residual,
          end.singular ? "the Newton matrix is singular" : "Newton's iterations stalled",
          std::move(end.trace)};
}

End pivoted(const Problem& problem, const Vector& p_start, const Control& control) {
  End end;
  const std::optional<Vector> p = lemke(problem);
  end.p = p.value_or(p_start);
  end.reason = p ? "rounding of the pivots" : "the pivoting ends on a ray";
  end.iterations = 1;
  end.residual = largest(residual_of(problem, pair_stiffness(problem), end.p, Vector()));
  end.converged = end.residual <= control.small;
  end.trace.push_back({1, end.residual, 0.0, 1.0, 0, "lemke"});
  return end;
}

End run_by(const Solver& solver, const Problem& problem, const Vector& p, const Vector& a, const SolverOptions& options,
           const Control& control) {
  switch (solver.method) {
    case Method::newton_only:
      return newton_only(problem, p, a, options, control);
    case Method::trial_and_error:
      return trial_and_error(problem, p, a, control);
    case Method::quadratic_programme:
      return quadratic_programme(problem, control);
    case Method::lemke:
      return pivoted(problem, p, control);
    case Method::fischer_burmeister:
      return fischer_burmeister(problem, p, a, control);
    case Method::alart_curnier:
      return alart_curnier(problem, p, a, control);
    case Method::gauss_seidel:
      return gauss_seidel(problem, p, control);
    case Method::tresca:
      return tresca(problem, p, a, control);
    case Method::proximal_point:
      return proximal_point(problem, p, a, control);
    case Method::b_differentiable:
      break;  // handled by solve()
    default:
      return siconos(solver.name, problem, p, control);
  }
  return {};
}

/// Gaps, slips, states.
void describe(Solution& solution, const Problem& problem, const Vector& motion, const Scales& scales) {
  const Eigen::Index d = problem.dimension, N = problem.pairs(), t = d - 1;
  solution.gap.resize(N);
  solution.slip_increment.resize(t * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    solution.gap[i] = motion[d * i];
    solution.slip_increment.segment(t * i, t) = motion.segment(d * i + 1, t);
    const double p_n = solution.p[d * i], slip = motion.segment(d * i + 1, t).norm();
    const double bound = problem.friction_bound(i, p_n, solution.p[d * i + 1]),
                 friction = solution.p.segment(d * i + 1, t).norm();
    if (p_n + problem.tension_of(i) <= 1e-13 * scales.force)
      solution.states.push_back(ContactState::open);
    else if (friction < bound * (1.0 - 1e-10) || (bound > 0.0 && slip <= 1e-12 * scales.length))
      solution.states.push_back(ContactState::stick);
    else
      solution.states.push_back(ContactState::slip);
  }
}

/// When a method may end: well below the tolerance of the judge, but not below the rounding of the gaps themselves.
Control control_of(const Problem& problem, const SolverOptions& options, const Measure& measure) {
  const double stiffness = measure.stiffness();
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * stiffness * largest(problem.q);
  const double asked = options.judge == Judge::certificate ? 0.01 * options.tolerance * measure.reference()
                                                           : 0.1 * options.tolerance * stiffness * problem.q.norm();
  return {std::max(asked, rounding), options.iterations, options.deadline};
}

/// Runs the method from `solution`, which gets its end. Motions are converted to forces, so that all unknowns are
/// forces; scales as in solve().
End run_in_forces(const Solver& solver, const Problem& problem, const SolverOptions& options, const Measure& measure,
                  Solution& solution) {
  const double stiffness = measure.stiffness();
  Problem in_forces = problem;
  in_forces.W = problem.W.scaled(stiffness);
  in_forces.q = stiffness * problem.q;
  End end =
      run_by(solver, in_forces, solution.p, stiffness * solution.a, options, control_of(problem, options, measure));
  solution.p = end.p;
  solution.a = problem.G.cols() > 0 ? Vector(end.a / stiffness) : Vector(0);
  solution.iterations = end.iterations;
  solution.trace = std::move(end.trace);
  return end;
}

/// Status of a method that has ended, and the reason if it did not solve the problem. `ended`: its own words, if any.
void conclude(const Solver& solver, const Problem& problem, const SolverOptions& options, Judgement judgement,
              const std::string& ended, Solution& solution) {
  // A small deviation of friction from the direction of slip enters the certificate only quadratically (as work); the
  // residual must therefore be small too.
  if (options.judge == Judge::certificate) judgement.figure = std::max(judgement.figure, solution.residual);
  if (judgement.solved(options.tolerance)) {
    solution.status = Status::solved;
    solution.undetermined = undetermined_motions(problem, solution.states);
  } else if (options.deadline.passed()) {
    char limit[80];
    std::snprintf(limit, sizeof limit, "%s: the time limit of %g s ended the search", solver.name,
                  options.deadline.seconds());
    solution.reason = reason_of(judgement, options.judge, options.tolerance, limit);
  } else {
    solution.reason = std::string(solver.name) + ": " +
                      (ended.empty() ? reason_of(judgement, options.judge, options.tolerance, "it ended") : ended);
  }
  if (solution.status == Status::not_converged && options.judge == Judge::natural_map)
    if (const auto found = find_infeasibility(problem, options.deadline)) mark_infeasible(solution, *found);
}

}  // namespace

std::optional<Method> method_named(std::string_view name) {
  for (const Solver& solver : solvers)
    if (name == solver.name && is_built(solver)) return solver.method;
  return std::nullopt;
}

std::string method_name(Method method) { return solver_of(method).name; }

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Solver& solver : solvers)
    if (is_built(solver)) names.emplace_back(solver.name);
  return names;
}

Solution solve_with(Method method, const Problem& problem, const Start& start, const SolverOptions& options) {
  // Without pairs there is nothing to solve.
  if (method == Method::b_differentiable || problem.q.size() == 0) return solve(problem, start, options);
  const Solver& solver = solver_of(method);
  const Eigen::Index size = problem.q.size(), m = problem.G.cols();
  Solution solution;
  solution.p = start.p.size() == size ? start.p : Vector(Vector::Zero(size));
  solution.a = start.a.size() == m ? start.a : Vector(Vector::Zero(m));
  solution.reason = refusal(solver, problem);
  const bool refused = !solution.reason.empty();
  const auto motion = refused ? std::nullopt : find_mechanism(problem);
  if (motion) {
    solution.status = Status::mechanism;
    solution.motion = *motion;
    solution.reason = "a rigid motion is held neither by supports nor by contact and friction";
  }
  const bool runs = !refused && !motion;
  const Measure measure(problem, solution.p, options.force_scale);
  const End end = runs ? run_in_forces(solver, problem, options, measure, solution) : End();
  const Scales scales = measure.scales(solution.p);
  for (Iteration& iteration : solution.trace) iteration.residual /= scales.force;
  solution.residual = end.residual / scales.force;
  const Vector u = motion_of(problem, solution.p, solution.a);
  const Judgement judgement = judge(problem, solution.p, solution.a, u, measure, options.judge);
  solution.certificate = judgement.certificate;
  solution.natural_map_residual = judgement.natural_map_residual;
  solution.rounding = judgement.rounding;
  describe(solution, problem, u, scales);
  if (runs) conclude(solver, problem, options, judgement, end.reason, solution);
  return solution;
}

}  // namespace scabo::compare
