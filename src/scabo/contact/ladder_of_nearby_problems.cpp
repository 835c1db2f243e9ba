// Strategies of the ladder that come to the problem by way of others: bodies or forces held softly, less friction, less
// load, pivoting.
#include <algorithm>
#include <cmath>
#include <optional>

#include "scabo/contact/judge.hpp"
#include "scabo/contact/ladder.hpp"
#include "scabo/contact/lemke.hpp"
#include "scabo/contact/rigid_motions.hpp"
#include "scabo/contact/starts/gauss_seidel.hpp"

namespace scabo::contact {

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

/// The same for forces: (w / r)(p - p_before) is added to the motions, w falls from one problem to the next, to a tenth
/// where the last one was solved easily. Of about `most` iterations, up to four times as many
/// while each quarter of `most` halves the natural map; 0: as many as forty problems take. Of problem files Newton
/// without the term, which costs as much as ten problems with it, is tried where w is small.
NewtonEnd Ladder::vanishing_proximal(Vector p, int most) {
  constexpr double exact = 1e-12;  // of the largest force: the next round starts from there
  constexpr int few = 12, easily = 4;
  constexpr double least = 1e-4, small = 1e-3, fallen = 0.3;
  NewtonEnd end = nothing();
  const Measure measure(problem_);
  const auto map_at = [&](const Vector& at) {
    return judges_all() ? measure.natural_map(problem_, at, motion_of(problem_, at, Vector())) : 0.0;
  };
  double weight = 1.0, tried = map_at(p), halved = tried;
  const int before = iterations_;
  int gained = before;  // where the natural map was halved last
  const auto go_on = [&](int round) {
    const int done = iterations_ - before;
    if (most == 0) return round < 40;
    return round < 160 && (done < most || (done < 4 * most && iterations_ - gained < most / 4));
  };
  for (int round = 0; go_on(round); ++round) {
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
    if (content_ && judges_all() && content_(p, Vector(), motion_of(problem_, p, Vector()))) {
      end = std::move(inner);
      end.residual = BDifferentiableEquations(problem_, options_.r_factor).residual(p, Vector()).largest();
      end.converged = true;
      break;
    }
    if (late()) break;
    const double map = map_at(p);
    if (map <= 0.5 * halved) halved = map, gained = iterations_;
    const bool now = round % 4 == 3, near_by = (weight <= least && now) || (weight <= small && map < fallen * tried);
    if (judges_all() ? near_by : now) {
      tried = map;
      end = newton_alone(p, Vector(), {"newton after proximal step", 1e-4, 1.0, judges_all() ? few : 0});
      if (end.converged) break;
    }
    const double next = judges_all() && inner.iterations <= easily ? 0.1 : 0.5;
    weight = inner.converged ? std::max(next * weight, least) : std::min(4.0 * weight, 10.0);
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
