// Strategies of the ladder for problem files, whose W is often rank deficient: sweeps and interior points in turn.
#include <optional>

#include "scabo/contact/held_slips.hpp"
#include "scabo/contact/interior_point.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/ladder.hpp"
#include "scabo/contact/starts/gauss_seidel.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

// Measured on the 27 problems of FCLIB that come with Siconos: 20 sweeps and 1e-4 solve all but two of them, 200
// sweeps and 1e-2 those; long sweeps solve two of the three Capsules before any Newton iteration. Stacks of rigid
// bodies need their states nearly right before Newton converges, and either sweeps or interior points find them (34
// towers, walls and piles, benchmarks/contact/rigid.py). Sweeps are cheap and come first: they solve piles and broad
// walls. Interior points solve tall towers and large ratios of masses, from one start or another. They take turns, the
// sweeps for longer each time.
NewtonEnd Ladder::climb_rank_deficient(const Vector& p, const std::function<bool()>& hopeless) {
  // Of many pairs sweeps tell little before they have carried forces from one end to the other.
  constexpr int many = 2000;
  const bool inner = problem_.W.is_sparse() && may_take_interior_points(problem_);
  // Where a row of W has many entries, many pairs lie between the same bodies: nearly all states must be right before
  // Newton converges, and an iteration costs as much as hundreds of sweeps.
  const bool entwined = inner && problem_.W.sparse().nonZeros() > 60 * problem_.W.size();
  LongSweeps sweeps(problem_, p);
  NewtonEnd best = nothing();
  best.p = p;
  const auto better = [&](NewtonEnd end) {
    if (end.converged || end.residual < best.residual) best = std::move(end);
    return best.converged || late();
  };
  if (problem_.pairs() <= many && better(swept_on(sweeps, 500))) return best;
  if (hopeless && hopeless()) return best;
  // FCLIB needs 27 iterations at most.
  const int few = entwined ? 4 : inner ? 30 : 0;
  // Of many joints it costs as much as a thousand sweeps, and their states are wrong for long.
  const bool many_joints = problem_.pairs() > many && inner && sweeps.of_joints();
  const Run from_sweeps{"newton after " + std::to_string(sweeps.sweeps()) + " sweeps", 1e-4, 1.0, few};
  if (!many_joints &&
      better(problem_.pairs() > many ? swept(p, 200, 1e-2, few) : newton_alone(sweeps.p(), Vector(), from_sweeps)))
    return best;
  // Of spheres in a pile plain sweeps find what extrapolated ones, Newton and interior points do not.
  constexpr double near = 1e-4;
  if (inner && !sweeps.of_joints() && sweeps.natural_map() <= near) {
    LongSweeps plain(problem_, p, LongSweeps::Form::plain);
    if (better(swept_on(plain, 20000))) return best;
  }
  // What a factorisation without fill would cost. Above, a step of interior points takes as long as a thousand sweeps.
  const double entries = inner ? static_cast<double>(problem_.W.sparse().nonZeros()) : 0.0;
  // That of joints never does.
  const bool dear = !sweeps.of_joints() && entries * entries > 6e7 * static_cast<double>(problem_.W.size());
  struct Turn {
    int sweeps;
    double start;       // of the interior points after them; 0: none
    int rounds = 0;     // of held slips after those
    double fall = 0.0;  // what a round leaves of their distance; otherwise they are given up
  };
  // Walls and piles that slips held solve at all take up to twenty rounds in which they nearly halve, or far more.
  constexpr int few_rounds = 20, many_rounds = 300;
  constexpr double nearly_half = 0.65, any = HUGE_VAL;
  std::optional<HeldSlips> held;
  constexpr double nearly_right = 1e-5;              // natural map: of nearly all states
  double tried = many_joints ? 1e-7 : nearly_right;  // natural map from which Newton was last tried
  bool inside_before = false;
  for (const Turn turn : {Turn{2000, dear ? 0.0 : 1.0}, Turn{8000, 0.0, few_rounds, nearly_half},
                          Turn{25000, dear ? 1.0 : 0.1, many_rounds, any}, Turn{60000, dear ? 0.1 : 10.0}}) {
    if (better(swept_on(sweeps, turn.sweeps))) return best;
    if (sweeps.natural_map() <= 0.3 * tried) {
      tried = sweeps.natural_map();
      if (better(newton_alone(sweeps.p(), Vector(), {"newton after long sweeps", 1e-4, 1.0, 12}))) return best;
    }
    // What starts afresh does not come as near within few steps.
    const bool near_by = sweeps.natural_map() <= nearly_right;
    if (inner && turn.start > 0.0 && !(near_by && inside_before)) {
      inside_before = true;
      NewtonEnd reached = inside_from(turn.start);
      sweeps.restart(reached.p);
      if (better(std::move(reached))) return best;
    }
    // Of rigid bodies a Newton iteration costs as much as fifty sweeps. pile100x4_mu0.8_ratio100 is solved so.
    constexpr int most_of_proximal = 250;
    if (turn.sweeps == 25000 && sweeps.of_joints() && better(vanishing_proximal(best.p, most_of_proximal))) return best;
    const bool too_soon = turn.rounds == few_rounds && (near_by || many_joints);
    if (inner && sweeps.of_joints() && turn.rounds > 0 && !too_soon) {
      if (!held) held.emplace(problem_);
      if (better(with_held_slips(*held, turn.rounds, turn.fall))) return best;
    }
  }
  // Without joints a round costs as much as thousands of sweeps.
  if (inner && !dear && !held) {
    held.emplace(problem_);
    if (better(with_held_slips(*held, many_rounds, any))) return best;
  }
  if (better(newton_alone(sweeps.p(), Vector(), {"newton after long sweeps", 1e-4}))) return best;
  if (problem_.pairs() <= many && better(swept(p, 200, 1e-2))) return best;
  if (!sweeps.of_joints() && better(vanishing_proximal(best.p))) return best;
  if (better(after_pivoting(problem_))) return best;
  if (better(growing_friction(p, Vector()))) return best;
  for (double factor : {0.1, 10.0, 0.01, 100.0})
    if (better(newton_alone(best.p, Vector(), {"newton, other r", 1e-2, factor}))) return best;
  better(swept_on(sweeps, 200000));
  return best;
}

/// Sweeps, then Newton. Where a judge is content with what the sweeps found, nothing else is needed.
NewtonEnd Ladder::swept(const Vector& p, int sweeps, double regularisation, int iterations) {
  GaussSeidel iteration(problem_);
  Vector swept = p;
  iteration.start(swept);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    options_.deadline.spend(operations_of_sweep(problem_));
    const bool still = iteration.sweep(swept) <= 1e-12 * swept.lpNorm<Eigen::Infinity>();
    if (judges_all() && content_(swept, Vector(), iteration.motion())) {
      iteration.start(swept);  // the motion afresh, without what rounding added from pair to pair
      if (content_(swept, Vector(), iteration.motion())) {
        NewtonEnd end = end_of_sweeps(std::move(swept), sweep + 1);
        end.converged = true;
        return end;
      }
    }
    if (still || late()) break;
  }
  return newton_alone(swept, Vector(),
                      {"newton after " + std::to_string(sweeps) + " sweeps", regularisation, 1.0, iterations});
}

/// Until `most` sweeps are done in all, and longer while they gain.
NewtonEnd Ladder::swept_on(LongSweeps& sweeps, int most) {
  const bool accepted = sweeps.run(most, content_, options_.deadline);
  NewtonEnd end = end_of_sweeps(sweeps.p(), sweeps.sweeps());
  end.converged = accepted;
  return end;
}

InteriorPointEnd Ladder::interior_points_from(double start_factor) {
  InteriorPointEnd reached = interior_points(problem_, content_, options_.deadline, start_factor);
  const double force = Measure(problem_).reference();
  for (Iteration& iteration : reached.trace) {
    iteration.iteration += iterations_ + coarse_iterations_;
    iteration.residual *= force;
    trace_.push_back(std::move(iteration));
  }
  iterations_ += reached.iterations;
  return reached;
}

/// Interior points from one start. Where their steps collapse near a solution, a few sweeps or a few Newton iterations
/// reach it.
NewtonEnd Ladder::inside_from(double start_factor) {
  constexpr double near = 1e-4;  // natural map
  InteriorPointEnd reached = interior_points_from(start_factor);
  if (reached.p.size() == 0) return nothing();
  NewtonEnd end;
  end.residual = BDifferentiableEquations(problem_, options_.r_factor).residual(reached.p, Vector()).largest();
  end.p = std::move(reached.p);
  end.converged = reached.content;
  if (end.converged || late()) return end;
  LongSweeps sweeps(problem_, end.p);
  NewtonEnd after = swept_on(sweeps, 200);
  if (after.converged || late() || reached.residual > near) return after;
  return newton_alone(end.p, Vector(), {"newton after interior points", 1e-6, 1.0, 12});
}

/// Rounds with slips held, and a few Newton iterations whenever the natural map has become small: by then nearly all
/// states are right.
NewtonEnd Ladder::with_held_slips(HeldSlips& held, int rounds, double fall) {
  constexpr int few = 12;
  const double force = Measure(problem_).reference();
  NewtonEnd best = nothing();
  double aim = 1e-5;
  while (true) {
    InteriorPointEnd reached = held.advance(aim, rounds, fall, content_, options_.deadline);
    for (Iteration& iteration : reached.trace) {
      iteration.iteration += iterations_ + coarse_iterations_;
      iteration.residual *= force;
      trace_.push_back(std::move(iteration));
    }
    iterations_ += reached.iterations;
    if (reached.p.size() == 0) return best;
    NewtonEnd end = nothing();
    end.residual = BDifferentiableEquations(problem_, options_.r_factor).residual(reached.p, Vector()).largest();
    end.p = std::move(reached.p);
    end.converged = reached.content;
    if (end.converged || end.residual < best.residual) best = std::move(end);
    if (best.converged || late() || reached.residual > aim) return best;
    NewtonEnd after = newton_alone(best.p, Vector(), {"newton after held slips", 1e-4, 1.0, few});
    if (after.converged || after.residual < best.residual) best = std::move(after);
    if (best.converged || late()) return best;
    aim = 0.1 * reached.residual;
  }
}

/// The point that sweeps ended with, and its line in the trace.
NewtonEnd Ladder::end_of_sweeps(Vector p, int sweeps) {
  NewtonEnd end;
  const Residual at = BDifferentiableEquations(problem_, options_.r_factor).residual(p, Vector());
  end.p = std::move(p);
  end.residual = at.largest();
  trace_.push_back(
      {iterations_ + coarse_iterations_, end.residual, at.merit(), 1.0, 0, std::to_string(sweeps) + " sweeps"});
  return end;
}

}  // namespace scabo::contact
