#include "scabo/contact/solve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "scabo/base/error.hpp"
#include "scabo/contact/ladder.hpp"
#include "scabo/contact/rigid_motions.hpp"
#include "scabo/contact/sweeps.hpp"

namespace scabo::contact {

namespace {

[[gnu::hot]] double largest_of(const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0.0; }

[[gnu::hot]] void check_sizes(const Problem& problem) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  ensure(d == 2 || d == 3, "a contact problem has two or three dimensions");
  ensure(problem.W.size() == d * N && problem.q.size() == d * N, "W, q and mu of a contact problem differ in size");
  ensure(problem.G.cols() == problem.f.size() && (problem.G.cols() == 0 || problem.G.rows() == d * N),
         "G and f of a contact problem differ in size");
  ensure((problem.cohesion.size() == 0 || problem.cohesion.size() == N) &&
             (problem.tension.size() == 0 || problem.tension.size() == N),
         "cohesion and tension of a contact problem have one entry for each pair");
}

[[gnu::hot]] std::vector<ContactState> states_of(const Problem& problem, const Vector& p, const Vector& motion,
                                                 const Scales& scales) {
  std::vector<ContactState> states;
  states.reserve(static_cast<std::size_t>(problem.pairs()));
  const Eigen::Index d = problem.dimension;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double p_n = p[d * i], bound = problem.friction_bound(i, p_n), tension = problem.tension_of(i);
    const double friction = p.segment(d * i + 1, d - 1).norm(), slip = motion.segment(d * i + 1, d - 1).norm();
    // Touching at zero force counts as contact only where force is really there.
    if (!std::isinf(tension) && p_n + tension <= 1e-13 * scales.force)
      states.push_back(ContactState::open);
    else if (friction < bound * (1.0 - 1e-10))
      states.push_back(ContactState::stick);
    else
      states.push_back(slip > 1e-12 * scales.length || bound == 0.0 ? ContactState::slip : ContactState::stick);
  }
  return states;
}

/// What the judge compares with the tolerance. The natural map knows forces and motions of pairs only.
[[gnu::hot]] double judged_figure(const Solution& solution, Judge judge) {
  return judge == Judge::certificate ? solution.certificate.worst()
                                     : std::max(solution.natural_map_residual, solution.certificate.rigid_balance);
}

std::string reason_of(const Solution& solution, const SolverOptions& options, bool singular) {
  const double reached = judged_figure(solution, options.judge);
  const bool unbalanced = reached > solution.natural_map_residual;
  char text[160];
  std::snprintf(text, sizeof text, "; the best point of %d iterations leaves a %s of %.2g", solution.iterations,
                options.judge == Judge::certificate ? "certificate"
                : unbalanced                        ? "balance of the rigid motions"
                                                    : "natural-map residual",
                reached);
  return (singular ? "contact forces could not balance the loads on any branch tried"
                   : "the Newton iterations stalled from every start tried") +
         std::string(text);
}

/// By what forces are judged: those applied, before or now; else those that would undo the motions q.
[[gnu::hot]] double reference_force(const Problem& problem, const Vector& p_start, const SolverOptions& options,
                                    double q_force) {
  // What rounding left of forces that are gone is no force to measure by.
  const double largest_start = largest_of(p_start),
               from_history = largest_start > 1e-10 * q_force ? largest_start : 0.0;
  const double applied = std::max({options.force_scale, largest_of(problem.f), from_history});
  return applied > 0.0 ? applied : q_force > 0.0 ? q_force : 1.0;
}

/// Certificate, gaps, slips and states of the forces found, and whether they are a solution.
[[gnu::hot]] void complete(Solution& solution, const Problem& problem, const Vector& motion, double reference,
                           double stiffness, const SolverOptions& options, bool singular) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  const double largest = std::max(reference, largest_of(solution.p));
  const Scales scales{largest, largest / stiffness};
  for (Iteration& iteration : solution.trace) {
    iteration.residual /= largest;
    iteration.merit /= largest * largest;
  }
  solution.residual /= largest;
  solution.certificate = certify_at(problem, solution.p, motion, scales);
  solution.natural_map_residual = natural_map_residual_at(problem, solution.p, motion);
  solution.gap.resize(N);
  solution.slip_increment.resize((d - 1) * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    solution.gap[i] = motion[d * i];
    for (Eigen::Index k = 1; k < d; ++k) solution.slip_increment[(d - 1) * i + k - 1] = motion[d * i + k];
  }
  solution.states = states_of(problem, solution.p, motion, scales);
  if (solution.status == Status::mechanism) return;
  if (judged_figure(solution, options.judge) <= options.tolerance) {
    solution.status = Status::solved;
    if (problem.G.cols() > 0) solution.undetermined = undetermined_motions(problem, solution.states);
  } else {
    solution.reason = reason_of(solution, options, singular);
  }
}

/// What sweeps alone solve, in the problem's own units.
[[gnu::hot]] Solution swept_solution(const Problem& problem, const Vector& p_start, SweepsEnd end,
                                     const SolverOptions& options) {
  Solution solution;
  solution.p = std::move(end.p);
  solution.residual = end.residual;
  solution.trace.push_back(
      {0, end.residual, 0.5 * end.residual * end.residual, 1.0, 0, std::to_string(end.sweeps) + " sweeps"});
  const double stiffness = stiffness_of(problem);
  complete(solution, problem, end.motion, reference_force(problem, p_start, options, stiffness * largest_of(problem.q)),
           stiffness, options, false);
  return solution;
}

Solution climbed_solution(const Problem& problem, const Vector& p_start, const Start& start,
                          const SolverOptions& options) {
  const Eigen::Index m = problem.G.cols(), d = problem.dimension, N = problem.pairs();
  Solution solution;
  const Scaled scaled_problem = scaled(problem);
  const double stiffness = scaled_problem.stiffness;
  const Vector a_start = start.a.size() == m ? Vector(stiffness * start.a) : Vector(Vector::Zero(m));

  if (const auto motion = find_mechanism(problem)) {
    solution.status = Status::mechanism;
    solution.motion = *motion;
    solution.p = p_start;
    solution.a = a_start / stiffness;
    solution.reason = "a rigid motion is held neither by supports nor by contact and friction";
  }

  const double q_force = largest_of(scaled_problem.problem.q);
  const double reference = reference_force(problem, p_start, options, q_force);

  // Well below the tolerance, but not below the rounding of the gaps themselves (a body that hovers far away).
  const double epsilon = std::numeric_limits<double>::epsilon();
  const bool by_map = options.judge == Judge::natural_map;
  const double small =
      by_map ? epsilon * reference : std::max(0.01 * options.tolerance * reference, 4.0 * epsilon * q_force);
  std::function<bool(const Vector&, const Vector&)> content;
  if (by_map)
    content = [&, real = Vector()](const Vector& p, const Vector& motion) mutable {
      real = motion / stiffness;
      if (natural_map_residual_at(problem, p, real) > 0.9 * options.tolerance) return false;
      return m == 0 || largest_of(problem.f + problem.G.transpose() * p) <=
                           0.9 * options.tolerance * std::max(reference, largest_of(p));
    };
  Ladder ladder(scaled_problem.problem, options, small, std::move(content));
  NewtonEnd end;
  if (solution.status != Status::mechanism) {
    end = ladder.climb(p_start, a_start);
    solution.p = end.p.size() == d * N ? end.p : p_start;
    solution.a = end.a.size() == m ? Vector(end.a / stiffness) : Vector(a_start / stiffness);
  }
  solution.iterations = ladder.iterations();
  solution.coarse_iterations = ladder.coarse_iterations();
  solution.trace = ladder.take_trace();

  Vector motion = problem.q + problem.W * solution.p;
  if (m > 0) motion += problem.G * solution.a;
  solution.residual = end.residual;
  complete(solution, problem, motion, reference, stiffness, options, end.singular);
  return solution;
}

}  // namespace

[[gnu::hot]] Solution solve(const Problem& problem, const Start& start, const SolverOptions& options) {
  check_sizes(problem);
  Vector p_start = start.p;
  if (p_start.size() != problem.q.size()) p_start.setZero(problem.q.size());
  if (options.judge == Judge::natural_map && may_accelerate(problem)) {
    SweepsEnd end = accelerated_sweeps(problem, p_start, 0.9 * options.tolerance);
    if (end.content) return swept_solution(problem, p_start, std::move(end), options);
  }
  return climbed_solution(problem, p_start, start, options);
}

}  // namespace scabo::contact
