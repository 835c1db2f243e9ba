// Strategies of the ladder for many bodies that only contact holds: from bonded pairs, along paths of equilibria, by
// interior points.
#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <set>
#include <vector>

#include "scabo/contact/interior_point.hpp"
#include "scabo/contact/joint_order.hpp"
#include "scabo/contact/ladder.hpp"
#include "scabo/contact/plane_interior_points.hpp"
#include "scabo/contact/rigid_motions.hpp"
#include "scabo/contact/soft_newton.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

namespace {

/// Pairs from which most of a path is taken in leaps, and changes of state in one.
constexpr int least_of_leaps = 4000, most_together = 128;
/// Times that a path from bonded pairs begins again where it turns back. From where one that began at the limits of its
/// pairs turns back none was seen to lead on.
constexpr int most_again = 8;
/// Of the mean force: how far pairs are within their limits at the start of a path that crosses over, from points whose
/// states are mostly right and from bonded pairs.
constexpr double at_limits = 1e-6, within_limits = 1e-2;
/// Pairs above which a path replaces up to 2,000 rows before the matrix is factorised anew, which takes fewer
/// iterations; below, 1,500, because near a singular matrix the system of the replaced rows is factorised again and
/// again.
constexpr int many_pairs = 8000;

/// Pairs with less than this part of |H| are undecided where interior points end (NewtonOptions::undecided). At crack
/// tips 10 and 100 do as well, with 1 Newton's method finds none.
constexpr double undecided = 30.0;

/// Whether a path was followed to where bodies move on. Not if that is where the loads are reached but for rounding, as
/// where all loads are taken away.
bool tells_of_a_fall(const PathEnd& end) {
  constexpr double rounding = 1e-6;
  return end.how != PathEnd::How::broken && end.left > rounding;
}

/// Tension and friction beyond what the pairs bear, as a part of all normal forces.
double beyond_cones(const Problem& problem, const Vector& p) {
  double beyond = 0.0, all = 0.0;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double normal = p[2 * i], tangential = p[2 * i + 1];
    beyond += std::max(-normal - problem.tension_of(i), 0.0) +
              std::max(std::abs(tangential) - problem.friction_bound(i, normal, tangential), 0.0);
    all += std::abs(normal);
  }
  return all > 0.0 ? beyond / all : 0.0;
}

constexpr double joints_of_walls = 1.5;
/// Joints that touch bodies only contact holds, over the number of these bodies: 1 in a tower, 3 in a wall.
double joints_per_body(const Problem& problem) {
  std::set<std::vector<int>> joints;
  for (std::vector<int>& motions : motions_of_pairs(problem))
    if (!motions.empty()) joints.insert(std::move(motions));
  const auto motions = static_cast<double>(problem.G.cols());
  return motions > 0.0 ? 3.0 * static_cast<double>(joints.size()) / motions : 0.0;
}

}  // namespace

NewtonEnd Ladder::bonded(const BondedStart& start) {
  // Walls of 256 to 1,600 blocks: 0.01 under their weight, 0.04 at half of their limit load and friction 0.3, which
  // Newton's method solves in 4 iterations; from 0.05 on, half of the limit load and friction 0.6, interior points need
  // fewer.
  constexpr double most_beyond = 0.045;
  // Walls of 64 to 100 blocks: below 0.12 Newton's method and paths take 3 to 6 iterations, above it Newton's method
  // does not converge, and above 0.28 interior points turn back. Paths of towers take 2 to 5, those of smaller walls 3
  // to 7.
  constexpr double least_of_small = 0.12, most_of_small = 0.28;
  constexpr int least_pairs = 500;
  // What converges takes 3 to 10 iterations; a path takes 2 to 10 factorisations, whatever happens.
  const bool small = problem_.pairs() <= most_of_paths_first;
  if (may_soften(problem_) && may_take_plane_interior_points(problem_)) {
    const double beyond = beyond_cones(problem_, start.p);
    if (!small && beyond > most_beyond) return nothing();  // interior points are next
    if (small && beyond > least_of_small && joints_per_body(problem_) > joints_of_walls)
      return problem_.pairs() > least_pairs && beyond < most_of_small ? inside_near(start.p, start.a, 1.0) : nothing();
  }
  const int most = may_follow_path(problem_) ? std::min(small ? 6 : 10, options_.iterations) : 0;
  Run how{"newton", 0.0, 1.0, most};
  if (may_follow_path(problem_)) how.first_fall = 0.15;
  if (!small) {
    how.patience = 2, how.fall = 0.1;  // what falls more slowly takes more iterations than interior points
    how.watched = 0;
  }
  return newton_of_many(start.p, start.a, how);
}

/// Where Newton's method has come nearer and ends because it has no direction, or none that descends, directions that
/// are held softly follow: bodies may slide on all their pairs, or a wrong state lets one go. Under their weight alone
/// walls of 1,000 and more blocks may take 9 to 13 of them, with or without a solution; a path takes 2 to 4.
NewtonEnd Ladder::newton_of_many(const Vector& p, const Vector& a, const Run& how) {
  constexpr int few_before_path = 4, most_of_soft = 12, patience = 4;
  NewtonEnd end = newton_alone(p, a, how);
  const bool given_up = !end.singular && end.iterations <= 1;
  if (given_up || end.converged || late() || problem_.pairs() <= most_of_paths_first || !may_soften(problem_))
    return end;
  const int few = may_cross_over() ? few_before_path : most_of_soft;
  NewtonEnd more = softly(end.p, end.a, {"newton, bodies held", 0.0, 1.0, few, patience});
  return more.converged || more.residual < end.residual ? more : end;
}

/// Newton's method with directions that are held softly (contact/soft_newton), where it may be.
NewtonEnd Ladder::softly(const Vector& p, const Vector& a, Run how) {
  how.soft = true;
  return newton_alone(p, a, how);
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

/// The last of all, where no path was followed to its end: from bonded pairs with all bodies held, and then let go.
/// They come to rest or fall: nine stones over a gap fall with 0.14 of the largest force missing, at any friction.
NewtonEnd Ladder::with_bodies_held() {
  const bool may = problem_.pairs() <= most_of_crossing && may_follow_path(problem_);
  return may ? crossed_from_bonded() : nothing();
}

NewtonEnd Ladder::arrived(PathEnd end) {
  NewtonEnd found = nothing();
  found.p = std::move(end.p);
  found.a = std::move(end.a);
  // What rounding leaves Newton's method mends at once, or, where forces are not unique, leads away from.
  constexpr int few = 4, at_once = 1;
  constexpr double rounding = 1e-9;
  const Residual at = BDifferentiableEquations(problem_, options_.r_factor).residual(found.p, found.a);
  const bool is_exact = at.largest() <= rounding * found.p.lpNorm<Eigen::Infinity>();
  return confirmed(std::move(found), "path", {"newton after path", 0.0, 1.0, few, is_exact ? at_once : few});
}

/// Whether a path follows where Newton's method or interior points are slow. It takes at most 10 factorisations where
/// these take up to 45 or fail, but also thousands of changes of state: 3 to 34 s in walls of 24 x 24 blocks, 10 to 45
/// s in those of 40 x 40, where interior points take 2 to 4 s and 9 to 28 s if they arrive.
bool Ladder::may_cross_over() const {
  return problem_.pairs() <= most_of_crossing && has_many_motions(problem_) && may_follow_path(problem_);
}

/// From points whose states are mostly right to the solution, along paths whose starts have these states. They are
/// short, and near the limit load they often do not lead away from their start: where all pairs are nearly at their
/// limits the start is one equilibrium of several. From bonded pairs, well within their limits, paths take two to four
/// times as many changes of state, and of 16 walls of 200 to 600 blocks, 0.8 to 0.99 of their limit load, all arrive.
/// Where bodies fall on two paths when they are let go, nothing that follows was seen to succeed.
NewtonEnd Ladder::crossed_over(const std::vector<CrossingPoint>& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (NewtonEnd end = crossed(points[k], at_limits); end.converged || late() || bodies_fall()) return end;
    if (k > 0) continue;
    if (NewtonEnd end = crossed_from_bonded(); end.converged || late() || bodies_fall()) return end;
  }
  return nothing();
}

/// Once: the same path would follow.
NewtonEnd Ladder::crossed_from_bonded() {
  if (crossed_from_bonded_ || !held_together()) return nothing();
  crossed_from_bonded_ = true;
  return crossed({held_together()->p, held_together()->a}, within_limits);
}

/// Whether the path from bonded pairs comes before those from points of interior points, which near the limit load of
/// bodies with much friction hardly ever arrive. Walls of 1,600 blocks, friction 1: at half of their limit load (0.075)
/// they arrive in half of the time, at 0.7 of it (0.16) they do not.
bool Ladder::begins_bonded() {
  constexpr double much_friction = 0.8, least_beyond = 0.12;
  return held_together() && problem_.mu.mean() >= much_friction &&
         beyond_cones(problem_, held_together()->p) > least_beyond;
}

/// The path from there with all bodies held, which are let go in the end. It needs more memory than what follows: where
/// there is none, nothing is found.
NewtonEnd Ladder::crossed(const CrossingPoint& from, double margin) {
  PathEnd end;
  try {
    end = along_path(crossing_start(from, margin), true);
  } catch (const std::bad_alloc&) {
    return nothing();
  }
  if (end.how == PathEnd::How::arrived) return arrived(std::move(end));
  if (end.how == PathEnd::How::endless) {
    may_fall_ = true;
    collapse_ = Collapse{std::move(end.motion), 0.0};
    ++falls_;
  }
  return nothing();
}

PathStart Ladder::crossing_start(const CrossingPoint& from, double margin) const {
  const Residual at = BDifferentiableEquations(problem_, options_.r_factor).residual(from.p, from.a);
  PathStart start{from.p, from.a, {}, margin, 0.0};
  start.states.reserve(at.branches.size());
  for (const Branch& branch : at.branches)
    start.states.push_back(!branch.contact                            ? ContactState::open
                           : branch.tangent == Branch::Tangent::stick ? ContactState::stick
                                                                      : ContactState::slip);
  return start;
}

/// One iteration for every matrix factorised. `held`: bodies of which no pair sticks are held, and let go at the end.
PathEnd Ladder::along_path(const PathStart& start, bool held) {
  const BDifferentiableEquations equations(problem_, options_.r_factor);
  PathOptions options;
  options.deadline = options_.deadline;
  if (problem_.pairs() > most_of_paths_first) {
    const int pairs = problem_.pairs();
    options.changes = 100;
    options.together = pairs > least_of_leaps ? most_together : 0;
    // Paths that arrive take up to two changes for each pair, those that end in a fall up to eight.
    options.most = 8 * pairs + 100;
    options.patience = 300 + pairs / 20;
  }
  if (held) {
    options.hold = 1e-6;
    options.changes = problem_.pairs() > many_pairs ? 2000 : 1500;
    options.together = most_together;
    options.again = start.margin > at_limits ? most_again : 0;
  }
  options.on_factorisation = [&](const Vector& p, const Vector& a) {
    const Residual at = equations.residual(p, a);
    options_.deadline.spend(operations_of_system(problem_));
    trace_.push_back({++iterations_ + coarse_iterations_, at.largest(), at.merit(), 1.0, 0, "path"});
    if (options_.on_iteration) options_.on_iteration(trace_.back());
  };
  return follow_path(problem_, start, options);
}

/// States are certain when Newton has confirmed them. Where pairs are redundant it may not; then the point itself is
/// kept if it is a solution.
NewtonEnd Ladder::confirmed(NewtonEnd found, const std::string& name, Run how) {
  const Residual at = BDifferentiableEquations(problem_, options_.r_factor).residual(found.p, found.a);
  found.residual = at.largest();
  found.converged = content_ && content_(found.p, found.a, at.motion);
  how.soft = has_many_motions(problem_);
  // Where bodies are held softly beside a crack, ends of paths take 6 to 17 iterations. The certificate is content far
  // away there, with |H| of 1e-5 (elsewhere 1e-9): 3 to 28, most of them with a larger |H|, where forces were wrong by
  // 14 %.
  constexpr double near = 1e-7;
  constexpr int most_after_path = 20, most = 40;
  const bool is_near = found.converged && found.residual <= near * found.p.lpNorm<Eigen::Infinity>();
  if (!how.soft && !is_near) how.iterations = how.patience = found.converged ? most : most_after_path;
  NewtonEnd end = newton_alone(found.p, found.a, how);
  if ((end.converged && end.residual <= found.residual) || !found.converged) return end;
  trace_.push_back({iterations_ + coarse_iterations_, found.residual, at.merit(), 0.0, 0, name + " kept"});
  return found;
}

/// Newton's method confirms interior points of walls at once or not at all. At crack tips it finds the states of one
/// ring of pairs after the other, and where bodies are held softly the certificate is content far away: up to 22
/// iterations, as long as |H| falls.
NewtonEnd Ladder::confirmed_inside(NewtonEnd found) {
  constexpr int hardly = 2, patience = 4;
  Run how{"newton after interior points", 0.0, 1.0, hardly, hardly};
  if (!has_many_motions(problem_)) how.iterations = 0, how.patience = patience;
  how.undecided = undecided;
  return confirmed(std::move(found), "interior points", how);
}

/// Interior points of a plane problem from forces and motions that are known roughly. When H has fallen far enough
/// for most states to be right, a few Newton iterations reach the solution; where they do not, steps follow once more.
NewtonEnd Ladder::inside_near(Vector p, Vector a, double start) {
  constexpr int few = 7, slowly = 4;
  // Where Newton follows: the root of the mean square of H, over the largest force; and the next time, of what was then
  // reached. Of walls of 256 to 1,600 blocks most are solved from the first of them, and 1,600 blocks not from 6e-5.
  constexpr double first_aim = 5e-5, next_aim = 0.1;
  // Of walls of 256 to 1,600 blocks those whose steps are all at least 0.44 take 7 to 10 iterations, the others up
  // to 45. In walls a path also follows sooner where the states are not yet known, in towers it may turn back there.
  const bool is_wall = joints_per_body(problem_) > joints_of_walls;
  const ShortSteps jammed{0.45, is_wall ? 0.65 : 0.45};
  bool may_cross = may_cross_over();
  PlaneInteriorPoints points(problem_, p, a, start);
  NewtonEnd best = nothing();
  for (double aim = first_aim;;) {
    InteriorPointEnd reached = points.advance(aim, content_, options_.deadline, may_cross ? jammed : ShortSteps{});
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
      return confirmed_inside(std::move(found));
    }
    if (late()) return best;
    if (reached.jammed) {
      // Paths from the first steps arrive, with twice as many changes: of six walls of 24 x 24 blocks, friction 0.6, at
      // 0.945 to 0.954 of the limit load one arrived from where steps were short, and all six from the second step.
      may_cross = false;
      if (begins_bonded())
        if (NewtonEnd end = crossed_from_bonded(); end.converged || late() || bodies_fall()) return end;
      std::vector<CrossingPoint> from{{reached.p, reached.a}};
      if (reached.p != reached.early_p) from.push_back({reached.early_p, reached.early_a});
      NewtonEnd end = crossed_over(from);
      if (end.converged || late() || bodies_fall()) return end;
      continue;
    }
    Run how{"newton after interior points", 0.0, 1.0, few, slowly};
    how.first_step = 0.5;  // is whole or half where most states are right
    how.undecided = undecided;
    NewtonEnd end = softly(reached.p, reached.a, how);
    if (end.converged || end.residual < best.residual) best = std::move(end);
    if (best.converged || late() || reached.residual > aim) return best;
    aim = next_aim * reached.residual;
  }
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
    Run how{"newton after interior points", 0.0, 1.0, few};
    how.undecided = undecided;
    return newton_alone(best.p, best.a, how);
  }
  if (late()) {
    best.residual = BDifferentiableEquations(problem_, options_.r_factor).residual(best.p, best.a).largest();
    return best;
  }
  return confirmed_inside(std::move(best));
}

}  // namespace scabo::contact
