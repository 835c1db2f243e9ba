#include "scabo/contact/solve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "scabo/base/error.hpp"
#include "scabo/contact/neutral_motions.hpp"
#include "scabo/contact/questions/infeasibility.hpp"
#include "scabo/contact/questions/onset.hpp"
#include "scabo/contact/questions/rigid_motions.hpp"
#include "scabo/contact/stages.hpp"

namespace scabo::contact {

namespace {

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
  const double length =
      std::clamp(motion.size() > 0 ? motion.lpNorm<Eigen::Infinity>() : 0.0, 1e-4 * scales.length, scales.length);
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
                           const SolverOptions& options, const std::string& story) {
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
  if (solution.status == Status::mechanism || solution.status == Status::infeasible) return;
  if (judgement.solved(options.tolerance)) {
    solution.status = Status::solved;
    if (problem.G.cols() > 0 && !known)
      solution.undetermined = undetermined_motions(problem, solution.states, solution.p);
  } else {
    solution.status = Status::not_converged;
    solution.reason = reason_of(judgement, options.judge, options.tolerance, story);
  }
}

std::string limit_of(const Deadline& deadline, int iterations) {
  char limit[64] = "limit of work";
  if (!deadline.of_work()) std::snprintf(limit, sizeof limit, "time limit of %g s", deadline.seconds());
  return std::string("the ") + limit + " ended the search after " + std::to_string(iterations) + " iterations";
}

/// Whether a rigid motion is proven to be held by nothing.
bool is_mechanism(const Problem& problem, Solution& solution) {
  std::optional<Vector> motion = find_mechanism(problem);
  if (!motion) return false;
  solution.status = Status::mechanism;
  solution.motion = *std::move(motion);
  solution.reason = "a rigid motion is held neither by supports nor by contact and friction";
  return true;
}

/// Whether forces in equilibrium with themselves prove that there is no solution.
bool is_infeasible(const Problem& problem, const SolverOptions& options, Solution& solution) {
  if (options.judge != Judge::natural_map || problem.G.cols() > 0) return false;
  const std::optional<Infeasibility> found = find_infeasibility(problem, options.deadline);
  if (found) mark_infeasible(solution, *found);
  return solution.status == Status::infeasible;
}

/// Where the stages found no equilibrium of bodies that contact alone holds: whether they begin to move from rest.
void mark_collapse(const Problem& problem, const SolverOptions& options, Solution& solution) {
  if (problem.G.cols() == 0 || options.deadline.passed()) return;
  std::optional<Vector> motion = onset_of_motion(problem, unit_mass(problem));
  if (!motion) return;
  solution.status = Status::collapse;
  solution.motion = *std::move(motion);
  solution.reason = "no equilibrium was found, and the bodies begin to move when they are let go";
}

/// The stages in turn, until one finds a solution; why they did not. Whether there is one at all is asked first: it
/// costs a small part of a solve.
std::string search_in_stages(Search& search, const Problem& problem, const SolverOptions& options, Solution& solution) {
  if (is_mechanism(problem, solution)) return {};
  std::string story;
  for (const auto stage : {newton_stage, interior_stage, sweeps_stage, held_slips_stage}) {
    const StageEnd end = stage(search);
    if (end.solved) return {};
    if (search.late()) return limit_of(options.deadline, search.iterations());
    const bool first = story.empty();
    if (first && is_infeasible(problem, options, solution)) return {};
    story += (first ? "" : "; ") + end.why;
  }
  return story;
}

[[gnu::hot]] Solution solved_as_it_is(const Problem& problem, const Start& start, const SolverOptions& options) {
  Solution solution;
  Search search(problem, start, options);
  const std::string story = search_in_stages(search, problem, options, solution);
  const bool proven = solution.status != Status::not_converged;
  const Point& point = proven ? search.start() : search.best();
  solution.p = point.p;
  solution.a = point.a / search.stiffness();
  solution.iterations = search.iterations();
  solution.coarse_iterations = search.coarse_iterations();
  solution.trace = search.take_trace();
  solution.residual = proven ? 0.0 : search.best_residual();
  make_relative(solution, search.measure().scales(solution.p).force);
  complete(solution, problem, motion_of(problem, solution.p, solution.a), search.measure(), options, story);
  if (solution.status == Status::not_converged) mark_collapse(problem, options, solution);
  return solution;
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
  if (solution.status != Status::solved) return solution;
  solution.status = Status::not_converged;  // until it is judged
  const Search whole(problem, start, options);
  complete(solution, problem, motion_of(problem, solution.p, solution.a), whole.measure(), options, "");
  return solution;
}

/// The solution with other forces and motions; nothing where they are none.
std::optional<Solution> completed_with(Solution other, Vector p, Vector a, const Problem& problem, const Start& start,
                                       const SolverOptions& options) {
  other.p = std::move(p);
  other.a = std::move(a);
  const Measure measure(problem, start.p.size() == problem.q.size() ? start.p : Vector(Vector::Zero(problem.q.size())),
                        options.force_scale);
  complete(other, problem, motion_of(problem, other.p, other.a), measure, options, "");
  if (other.status != Status::solved) return std::nullopt;
  return other;
}

}  // namespace

[[gnu::hot]] Solution solve(const Problem& problem, const Start& start, const SolverOptions& options) {
  check_sizes(problem);
  if (const std::optional<WithoutNeutral> left = without_neutral(problem, options.force_scale))
    return solved_without_neutral(*left, problem, start, options);
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
