#include "scabo/contact/solve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "scabo/base/error.hpp"
#include "scabo/contact/ladder.hpp"
#include "scabo/contact/rigid_motions.hpp"

namespace scabo::contact {

namespace {

double largest_of(const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0.0; }

void check_sizes(const Problem& problem) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  ensure(d == 2 || d == 3, "a contact problem has two or three dimensions");
  ensure(problem.W.size() == d * N && problem.q.size() == d * N, "W, q and mu of a contact problem differ in size");
  ensure(problem.G.cols() == problem.f.size() && (problem.G.cols() == 0 || problem.G.rows() == d * N),
         "G and f of a contact problem differ in size");
  ensure((problem.cohesion.size() == 0 || problem.cohesion.size() == N) &&
             (problem.tension.size() == 0 || problem.tension.size() == N),
         "cohesion and tension of a contact problem have one entry for each pair");
}

std::vector<ContactState> states_of(const Problem& problem, const Vector& p, const Vector& motion,
                                    const Scales& scales) {
  std::vector<ContactState> states;
  const Eigen::Index d = problem.dimension;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double p_n = p[d * i], bound = problem.friction_bound(i, p_n), tension = problem.tension_of(i);
    const double friction = p.segment(d * i + 1, d - 1).norm(), slip = motion.segment(d * i + 1, d - 1).norm();
    // Touching at zero force counts as contact only where force is really there.
    if (!std::isinf(tension) && p_n + tension <= 1e-13 * scales.force) states.push_back(ContactState::open);
    else if (friction < bound * (1.0 - 1e-10)) states.push_back(ContactState::stick);
    else states.push_back(slip > 1e-12 * scales.length || bound == 0.0 ? ContactState::slip : ContactState::stick);
  }
  return states;
}

/// What the judge compares with the tolerance. The natural map knows forces and motions of pairs only.
double judged_figure(const Solution& solution, Judge judge) {
  return judge == Judge::certificate
             ? solution.certificate.worst()
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

}  // namespace

Solution solve(const Problem& problem, const Start& start, const SolverOptions& options) {
  check_sizes(problem);
  const Eigen::Index N = problem.pairs(), m = problem.G.cols(), d = problem.dimension;
  Solution solution;
  const Vector p_start = start.p.size() == d * N ? start.p : Vector::Zero(d * N);
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
  // What rounding left of forces that are gone is no force to measure by.
  const double from_history = largest_of(p_start) > 1e-10 * q_force ? largest_of(p_start) : 0.0;
  const double applied = std::max({options.force_scale, largest_of(problem.f), from_history});
  const double reference = applied > 0.0 ? applied : q_force > 0.0 ? q_force : 1.0;

  // Well below the tolerance, but not below the rounding of the gaps themselves (a body that hovers far away).
  const double epsilon = std::numeric_limits<double>::epsilon();
  const bool by_map = options.judge == Judge::natural_map;
  const double small = by_map ? epsilon * reference
                              : std::max(0.01 * options.tolerance * reference, 4.0 * epsilon * q_force);
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
  const double largest = std::max(reference, largest_of(solution.p));
  const Scales scales{largest, largest / stiffness};
  for (Iteration& iteration : solution.trace) {
    iteration.residual /= largest;
    iteration.merit /= largest * largest;
  }
  solution.residual = end.residual / largest;
  solution.certificate = certify(problem, solution.p, solution.a, scales);
  solution.natural_map_residual = natural_map_residual_at(problem, solution.p, motion);
  solution.gap.resize(N);
  solution.slip_increment.resize((d - 1) * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    solution.gap[i] = motion[d * i];
    solution.slip_increment.segment((d - 1) * i, d - 1) = motion.segment(d * i + 1, d - 1);
  }
  solution.states = states_of(problem, solution.p, motion, scales);
  if (solution.status == Status::mechanism) return solution;
  const double figure = judged_figure(solution, options.judge);
  if (figure <= options.tolerance) {
    solution.status = Status::solved;
    solution.undetermined = undetermined_motions(problem, solution.states);
  } else {
    solution.reason = reason_of(solution, options, end.singular);
  }
  return solution;
}

}  // namespace scabo::contact
