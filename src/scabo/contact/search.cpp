#include "scabo/contact/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace scabo::contact {

Search::Search(const Problem& problem, const Start& start, const SolverOptions& options)
    : options_(options),
      stiffness_(stiffness_of(problem)),
      scaled_(problem),
      measure_(problem, start.p.size() == problem.q.size() ? start.p : Vector(Vector::Zero(problem.q.size())),
               options.force_scale),
      touching_(start.touching),
      best_residual_(HUGE_VAL) {
  scaled_.W = problem.W.scaled(stiffness_);
  scaled_.q *= stiffness_;
  const Eigen::Index n = problem.q.size(), m = problem.G.cols();
  start_.p = start.p.size() == n ? start.p : Vector(Vector::Zero(n));
  start_.a = start.a.size() == m ? Vector(stiffness_ * start.a) : Vector(Vector::Zero(m));
  has_history_ = !start_.p.isZero(0.0);
  best_ = start_;

  const double epsilon = std::numeric_limits<double>::epsilon(), reference = measure_.reference();
  small_ = by_natural_map() ? epsilon * reference : 0.01 * options.tolerance * reference;
  // Of the gaps themselves: a body far above its support, or that springs would allow to go far.
  if (n > 0) rounding_ = 4.0 * epsilon * scaled_.q.lpNorm<Eigen::Infinity>();
  // The certificate knows complementarity as a product, p_n g; where it decides, the natural map must be small as well.
  const double asked = 0.9 * options.tolerance, asked_of_map = by_natural_map() ? asked : 100.0 * asked;
  accepts_ = [this, asked, asked_of_map, in_forces = measure_.of_forces()](const Vector& p, const Vector& a,
                                                                           const Vector& motion) {
    return in_forces.natural_map(scaled_, p, motion) <= asked_of_map &&
           contact::judge(scaled_, p, a, motion, in_forces, options_.judge).solved(asked);
  };
}

NewtonEnd Search::newton_from(Point from, const NewtonRun& run) {
  NewtonOptions options;
  options.small = small_;
  options.rounding = rounding_;
  if (!by_natural_map()) options.relative = 0.01 * options_.tolerance;
  options.iterations = run.iterations > 0 ? run.iterations : options_.iterations;
  options.patience = run.patience;
  options.stage = run.stage;
  options.deadline = options_.deadline;
  options.accepts = accepts_;
  options.ask_when_stuck = !by_natural_map();
  if (options_.on_iteration)
    options.on_iteration = [this, before = iterations_ + coarse_iterations_](Iteration iteration) {
      iteration.iteration += before;
      options_.on_iteration(iteration);
    };
  NewtonEnd end = newton(equations(), std::move(from.p), std::move(from.a), options);
  add_trace(end.trace, end.iterations);
  offer(end.p, end.a, end.residual, end.converged);
  return end;
}

void Search::offer(const Vector& p, const Vector& a, double residual, bool solved) {
  if (solved_ ? !(solved && residual < best_residual_) : !(solved || residual < best_residual_)) return;
  best_ = {p, a};
  best_residual_ = residual;
  solved_ = solved;
}

double Search::residual_at(const Vector& p, const Vector& a) const { return equations().residual(p, a).largest(); }

void Search::add_trace(std::vector<Iteration> trace, int iterations, double force) {
  for (Iteration& iteration : trace) {
    iteration.iteration += iterations_ + coarse_iterations_;
    iteration.residual *= force;
    trace_.push_back(std::move(iteration));
  }
  iterations_ += iterations;
}

void Search::add_coarse(std::vector<Iteration> trace, int iterations) {
  add_trace(std::move(trace), 0);
  coarse_iterations_ += iterations;
}

}  // namespace scabo::contact
