#include "scabo/contact/ladder.hpp"

#include <cmath>
#include <optional>

#include "scabo/contact/interior_point.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/contact/lemke.hpp"
#include "scabo/contact/newton_direction.hpp"
#include "scabo/contact/plane_interior_points.hpp"
#include "scabo/contact/rigid_motions.hpp"
#include "scabo/contact/starts/bonded_start.hpp"
#include "scabo/contact/starts/cold_start.hpp"
#include "scabo/contact/starts/gauss_seidel.hpp"

namespace scabo::contact {

namespace {

/// Pairs of many bodies up to which a path comes before interior points: each of its changes of state costs a solve
/// (16 x 16 blocks, 2,260 pairs, 0.9 of the limit load: 11 s and 4 s).
constexpr int most_of_paths_first = 1000;
/// Pairs from which most of a path is taken in leaps. Of fewer a factorisation costs as much as fifty changes.
constexpr int least_of_leaps = 4000;

NewtonEnd nothing() {
  NewtonEnd end;
  end.residual = HUGE_VAL;
  return end;
}

/// Whether a path was followed to where bodies move on. Not if that is where the loads are reached but for rounding, as
/// where all loads are taken away.
bool tells_of_a_fall(const PathEnd& end) {
  constexpr double rounding = 1e-6;
  return end.how != PathEnd::How::broken && end.left > rounding;
}

}  // namespace

Scaled scaled(const Problem& problem) {
  Scaled result{problem, stiffness_of(problem)};
  result.problem.W = problem.W.scaled(result.stiffness);
  result.problem.q *= result.stiffness;
  return result;
}

Ladder::Ladder(const Problem& scaled_problem, const SolverOptions& options, double small,
               std::function<bool(const Vector& p, const Vector& motion)> content)
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
  options.soft = how.soft;
  options.stage = how.stage;
  options.deadline = options_.deadline;
  options.on_iteration = counted(options_.on_iteration);
  if (&problem == &problem_) options.content = content_;
  options.ask_when_stuck = !judges_all();
  NewtonEnd end = newton(equations, p, a, options);
  for (Iteration& iteration : end.trace) {
    iteration.iteration += iterations_ + coarse_iterations_;
    trace_.push_back(std::move(iteration));
  }
  iterations_ += end.iterations;
  return end;
}

NewtonEnd Ladder::climb(const Vector& p, const Vector& a, const std::vector<bool>& touching,
                        const std::function<bool()>& hopeless) {
  return options_.judge == Judge::natural_map && problem_.G.cols() == 0 && may_sweep()
             ? climb_rank_deficient(p, hopeless)
             : climb_elastic(p, a, touching, hopeless);
}

NewtonEnd Ladder::climb_elastic(const Vector& p, const Vector& a, const std::vector<bool>& touching,
                                const std::function<bool()>& hopeless) {
  const bool cold = p.isZero(0.0), many = may_bond(problem_);
  NewtonEnd best = nothing();
  best.p = p;
  best.a = a;
  const auto better = [&](NewtonEnd end) {
    if (end.converged || end.residual < best.residual) best = std::move(end);
    return best.converged || late();
  };
  // From the last increment Newton converges in a few iterations or creeps from kink to kink, while a strategy below
  // needs less than ten (a culvert of 340 pairs under traffic: 50 and 7).
  constexpr int patience = 8;
  constexpr int few = 6;  // of many bodies a path takes over sooner
  const bool paths = many && may_follow_path(problem_), paths_first = paths && problem_.pairs() <= most_of_paths_first;
  const int most = paths ? std::min(few, options_.iterations) : 0;
  const bool inner = many && may_take_interior_points(problem_);
  if (!cold && better(newton_alone(p, a, {"newton", 0.0, 1.0, most, patience}))) return best;
  if (!cold && inner && !paths_first && better(inside_near(best.p, best.a, 1.0))) return best;
  if (!cold && paths && better(along_loads(p, a))) return best;
  const std::optional<BondedStart> held_together = many ? bonded_start(problem_, touching) : std::nullopt;
  if (held_together && better(bonded(*held_together))) return best;
  if (hopeless && hopeless()) return best;
  if (inner && !paths_first && held_together)
    for (const double start : {1.0, 20.0})
      if (better(inside_near(best.p, best.a, start))) return best;
  if (paths && held_together && (better(along_paths(*held_together, touching)) || collapse())) return best;
  if (inner) {
    if (better(inside({1.0, 10.0, 1000.0}))) return best;
    // Of more bodies nothing that follows was ever seen to succeed, and it takes minutes.
    if (has_many_motions(problem_)) return best;
  }
  if (cold && !problem_.W.is_dense() && !problem_.W.is_sparse())
    if (std::optional<ColdStart> sampled = sampled_start(problem_, a))
      if (better(after_start(std::move(*sampled), "newton"))) return best;
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

NewtonEnd Ladder::bonded(const BondedStart& start) {
  // What converges takes 3 to 10 iterations; a path takes 2 to 10 factorisations, whatever happens.
  const bool small = problem_.pairs() <= most_of_paths_first;
  const int most = may_follow_path(problem_) ? std::min(small ? 6 : 10, options_.iterations) : 0;
  Run how{"newton", 0.0, 1.0, most};
  if (!small) how.patience = 2, how.fall = 0.1;  // what falls more slowly takes more iterations than interior points
  return newton_alone(start.p, start.a, how);
}

/// The path of the loads from the last increment to this one.
NewtonEnd Ladder::along_loads(const Vector& p, const Vector& a) {
  PathStart start{p, a, {}, 1e-6, 0.0};
  for (Eigen::Index i = 0; i < problem_.pairs(); ++i)
    start.states.push_back(p[2 * i] > 0.0 ? ContactState::stick : ContactState::open);
  PathEnd end = along_path(start);
  if (end.how == PathEnd::How::arrived) return arrived(std::move(end));
  may_fall_ = tells_of_a_fall(end);
  if (may_fall_) collapse_ = Collapse{std::move(end.motion), 1.0 - end.left};
  return nothing();
}

/// Paths from bonded pairs, pressed together first. Where none arrives although each was followed to its end, and that
/// of the loads as well if there is one, the bodies fall.
NewtonEnd Ladder::along_paths(const BondedStart& bonded, const std::vector<bool>& touching) {
  PathStart start{bonded.p, bonded.a, {}, 1e-2, 0.0};
  for (std::size_t i = 0; i < static_cast<std::size_t>(problem_.pairs()); ++i)
    start.states.push_back(touching.empty() || touching[i] ? ContactState::stick : ContactState::open);
  for (const double pressure : {10.0, 1.0}) {
    start.pressure = pressure;
    PathEnd end = along_path(start);
    if (end.how == PathEnd::How::arrived) {
      NewtonEnd found = arrived(std::move(end));
      if (found.converged) return found;
      may_fall_ = false;
    } else if (!tells_of_a_fall(end)) {
      may_fall_ = false;
    } else if (!collapse_) {
      collapse_ = Collapse{std::move(end.motion), 0.0};
    }
    if (late()) break;
  }
  return nothing();
}

NewtonEnd Ladder::arrived(PathEnd end) {
  NewtonEnd found = nothing();
  found.p = std::move(end.p);
  found.a = std::move(end.a);
  constexpr int few = 4;
  return confirmed(std::move(found), few, "path");
}

/// One iteration for every matrix factorised.
PathEnd Ladder::along_path(const PathStart& start) {
  const BDifferentiableEquations equations(problem_, options_.r_factor);
  PathOptions options;
  options.deadline = options_.deadline;
  if (problem_.pairs() > most_of_paths_first) {
    const int pairs = problem_.pairs();
    options.changes = 100;
    options.leap = pairs > least_of_leaps ? 6 : 0;
    // Paths that arrive take up to two changes for each pair; of more pairs it would take minutes.
    options.most = pairs > least_of_leaps ? 1500 + pairs / 10 : 2 * pairs + 100;
    options.patience = 300 + pairs / 20;
  }
  options.on_factorisation = [&](const Vector& p, const Vector& a) {
    const Residual at = equations.residual(p, a);
    trace_.push_back({++iterations_ + coarse_iterations_, at.largest(), at.merit(), 1.0, 0, "path"});
    if (options_.on_iteration) options_.on_iteration(trace_.back());
  };
  return follow_path(problem_, start, options);
}

/// States are certain when Newton has confirmed them. Where pairs are redundant it may not; then the point itself is
/// kept if it is a solution.
NewtonEnd Ladder::confirmed(NewtonEnd found, int few, const std::string& name) {
  const Residual at = BDifferentiableEquations(problem_, options_.r_factor).residual(found.p, found.a);
  found.residual = at.largest();
  found.converged = content_ && content_(found.p, at.motion);
  Run how{"newton after " + name, 0.0, 1.0, few};
  how.soft = has_many_motions(problem_);
  NewtonEnd end = newton_alone(found.p, found.a, how);
  if ((end.converged && end.residual <= found.residual) || !found.converged) return end;
  trace_.push_back({iterations_ + coarse_iterations_, found.residual, at.merit(), 0.0, 0, name + " kept"});
  return found;
}

NewtonEnd Ladder::without_history(const Vector& p, const Vector& a) {
  const bool nested = options_.judge == Judge::certificate && may_nest(problem_);
  if (nested) {
    const NewtonEnd end = after_start(nested_start(problem_, a), "newton");
    if (end.converged || late()) return end;
  }
  NewtonEnd end = after_start(swept_start(problem_, a), nested ? "newton after sweeps" : "newton");
  return end.converged || problem_.G.cols() == 0 ? end : newton_alone(p, a, {"newton from zero"});
}

NewtonEnd Ladder::after_start(ColdStart start, const std::string& stage) {
  for (Iteration& iteration : start.trace) {
    iteration.iteration += iterations_ + coarse_iterations_;
    trace_.push_back(std::move(iteration));
  }
  coarse_iterations_ += start.coarse_iterations;
  return newton_alone(start.p, start.a, {stage});
}

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
  const auto better = [&](NewtonEnd end) {
    if (end.converged || end.residual < best.residual) best = std::move(end);
    return best.converged || late();
  };
  if (problem_.pairs() <= many && better(swept_on(sweeps, 500))) return best;
  if (hopeless && hopeless()) return best;
  // FCLIB needs 27 iterations at most.
  const int few = entwined ? 4 : inner ? 30 : 0;
  const Run from_sweeps{"newton after " + std::to_string(sweeps.sweeps()) + " sweeps", 1e-4, 1.0, few};
  if (better(problem_.pairs() > many ? swept(p, 200, 1e-2, few) : newton_alone(sweeps.p(), Vector(), from_sweeps)))
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
    double start;                // of the interior points after them; 0: none
    int rounds = 0, patience = 0;  // of held slips after those
  };
  // Walls and piles that slips held solve at all take up to twenty rounds in which they nearly halve, or far more.
  constexpr int few_rounds = 20, hardly = 3, many_rounds = 300;
  std::optional<HeldSlips> held;
  double tried = 1e-5;  // natural map from which Newton was last tried
  for (const Turn turn : {Turn{2000, dear ? 0.0 : 1.0}, Turn{8000, 0.0, few_rounds, hardly},
                          Turn{25000, dear ? 1.0 : 0.1, many_rounds, many_rounds}, Turn{60000, dear ? 0.1 : 10.0}}) {
    if (better(swept_on(sweeps, turn.sweeps))) return best;
    if (sweeps.natural_map() <= 0.3 * tried) {  // nearly all states are right
      tried = sweeps.natural_map();
      if (better(newton_alone(sweeps.p(), Vector(), {"newton after long sweeps", 1e-4, 1.0, 12}))) return best;
    }
    if (inner && turn.start > 0.0) {
      NewtonEnd reached = inside_from(turn.start);
      sweeps.restart(reached.p);
      if (better(std::move(reached))) return best;
    }
    // Of rigid bodies a Newton iteration costs as much as fifty sweeps. pile100x4_mu0.8_ratio100 is solved so.
    constexpr int most_of_proximal = 250;
    if (turn.sweeps == 25000 && sweeps.of_joints() && better(vanishing_proximal(best.p, most_of_proximal))) return best;
    if (inner && sweeps.of_joints() && turn.rounds > 0) {
      if (!held) held.emplace(problem_);
      if (better(with_held_slips(*held, turn.rounds, turn.patience))) return best;
    }
  }
  // Without joints a round costs as much as thousands of sweeps.
  if (inner && !dear && !held) {
    held.emplace(problem_);
    if (better(with_held_slips(*held, many_rounds, many_rounds))) return best;
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

/// Gauss-Seidel needs columns of W.
bool Ladder::may_sweep() const {
  constexpr Eigen::Index most_formed = 5000;
  return problem_.W.is_dense() || problem_.W.is_sparse() || problem_.W.size() <= most_formed;
}

/// Sweeps, then Newton. Where a judge is content with what the sweeps found, nothing else is needed.
NewtonEnd Ladder::swept(const Vector& p, int sweeps, double regularisation, int iterations) {
  GaussSeidel iteration(problem_);
  Vector swept = p;
  iteration.start(swept);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const bool still = iteration.sweep(swept) <= 1e-12 * swept.lpNorm<Eigen::Infinity>();
    if (judges_all() && content_(swept, iteration.motion())) {
      iteration.start(swept);  // the motion afresh, without what rounding added from pair to pair
      if (content_(swept, iteration.motion())) {
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

/// Interior points of a plane problem from forces and motions that are known roughly. When |H| has fallen far enough
/// for nearly all states to be right, a few Newton iterations reach the solution; where they do not, steps follow once
/// more.
NewtonEnd Ladder::inside_near(Vector p, Vector a, double start) {
  constexpr int few = 7, hardly = 2;
  PlaneInteriorPoints points(problem_, p, a, start);
  NewtonEnd best = nothing();
  for (const double aim : {2e-3, 1e-4, 0.0}) {
    InteriorPointEnd reached = points.advance(aim, content_, options_.deadline);
    for (Iteration& iteration : reached.trace) {
      iteration.iteration += iterations_ + coarse_iterations_;
      trace_.push_back(std::move(iteration));
    }
    iterations_ += reached.iterations;
    if (reached.p.size() == 0) return best;
    if (reached.content) {
      NewtonEnd found = nothing();
      found.p = std::move(reached.p);
      found.a = std::move(reached.a);
      return confirmed(std::move(found), hardly, "interior points");
    }
    if (late()) return best;
    Run how{"newton after interior points", 0.0, 1.0, few, hardly};
    how.soft = true;
    NewtonEnd end = newton_alone(reached.p, reached.a, how);
    if (end.converged || end.residual < best.residual) best = std::move(end);
    if (best.converged || late() || reached.residual > aim) return best;
  }
  return best;
}

/// Interior points for elastic bodies from starts with these factors, then Newton from the best of them.
NewtonEnd Ladder::inside(std::initializer_list<double> start_factors) {
  NewtonEnd best = nothing();
  // Walls near their collapse load (mu 1, 8 x 8 blocks, 0.80 to 0.92 of it) are solved from one of these and not from
  // the others.
  for (const double factor : start_factors) {
    InteriorPointEnd reached = interior_points_from(factor);
    if (reached.p.size() > 0 && (reached.content || reached.residual < best.residual)) {
      best.p = std::move(reached.p);
      best.a = std::move(reached.a);
      best.residual = reached.residual;
      best.converged = reached.content;
    }
    if (best.converged || late()) break;
  }
  if (best.p.size() == 0) return best;
  if (!best.converged) {
    constexpr int few = 10;
    return newton_alone(best.p, best.a, {"newton after interior points", 0.0, 1.0, few});
  }
  if (late()) {
    best.residual = BDifferentiableEquations(problem_, options_.r_factor).residual(best.p, best.a).largest();
    return best;
  }
  constexpr int few = 2;
  return confirmed(std::move(best), few, "interior points");
}

/// Rounds with slips held, and a few Newton iterations whenever the natural map has become small: by then nearly all
/// states are right.
NewtonEnd Ladder::with_held_slips(HeldSlips& held, int rounds, int patience) {
  constexpr int few = 12;
  const double force = Measure(problem_).reference();
  NewtonEnd best = nothing();
  double aim = 1e-5;
  while (true) {
    InteriorPointEnd reached = held.advance(aim, rounds, patience, content_, options_.deadline);
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

/// Proximal-point iteration: a sequence of problems whose bodies are held softly where they last were. It ends in
/// finitely many steps, and Newton on the problem itself, without any spring, has the last word.
NewtonEnd Ladder::floating_proximal(Vector p, Vector a) {
  NewtonEnd end = nothing();
  // Of the mean contact stiffness, which the scaling has made 1. Of 8000 random floating problems none failed with 0.1,
  // 1 % of those with weak friction with 0.001.
  double soft = 0.1;
  for (int round = 0; round < 30; ++round) {
    const Problem held = held_at(problem_, a, soft);
    NewtonEnd inner = run(held, p, Vector(), {"newton, bodies held softly"});
    if (!inner.converged)
      inner = run(held, gauss_seidel(held, p, 100), Vector(), {"newton after sweeps, bodies held softly"});
    if (!inner.converged) inner = after_pivoting(held);
    if (!inner.converged || late()) break;
    p = inner.p;
    a += (problem_.G.transpose() * p + problem_.f) / soft;
    end = newton_alone(p, a, {"newton after proximal step"});
    if (end.converged) break;
    if (end.singular && soft > 1e-8) soft *= 0.1;  // still in the air
  }
  return end;
}

/// The same for forces: (w / r)(p - p_before) is added to the motions, w falls from one problem to the next. Of about
/// `most` iterations, 0: as many as forty problems take.
NewtonEnd Ladder::vanishing_proximal(Vector p, int most) {
  constexpr double exact = 1e-12;  // of the largest force: the next round starts from there
  constexpr int few = 12;
  NewtonEnd end = nothing();
  double weight = 1.0;
  const int before = iterations_;
  for (int round = 0; round < 40 && (most == 0 || iterations_ - before < most); ++round) {
    BDifferentiableEquations equations(problem_, options_.r_factor);
    equations.hold(weight, p);
    NewtonOptions options;
    options.small = small_;
    options.relative = exact;
    options.iterations = options_.iterations;
    options.stage = "newton, forces held softly";
    options.deadline = options_.deadline;
    options.on_iteration = counted(options_.on_iteration);
    NewtonEnd inner = newton(equations, p, Vector(), options);
    for (Iteration& iteration : inner.trace) {
      iteration.iteration += iterations_ + coarse_iterations_;
      trace_.push_back(std::move(iteration));
    }
    iterations_ += inner.iterations;
    if (!inner.p.allFinite()) break;
    p = inner.p;
    if (content_ && judges_all() && content_(p, motion_of(problem_, p, Vector()))) {
      end = std::move(inner);
      end.residual = BDifferentiableEquations(problem_, options_.r_factor).residual(p, Vector()).largest();
      end.converged = true;
      break;
    }
    if (late()) break;
    if (round % 4 == 3) {
      end = newton_alone(p, Vector(), {"newton after proximal step", 1e-4, 1.0, judges_all() ? few : 0});
      if (end.converged) break;
    }
    weight = inner.converged ? std::max(0.5 * weight, 1e-4) : std::min(4.0 * weight, 10.0);
  }
  return end;
}

/// The frictionless solution first, then more and more friction.
NewtonEnd Ladder::growing_friction(const Vector& p, const Vector& a) {
  NewtonEnd end = nothing();
  Problem weaker = problem_;
  Vector p_now = p, a_now = a;
  for (double part : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) {
    weaker.mu = part * problem_.mu;
    weaker.mu_backward = part * problem_.mu_backward;
    end = part == 1.0 ? newton_alone(p_now, a_now, {"newton, growing friction"})
                      : run(weaker, p_now, a_now, {"newton, growing friction"});
    if (!end.p.allFinite() || late()) break;
    p_now = end.p;
    a_now = end.a;
  }
  return end;
}

/// From the motions that the forces of the start would leave at rest to those of the problem, in steps.
NewtonEnd Ladder::growing_load(const Vector& p, const Vector& a) {
  NewtonEnd end = nothing();
  Problem lighter = problem_;
  Vector p_now = p, a_now = a;
  for (double part : {0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) {
    lighter.q = part * problem_.q;
    lighter.f = part * problem_.f;
    end = part == 1.0 ? newton_alone(p_now, a_now, {"newton, growing load"})
                      : run(lighter, p_now, a_now, {"newton, growing load"});
    if (!end.p.allFinite() || late()) break;
    p_now = end.p;
    a_now = end.a;
  }
  return end;
}

NewtonEnd Ladder::after_sweeps(const Vector& p, const Vector& a) {
  if (problem_.G.cols() == 0) return swept(p, 500, 0.0);
  const double soft = 1e-2;
  const Vector p_swept = gauss_seidel(held_at(problem_, a, soft), p, 500);
  return newton_alone(p_swept, a + (problem_.G.transpose() * p_swept + problem_.f) / soft, {"newton after sweeps"});
}

NewtonEnd Ladder::after_pivoting(const Problem& held) {
  constexpr int most = 400;  // pairs: the tableau grows with their square
  const bool plain = held.dimension == 2 && held.cohesion.size() == 0 && held.tension.size() == 0;
  const std::optional<Vector> p = plain && held.pairs() <= most ? lemke(held) : std::nullopt;
  return p ? run(held, *p, Vector(), {"newton after pivoting"}) : nothing();
}

}  // namespace scabo::contact
