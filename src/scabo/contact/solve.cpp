#include "scabo/contact/solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scabo/contact/b_differentiable.hpp"
#include "scabo/contact/gauss_seidel.hpp"
#include "scabo/contact/lemke.hpp"
#include "scabo/contact/rigid_motions.hpp"

namespace scabo::contact {

namespace {

double largest_of(const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0.0; }

/// The problem with motions as forces (W, q scaled by one stiffness), so that all unknowns are forces.
struct Scaled {
  Problem problem;
  double stiffness = 1.0;  ///< force / length
};

Scaled scaled(const Problem& problem) {
  const double mean = problem.W.size() > 0 ? problem.W.diagonal().mean() : 0.0;
  Scaled result{problem, mean > 0.0 ? 1.0 / mean : 1.0};
  result.problem.W = problem.W.scaled(result.stiffness);
  result.problem.q *= result.stiffness;
  return result;
}

/// Rigid motions eliminated by a proximal term: G'p + f = c (a - a_0), so that a = a_0 + (G'p + f) / c.
Problem proximal(const Problem& problem, const Vector& a_0, double c) {
  Problem held = problem;
  held.W = Matrix(problem.W.dense() + problem.G * problem.G.transpose() / c);
  held.q.noalias() += problem.G * (a_0 + problem.f / c);
  held.G.resize(problem.q.size(), 0);
  held.f.resize(0);
  return held;
}

/// Starts and their Newton runs, on the scaled problem.
class Attempts {
 public:
  Attempts(const Problem& problem, const SolverOptions& options, double small)
      : problem_(problem), options_(options), small_(small) {}

  int iterations() const { return iterations_; }
  const std::vector<Iteration>& trace() const { return trace_; }

  NewtonEnd run(const Problem& problem, const Vector& p, const Vector& a, double r_factor) {
    const BDifferentiableEquations equations(problem, r_factor);
    NewtonEnd end = equations.newton(p, a, small_, options_.iterations);
    iterations_ += end.iterations;
    trace_.insert(trace_.end(), end.trace.begin(), end.trace.end());
    return end;
  }

  /// The whole ladder; the best end is returned when none converges.
  NewtonEnd climb(const Vector& p, const Vector& a) {
    NewtonEnd best = run(problem_, p, a, options_.r_factor);
    const auto better = [&](NewtonEnd end) {
      if (end.converged || end.residual < best.residual) best = std::move(end);
      return best.converged;
    };
    if (best.converged) return best;
    const bool held = problem_.G.cols() == 0;
    if (!held && better(proximal_point(p, a))) return best;
    if (better(growing_friction(p, a))) return best;
    if (better(after_sweeps(p, a))) return best;
    if (held && better(after_pivoting(problem_))) return best;
    for (double factor : {0.1, 10.0, 0.01, 100.0})
      if (better(run(problem_, p, a, options_.r_factor * factor))) return best;
    return best;
  }

 private:
  /// Proximal-point iteration: a sequence of problems whose bodies are held softly where they last were. It ends
  /// in finitely many steps, and Newton on the problem itself, without any spring, has the last word.
  NewtonEnd proximal_point(Vector p, Vector a) {
    NewtonEnd end;
    end.residual = HUGE_VAL;
    // Of the mean contact stiffness, which the scaling has made 1. Of 8000 random floating problems none failed with 0.1,
    // 1 % of those with weak friction with 0.001.
    double soft = 0.1;
    for (int round = 0; round < 30; ++round) {
      const Problem held = proximal(problem_, a, soft);
      NewtonEnd inner = run(held, p, Vector(), options_.r_factor);
      if (!inner.converged) inner = run(held, gauss_seidel(held, p, 100), Vector(), options_.r_factor);
      if (!inner.converged) inner = after_pivoting(held);
      if (!inner.converged) break;
      p = inner.p;
      a += (problem_.G.transpose() * p + problem_.f) / soft;
      end = run(problem_, p, a, options_.r_factor);
      if (end.converged) break;
      if (end.singular && soft > 1e-8) soft *= 0.1;  // still in the air
    }
    return end;
  }

  /// The frictionless solution first, then more and more friction.
  NewtonEnd growing_friction(const Vector& p, const Vector& a) {
    NewtonEnd end;
    end.residual = HUGE_VAL;
    Problem weaker = problem_;
    Vector p_now = p, a_now = a;
    for (double part : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) {
      weaker.mu = part * problem_.mu;
      end = run(weaker, p_now, a_now, options_.r_factor);
      if (!end.p.allFinite()) break;
      p_now = end.p;
      a_now = end.a;
    }
    return end;
  }

  NewtonEnd after_sweeps(const Vector& p, const Vector& a) {
    if (problem_.G.cols() == 0) return run(problem_, gauss_seidel(problem_, p, 500), a, options_.r_factor);
    const double soft = 1e-2;
    const Vector swept = gauss_seidel(proximal(problem_, a, soft), p, 500);
    return run(problem_, swept, a + (problem_.G.transpose() * swept + problem_.f) / soft, options_.r_factor);
  }

  NewtonEnd after_pivoting(const Problem& held) {
    constexpr int most = 400;  // pairs: the tableau grows with their square
    const std::optional<Vector> p = held.pairs() <= most ? lemke(held) : std::nullopt;
    if (p) return run(held, *p, Vector(), options_.r_factor);
    NewtonEnd none;
    none.residual = HUGE_VAL;
    return none;
  }

  const Problem& problem_;
  const SolverOptions& options_;
  double small_;
  int iterations_ = 0;
  std::vector<Iteration> trace_;
};

std::vector<ContactState> states_of(const Problem& problem, const Vector& p, const Vector& motion,
                                    const Scales& scales) {
  std::vector<ContactState> states;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double pn = p[2 * i], bound = problem.mu[i] * pn;
    // Touching at zero force counts as contact only where force is really there.
    if (pn <= 1e-13 * scales.force) states.push_back(ContactState::open);
    else if (std::abs(p[2 * i + 1]) < bound * (1.0 - 1e-10)) states.push_back(ContactState::stick);
    else states.push_back(std::abs(motion[2 * i + 1]) > 1e-12 * scales.length ? ContactState::slip
                          : problem.mu[i] > 0.0 ? ContactState::stick : ContactState::slip);
  }
  return states;
}

}  // namespace

Solution solve(const Problem& problem, const Start& start, const SolverOptions& options) {
  const Eigen::Index N = problem.pairs(), m = problem.G.cols();
  Solution solution;
  const Vector p_start = start.p.size() == 2 * N ? start.p : Vector::Zero(2 * N);
  const Scaled scaled_problem = scaled(problem);
  const Vector a_start =
      start.a.size() == m ? Vector(scaled_problem.stiffness * start.a) : Vector(Vector::Zero(m));

  if (const auto motion = find_mechanism(problem)) {
    solution.status = Status::mechanism;
    solution.motion = *motion;
    solution.p = p_start;
    solution.a = a_start / scaled_problem.stiffness;
    solution.reason = "a rigid motion is held neither by supports nor by contact and friction";
  }

  const double q_force = largest_of(scaled_problem.problem.q);
  const double applied = std::max({options.force_scale, largest_of(problem.f), largest_of(p_start)});
  const double reference = applied > 0.0 ? applied : q_force > 0.0 ? q_force : 1.0;

  // Well below the tolerance, but not below the rounding of the gaps themselves (a body that hovers far away).
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * q_force;
  Attempts attempts(scaled_problem.problem, options, std::max(0.01 * options.tolerance * reference, rounding));
  NewtonEnd end;
  if (solution.status != Status::mechanism) {
    end = attempts.climb(p_start, a_start);
    solution.p = end.p;
    solution.a = end.a / scaled_problem.stiffness;
  }
  solution.iterations = attempts.iterations();
  solution.trace = attempts.trace();

  Vector motion = problem.q + problem.W * solution.p;
  if (m > 0) motion += problem.G * solution.a;
  const double largest = std::max(reference, largest_of(solution.p));
  const Scales scales{largest, largest / scaled_problem.stiffness};
  solution.residual = end.residual / largest;
  solution.certificate = certify(problem, solution.p, solution.a, scales);
  solution.natural_map_residual = natural_map_residual(problem, solution.p, solution.a);
  solution.gap.resize(N);
  solution.slip_increment.resize(N);
  for (Eigen::Index i = 0; i < N; ++i) {
    solution.gap[i] = motion[2 * i];
    solution.slip_increment[i] = motion[2 * i + 1];
  }
  solution.states = states_of(problem, solution.p, motion, scales);
  if (solution.status == Status::mechanism) return solution;
  if (solution.certificate.worst() <= options.tolerance) {
    solution.status = Status::solved;
    solution.undetermined = undetermined_motions(problem, solution.states);
  } else {
    solution.reason = end.singular ? "contact forces could not balance the loads on any branch tried"
                                   : "the Newton iterations stalled from every start tried";
  }
  return solution;
}

}  // namespace scabo::contact
