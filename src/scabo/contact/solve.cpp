#include "scabo/contact/solve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>

#include "scabo/base/error.hpp"
#include "scabo/contact/infeasibility.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/ladder.hpp"
#include "scabo/contact/rigid_motions.hpp"
#include "scabo/contact/slides.hpp"
#include "scabo/contact/starts/sweeps.hpp"

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
  ensure(problem.mu_backward.size() == 0 || (problem.mu_backward.size() == N && d == 2),
         "backward coefficients of friction have one entry for each pair of a plane problem");
}

/// `rounding`: of the rigid motions, in the motions of the pairs.
[[gnu::hot]] std::vector<ContactState> states_of(const Problem& problem, const Vector& p, const Vector& motion,
                                                 const Vector& rounding, const Scales& scales) {
  std::vector<ContactState> states;
  states.reserve(static_cast<std::size_t>(problem.pairs()));
  // Without contact loads may move bodies by 1e6 times the slips of pairs (soft springs), and a slip is none beside
  // that. 1e-4 is well above the gaps that the tolerance leaves.
  const double length = std::clamp(largest_of(motion), 1e-4 * scales.length, scales.length);
  const Eigen::Index d = problem.dimension;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double p_n = p[d * i], tension = problem.tension_of(i);
    const double friction = p.segment(d * i + 1, d - 1).norm(), slip = motion.segment(d * i + 1, d - 1).norm();
    // What opposes slip counts, not the sign of a tangential force that is 0 within rounding.
    const bool moves = d == 2 && slip > 1e-12 * scales.length;
    const double bound = problem.friction_bound(i, p_n, moves ? -motion[d * i + 1] : p[d * i + 1]);
    // Interior points leave a little force in open pairs, and a little room below the bound of pairs that slip. A
    // motion counts where it is larger by far; at crack tips the forces of pairs are as small as the error of their
    // gaps.
    const auto exceeds = [&](double motion_beyond, double force) {
      const double part = motion_beyond / length;
      return part > 1e-6 && force / scales.force < 1e-3 * part;
    };
    // A pair that touches at zero force counts as in contact only if there is a force.
    const double held = p_n + tension;
    if (!std::isinf(tension) && (held <= 1e-13 * scales.force || exceeds(motion[d * i] - rounding[d * i], held)))
      states.push_back(ContactState::open);
    else if (friction < bound * (1.0 - 1e-10) &&
             !exceeds(slip - rounding.segment(d * i + 1, d - 1).norm(), bound - friction))
      states.push_back(ContactState::stick);
    else
      states.push_back(slip > 1e-12 * scales.length || bound == 0.0 ? ContactState::slip : ContactState::stick);
  }
  return states;
}

/// The reason why the problem was not solved.
std::string story_of(const Solution& solution, const SolverOptions& options, bool singular) {
  char text[160];
  if (options.deadline.passed() && options.deadline.of_work())
    std::snprintf(text, sizeof text, "the limit of work ended the search after %d iterations", solution.iterations);
  else if (options.deadline.passed())
    std::snprintf(text, sizeof text, "the time limit of %g s ended the search after %d iterations",
                  options.deadline.seconds(), solution.iterations);
  else if (singular)
    std::snprintf(text, sizeof text,
                  "no contact forces that balance the loads were found on any branch tried (%d iteration%s)",
                  solution.iterations, solution.iterations == 1 ? "" : "s");
  else
    std::snprintf(text, sizeof text, "the Newton iterations stalled from every start tried (%d iteration%s)",
                  solution.iterations, solution.iterations == 1 ? "" : "s");
  return text;
}

/// Residuals as forces, relative to the largest force.
[[gnu::hot]] void make_relative(Solution& solution, double force) {
  for (Iteration& iteration : solution.trace) {
    iteration.residual /= force;
    iteration.merit /= force * force;
  }
  solution.residual /= force;
}

/// Judges the forces found and sets gaps, slips, states and status.
[[gnu::hot]] void complete(Solution& solution, const Problem& problem, const Vector& motion, const Measure& measure,
                           const SolverOptions& options, bool singular) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  const Scales scales = measure.scales(solution.p);
  const Judgement judgement = judge(problem, solution.p, solution.a, motion, measure, options.judge);
  solution.certificate = judgement.certificate;
  solution.natural_map_residual = judgement.natural_map_residual;
  solution.rounding = judgement.rounding;
  solution.gap.resize(N);
  solution.slip_increment.resize((d - 1) * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    solution.gap[i] = motion[d * i];
    for (Eigen::Index k = 1; k < d; ++k) solution.slip_increment[(d - 1) * i + k - 1] = motion[d * i + k];
  }
  const Vector rounding = rounding_of_rigid_motions(problem, solution.a, scales.length);
  std::vector<ContactState> states = states_of(problem, solution.p, motion, rounding, scales);
  const bool known = solution.status == Status::solved && states == solution.states;  // undetermined motions
  solution.states = std::move(states);
  if (solution.status == Status::mechanism) return;
  if (judgement.solved(options.tolerance)) {
    solution.status = Status::solved;
    if (problem.G.cols() > 0 && !known) solution.undetermined = undetermined_motions(problem, solution.states);
  } else if (solution.status == Status::collapse) {
    solution.reason = "bodies move on without any further force on every path of equilibria that was followed";
  } else {
    solution.status = Status::not_converged;
    solution.reason = reason_of(judgement, options.judge, options.tolerance, story_of(solution, options, singular));
  }
}

/// Result of the sweeps, with its judgement.
[[gnu::hot]] Solution swept_solution(const Problem& problem, const Measure& measure, SweepsEnd end,
                                     const SolverOptions& options) {
  Solution solution;
  solution.p = std::move(end.p);
  solution.residual = end.residual;
  solution.trace.push_back(
      {0, end.residual, 0.5 * end.residual * end.residual, 1.0, 0, std::to_string(end.sweeps) + " sweeps"});
  make_relative(solution, measure.scales(solution.p).force);
  complete(solution, problem, end.motion, measure, options, false);
  return solution;
}

Solution climbed_solution(const Problem& problem, const Measure& measure, const Vector& p_start, const Start& start,
                          const SolverOptions& options, const std::function<bool()>& hopeless = {}) {
  const Eigen::Index m = problem.G.cols(), d = problem.dimension, N = problem.pairs();
  Solution solution;
  const Scaled scaled_problem = scaled(problem);
  const double stiffness = scaled_problem.stiffness;
  const Vector a_start = start.a.size() == m ? Vector(stiffness * start.a) : Vector(Vector::Zero(m));

  const auto is_mechanism = [&] {
    const auto motion = find_mechanism(problem);
    if (!motion) return false;
    solution.status = Status::mechanism;
    solution.motion = *motion;
    solution.p = p_start;
    solution.a = a_start / stiffness;
    solution.reason = "a rigid motion is held neither by supports nor by contact and friction";
    return true;
  };
  // For many bodies this costs as much as a solve, and it is not needed if forces were found.
  const bool asked_first = !has_many_motions(problem);
  if (asked_first) is_mechanism();

  // Well below the tolerance, but not below the rounding of the gaps themselves (a body far above its support).
  const double epsilon = std::numeric_limits<double>::epsilon(), reference = measure.reference();
  const bool by_map = options.judge == Judge::natural_map;
  const double small =
      by_map ? epsilon * reference
             : std::max(0.01 * options.tolerance * reference, 4.0 * epsilon * largest_of(scaled_problem.problem.q));
  const double asked = 0.9 * options.tolerance;
  // The certificate knows complementarity as a product, p_n g; where it decides, the natural map must be small as well.
  const double asked_of_map = by_map ? asked : 100.0 * asked;
  IsSolution content = [&, in_forces = measure.of_forces()](const Vector& p, const Vector& a, const Vector& motion) {
    return in_forces.natural_map(problem, p, motion) <= asked_of_map &&
           judge(scaled_problem.problem, p, a, motion, in_forces, options.judge).solved(asked);
  };
  Ladder ladder(scaled_problem.problem, options, small, std::move(content));
  NewtonEnd end;
  if (solution.status != Status::mechanism) {
    end = ladder.climb(p_start, a_start, start.touching, asked_first ? hopeless : is_mechanism);
  }
  if (solution.status != Status::mechanism) {
    solution.p = end.p.size() == d * N ? end.p : p_start;
    solution.a = end.a.size() == m ? Vector(end.a / stiffness) : Vector(a_start / stiffness);
    if (const auto collapse = ladder.collapse(); collapse && !end.converged) {
      solution.status = Status::collapse;
      solution.motion = collapse->motion;
      solution.held = collapse->held;
    }
  }
  solution.iterations = ladder.iterations();
  solution.coarse_iterations = ladder.coarse_iterations();
  solution.trace = ladder.take_trace();
  solution.residual = end.residual;
  make_relative(solution, measure.scales(solution.p).force);
  complete(solution, problem, motion_of(problem, solution.p, solution.a), measure, options, end.singular);
  return solution;
}

}  // namespace

namespace {

/// The solution of another form of the problem, whose forces and motions are those of this one.
Solution judged_as_a_whole(Solution solution, const Problem& problem, const Start& start,
                           const SolverOptions& options) {
  const std::string reason = solution.reason;
  Vector p_start = start.p;
  if (p_start.size() != problem.q.size()) p_start.setZero(problem.q.size());
  const Measure measure(problem, p_start, options.force_scale);
  const Status status = solution.status;
  if (status == Status::solved) solution.status = Status::not_converged;  // until it is judged
  complete(solution, problem, motion_of(problem, solution.p, solution.a), measure, options, false);
  if (status != Status::solved) {
    solution.status = status;
    solution.reason = reason;
  }
  return solution;
}

[[gnu::hot]] Solution solved_as_it_is(const Problem& problem, const Start& start, const SolverOptions& options) {
  Vector p_start = start.p;
  if (p_start.size() != problem.q.size()) p_start.setZero(problem.q.size());
  const Measure measure(problem, p_start, options.force_scale);
  if (options.judge == Judge::natural_map && may_accelerate(problem)) {
    SweepsEnd end = accelerated_sweeps(problem, p_start, 0.9 * options.tolerance, measure, options.deadline);
    if (end.content || options.deadline.passed()) return swept_solution(problem, measure, std::move(end), options);
    // It costs as much as a hundred sweeps or more, and few problems have no solution: the ladder asks when it must.
    std::optional<Infeasibility> found;
    const auto infeasible = [&] {
      found = find_infeasibility(problem, options.deadline);
      return found && found->proven;
    };
    Solution climbed = climbed_solution(problem, measure, p_start, start, options, infeasible);
    if (found && found->proven) {
      // There is no best iterate: sweeps diverge along r.
      end.p = p_start;
      end.motion = motion_of(problem, p_start, Vector());
      Solution none = swept_solution(problem, measure, std::move(end), options);
      mark_infeasible(none, *found);
      return none;
    }
    // Not solved: the best iterate of all attempts is returned.
    if (climbed.status == Status::not_converged && end.natural_map < climbed.natural_map_residual) {
      climbed.p = std::move(end.p);
      complete(climbed, problem, end.motion, measure, options, false);
    }
    if (climbed.status == Status::not_converged && found) mark_infeasible(climbed, *found);
    return climbed;
  }
  return climbed_solution(problem, measure, p_start, start, options);
}

/// The solution without the motions that no pair feels, which stay as they were, as one of the whole problem.
Solution solved_without_neutral(const WithoutNeutral& left, const Problem& problem, const Start& start,
                                const SolverOptions& options) {
  const Eigen::Index m = problem.G.cols();
  Solution solution = solve(left.problem, left.start(start), options);
  solution.a = left.motions(solution.a, start.a.size() == m ? start.a : Vector(Vector::Zero(m)));
  if (solution.motion.size() > 0) {
    const Vector motion = solution.motion;
    solution.motion = Vector::Zero(m);
    solution.motion(left.kept) = motion;
  }
  return judged_as_a_whole(std::move(solution), problem, start, options);
}

/// Motions that weak friction alone resists, as motions of their own (slides.hpp).
std::optional<Solution> solved_with_slides_apart(const Problem& problem, const Start& start,
                                                 const SolverOptions& options) {
  const std::optional<SlidesApart> apart = slides_apart(problem);
  if (!apart) return std::nullopt;
  Start start_apart = start;
  if (start.a.size() == problem.G.cols()) start_apart.a = apart->basis.partialPivLu().solve(start.a);
  Solution solution = solved_as_it_is(apart->problem, start_apart, options);
  solution.a = apart->basis * solution.a;
  if (solution.motion.size() > 0) solution.motion = (apart->basis * solution.motion).normalized();
  return judged_as_a_whole(std::move(solution), problem, start, options);
}

/// The solution with other forces and motions; nothing where they are none.
std::optional<Solution> completed_with(Solution other, Vector p, Vector a, const Problem& problem, const Start& start,
                                       const SolverOptions& options) {
  other.p = std::move(p);
  other.a = std::move(a);
  const Measure measure(problem, start.p.size() == problem.q.size() ? start.p : Vector(Vector::Zero(problem.q.size())),
                        options.force_scale);
  complete(other, problem, motion_of(problem, other.p, other.a), measure, options, false);
  if (other.status != Status::solved) return std::nullopt;
  return other;
}

}  // namespace

[[gnu::hot]] Solution solve(const Problem& problem, const Start& start, const SolverOptions& options) {
  check_sizes(problem);
  if (const std::optional<WithoutNeutral> left = without_neutral(problem, options.force_scale))
    return solved_without_neutral(*left, problem, start, options);
  if (std::optional<Solution> solution = solved_with_slides_apart(problem, start, options)) return *std::move(solution);
  return solved_as_it_is(problem, start, options);
}

std::optional<Solution> with_forces(const Solution& solution, Vector p, const Problem& problem, const Start& start,
                                    const SolverOptions& options) {
  std::optional<Solution> other = completed_with(solution, std::move(p), solution.a, problem, start, options);
  if (!other) return std::nullopt;
  // The motions differ by rounding, which decides between states where the next increment begins.
  other->gap = solution.gap;
  other->slip_increment = solution.slip_increment;
  return other;
}

std::optional<Solution> with_motions(const Solution& solution, Vector a, const Problem& problem, const Start& start,
                                     const SolverOptions& options) {
  std::optional<Solution> other = completed_with(solution, solution.p, std::move(a), problem, start, options);
  if (!other) return std::nullopt;
  other->undetermined = solution.undetermined;  // a pair that may slip and does not is still one of them
  return other;
}

}  // namespace scabo::contact
