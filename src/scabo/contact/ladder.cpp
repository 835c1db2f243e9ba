#include "scabo/contact/ladder.hpp"

#include <optional>

#include "scabo/contact/interior_point.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/newton_direction.hpp"
#include "scabo/contact/plane_interior_points.hpp"
#include "scabo/contact/rigid_motions.hpp"
#include "scabo/contact/soft_newton.hpp"
#include "scabo/contact/starts/bonded_start.hpp"
#include "scabo/contact/starts/cold_start.hpp"
#include "scabo/contact/starts/kept_states.hpp"

namespace scabo::contact {

Scaled scaled(const Problem& problem) {
  Scaled result{problem, stiffness_of(problem)};
  result.problem.W = problem.W.scaled(result.stiffness);
  result.problem.q *= result.stiffness;
  return result;
}

Ladder::Ladder(const Problem& scaled_problem, const SolverOptions& options, double small, IsSolution content)
    : problem_(scaled_problem), options_(options), small_(small), content_(std::move(content)) {}

std::function<void(const Iteration&)> Ladder::counted(const std::function<void(const Iteration&)>& tell) const {
  if (!tell) return {};
  return [tell, before = iterations_ + coarse_iterations_](Iteration iteration) {
    iteration.iteration += before;
    tell(iteration);
  };
}

NewtonEnd Ladder::run(const Problem& problem, const Vector& p, const Vector& a, const Run& how) {
  const BDifferentiableEquations equations(problem, options_.r_factor * how.r_factor);
  NewtonOptions options;
  options.small = small_;
  if (options_.judge == Judge::certificate) options.relative = 0.01 * options_.tolerance;
  options.iterations = how.iterations > 0 ? how.iterations : options_.iterations;
  options.regularisation = how.regularisation;
  options.patience = how.patience;
  options.fall = how.fall;
  options.first_fall = how.first_fall;
  options.first_step = how.first_step;
  options.undecided = how.undecided;
  options.watched = how.watched;
  options.stage = how.stage;
  options.deadline = options_.deadline;
  options.on_iteration = counted(options_.on_iteration);
  if (&problem == &problem_) options.content = content_;
  options.ask_when_stuck = !judges_all();
  NewtonEnd end =
      how.soft && may_soften(problem) ? soft_newton(equations, p, a, options) : newton(equations, p, a, options);
  for (Iteration& iteration : end.trace) {
    iteration.iteration += iterations_ + coarse_iterations_;
    trace_.push_back(std::move(iteration));
  }
  iterations_ += end.iterations;
  return end;
}

NewtonEnd Ladder::climb(const Vector& p, const Vector& a, const std::vector<bool>& touching,
                        const std::function<bool()>& hopeless) {
  touching_ = &touching;
  if (options_.judge == Judge::natural_map && problem_.G.cols() == 0 && may_sweep())
    return climb_rank_deficient(p, hopeless);
  NewtonEnd end = climb_elastic(p, a, touching, hopeless);
  if (end.converged || late() || collapse() || judges_all()) return end;
  NewtonEnd last = with_bodies_held();
  return last.converged || last.residual < end.residual ? last : end;
}

const std::optional<BondedStart>& Ladder::held_together() {
  if (!held_together_) held_together_ = may_bond(problem_) ? bonded_start(problem_, *touching_) : std::nullopt;
  return *held_together_;
}

NewtonEnd Ladder::climb_elastic(const Vector& p, const Vector& a, const std::vector<bool>& touching,
                                const std::function<bool()>& hopeless) {
  const bool cold = p.isZero(0.0), many = may_bond(problem_);
  NewtonEnd best = nothing();
  best.p = p;
  best.a = a;
  const auto better = [&](NewtonEnd end) {
    if (end.converged || end.residual < best.residual) best = std::move(end);
    return best.converged || late() || bodies_fall();
  };
  // From the last increment Newton converges in a few iterations or creeps from kink to kink, while a strategy below
  // needs less than ten (a culvert of 340 pairs under traffic: 50 and 7).
  constexpr int patience = 8;
  constexpr int few = 3;  // of many bodies a path takes over sooner: it needs 2 to 9 factorisations
  const bool paths = many && may_follow_path(problem_), paths_first = paths && problem_.pairs() <= most_of_paths_first;
  // Products of interior points from the last increment, over those from bonded forces.
  constexpr double near_by = 0.025;
  const int most = paths ? std::min(few, options_.iterations) : 0;
  const bool inner = many && may_take_plane_interior_points(problem_);
  if (!cold && !many && problem_.G.cols() > 0 && better(on_kept_states(p, a))) return best;
  if (!cold && inner && !paths_first) {
    constexpr int most_of_soft = 14, most_before_path = 5, slowly = 5;
    const bool crosses = may_cross_over();
    if (better(softly(p, a, {"newton", 0.0, 1.0, crosses ? most_before_path : most_of_soft, slowly}))) return best;
    if (crosses && better(crossed_over({{best.p, best.a}}))) return best;
    if (better(inside_near(best.p, best.a, near_by))) return best;
  } else if (!cold) {
    Run how{"newton", 0.0, 1.0, most, patience};
    if (paths) how.first_fall = 0.15;  // as in bonded()
    const bool held = !many && problem_.G.cols() == 0;
    if (better(held ? newton_or_kept_states(p, a, how) : newton_of_many(p, a, how))) return best;
  }
  if (!cold && paths && better(along_loads(p, a))) return best;
  if (held_together() && better(bonded(*held_together()))) return best;
  if (hopeless && hopeless()) return best;
  // Newton's method may end beside the solution, of whose states some are wrong: |H| of 1e-6 of the largest force.
  constexpr double beside = 1e-2, start_beside = 1e-6;
  if (cold && inner && !paths_first && best.residual <= beside * best.p.lpNorm<Eigen::Infinity>()) {
    if (may_cross_over() && better(crossed_over({{best.p, best.a}}))) return best;
    if (better(inside_near(best.p, best.a, start_beside))) return best;
  }
  if (inner && !paths_first && held_together())
    for (const double start : {1.0, 0.05})
      if (better(inside_near(held_together()->p, held_together()->a, start))) return best;
  if (paths && held_together()) {
    if (better(along_paths(*held_together(), touching))) return best;
    // Where Newton's method ends far away, paths may turn back below a load that is carried.
    if (collapse() && inner && paths_first)
      for (const double start : {1.0, 0.05})
        if (better(inside_near(held_together()->p, held_together()->a, start))) return best;
    if (collapse()) return best;
  }
  if (inner) {
    if (may_take_interior_points(problem_) && better(inside({1.0, 10.0, 1000.0}))) return best;
    // Of more bodies nothing that follows was ever seen to succeed, and it takes minutes.
    if (has_many_motions(problem_)) return best;
  }
  if (cold && holding_pays(problem_, problem_.q.size()))
    if (std::optional<ColdStart> sampled = sampled_start(problem_, a))
      if (better(after_start(std::move(*sampled), {"newton"}))) return best;
  if (cold && holding_pays(problem_, problem_.q.size()))
    if (const std::optional<BondedStart> joined = joined_start(problem_, touching))
      if (better(newton_alone(joined->p, joined->a, {"newton"}))) return best;
  if (cold && better(may_sweep() ? without_history(p, a) : newton_alone(p, a, {"newton"}))) return best;
  if (!many && may_follow_path(problem_)) {
    if (!cold && better(along_loads(p, a))) return best;
    const std::optional<BondedStart> start = bonded_start(problem_, touching);
    if (start && (better(along_paths(*start, touching)) || collapse())) return best;
  }
  const bool held = problem_.G.cols() == 0;
  if (!held && may_sweep() && better(floating_proximal(p, a))) return best;
  if (held && may_sweep() && better(swept(p, 20, 1e-4))) return best;
  if (better(growing_friction(p, a))) return best;
  if (may_sweep() && better(after_sweeps(p, a))) return best;
  if (held && better(after_pivoting(problem_))) return best;
  if (better(growing_load(p, a))) return best;
  for (double factor : {0.1, 10.0, 0.01, 100.0})
    if (better(newton_alone(p, a, {"newton, other r", 0.0, factor}))) return best;
  if (held) better(vanishing_proximal(best.p));
  return best;
}

/// Newton's method where supports hold all bodies. It takes one or two iterations from the last increment or from fewer
/// pairs, but where all pairs of a closed crack seem to slip, they come back to sticking ring by ring around its tip
/// (51 iterations).
NewtonEnd Ladder::newton_or_kept_states(const Vector& p, const Vector& a, Run how) {
  constexpr int soon = 8;
  constexpr double nearer = 0.01;  // where some pairs do change, Newton has come as near in these iterations
  if (options_.iterations <= soon) return newton_alone(p, a, how);
  how.iterations = soon;
  NewtonEnd end = newton_alone(p, a, how);
  if (end.converged || late() || end.iterations < soon) return end;
  NewtonEnd kept = on_kept_states(p, a, nearer * end.residual);
  if (kept.converged || kept.residual < end.residual) end = std::move(kept);
  if (end.converged || late()) return end;
  how.iterations = 0;
  NewtonEnd more = newton_alone(end.p, end.a, how);
  return more.converged || more.residual < end.residual ? more : end;
}

/// Newton from where the loads lead as long as no pair changes its state, if that is nearer than the last increment and
/// has a smaller |H| than `best`.
NewtonEnd Ladder::on_kept_states(const Vector& p, const Vector& a, double best) {
  constexpr int few = 8;
  constexpr double nearer = 0.1;  // merit: of points that are hardly better, Newton takes as long as from those before
  const BDifferentiableEquations equations(problem_, options_.r_factor);
  const Residual before = equations.residual(p, a);
  if (before.largest() <= small_) return nothing();  // nothing has changed
  const std::optional<KeptStates> kept = keep_states(equations, p, a, before);
  if (!kept) return nothing();
  trace_.push_back({iterations_ + coarse_iterations_, before.largest(), before.merit(), 0.0, 0, "states kept"});
  if (options_.on_iteration) options_.on_iteration(trace_.back());
  ++iterations_;
  const Residual there = equations.residual(kept->p, kept->a);
  if (!(there.merit() < nearer * before.merit() && there.largest() < best)) return nothing();
  return newton_alone(kept->p, kept->a, {"newton", 0.0, 1.0, std::min(few, options_.iterations)});
}

NewtonEnd Ladder::without_history(const Vector& p, const Vector& a) {
  const bool nested = options_.judge == Judge::certificate && may_nest(problem_);
  if (nested) {
    // What converges takes 1 to 4 iterations. A pin in its bore did not at some coefficients of friction, 0.1 and 0.15:
    // sweeps follow with 51 iterations, and a start from zero with 51 more, where interior points take 7 to 9.
    constexpr int few = 10;
    const bool inner = problem_.G.cols() > 0 && may_take_plane_interior_points(problem_);
    ColdStart start = nested_start(problem_, a);
    take_trace_of(start);
    const NewtonEnd end =
        problem_.G.cols() == 0
            ? newton_or_kept_states(start.p, start.a, {"newton"})
            : newton_alone(start.p, start.a, {"newton", 0.0, 1.0, inner ? std::min(few, options_.iterations) : 0});
    if (end.converged || late()) return end;
    if (const std::optional<BondedStart> bonded = inner ? bonded_start(problem_, {}) : std::nullopt) {
      const NewtonEnd near = inside_near(bonded->p, bonded->a, 1.0);
      if (near.converged || late()) return near;
    }
  }
  NewtonEnd end = after_start(swept_start(problem_, a), {nested ? "newton after sweeps" : "newton"});
  return end.converged || problem_.G.cols() == 0 ? end : newton_alone(p, a, {"newton from zero"});
}

void Ladder::take_trace_of(ColdStart& start) {
  for (Iteration& iteration : start.trace) {
    iteration.iteration += iterations_ + coarse_iterations_;
    trace_.push_back(std::move(iteration));
  }
  coarse_iterations_ += start.coarse_iterations;
}

NewtonEnd Ladder::after_start(ColdStart start, const Run& how) {
  take_trace_of(start);
  return newton_alone(start.p, start.a, how);
}

/// Gauss-Seidel needs columns of W.
bool Ladder::may_sweep() const {
  constexpr Eigen::Index most_formed = 5000;
  return problem_.W.is_dense() || problem_.W.is_sparse() || problem_.W.size() <= most_formed;
}

}  // namespace scabo::contact
