#include "scabo/contact/path.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/path_system.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

class Path {
  /// A quantity of a pair that must not become negative.
  enum class Limit { gap, force, upper, lower, slip };
  struct Next {
    double step = HUGE_VAL;
    Index pair = -1;
    Limit limit = Limit::gap;
  };

 public:
  Path(const Problem& problem, const PathStart& start, const PathOptions& options)
      : options_(options),
        margin_(start.margin),
        at_(problem, start, options),
        held_(options.hold > 0.0 ? 1.0 : 0.0),
        together_(std::min(first_together, options.together)) {}

  PathEnd run() {
    if (!factorise()) return finish(PathEnd::How::broken);
    PathEnd::How how = follow();
    while (how != PathEnd::How::arrived && may_loosen_less()) {
      loosen_less();
      how = factorise() ? follow() : PathEnd::How::broken;
    }
    return finish(how);
  }

 private:
  /// Until the last round arrives or a path ends before.
  PathEnd::How follow() {
    const int most = options_.most > 0 ? options_.most : static_cast<int>(4 * at_.pairs()) + 100;
    const int patience = options_.patience > 0 ? options_.patience : most / 8;
    while (true) {
      if (passed_) {
        if (!renew()) return PathEnd::How::broken;
        interruption_point();
        options_.deadline.spend(solves_of_a_change * at_.operations_of_solve());
        change(*passed_);
      }
      if (!find_direction()) return PathEnd::How::broken;
      const Next next = nearest_limit();
      endless_ = std::abs(at_.dt()) < 1e-9;
      if (may_change_together() && change_together(next)) {
        passed_.reset();
        note_least();
        if (!renew()) return PathEnd::How::broken;
        if (end_.changes >= most || options_.deadline.passed()) return PathEnd::How::broken;
        if (stands_still() && !begin_again_here()) return PathEnd::How::turned_back;
        continue;
      }
      const double to_end = at_.dt() < 0.0 && !endless_ ? at_.t() / -at_.dt() : HUGE_VAL;
      if (to_end <= next.step && to_end < HUGE_VAL) {
        at_.advance(to_end);
        if (round_ > 0 && options_.hold == 0.0 && has_gone_astray())
          return PathEnd::How::broken;  // the point before counts
        if (ends_round()) return falls_ ? PathEnd::How::endless : PathEnd::How::arrived;
        if (!(loosened_by_ < 1.0 ? factorise() : at_.place())) return PathEnd::How::broken;
        continue;
      }
      const bool falls = !(next.step < (endless_ ? most_of_motion : HUGE_VAL));
      if (falls || (begun_at_ * at_.t() <= end_.left && round_ == 0))
        end_.motion = at_.dz().tail(at_.dz().size() - 2 * at_.pairs()).normalized();
      if (falls) return PathEnd::How::endless;
      at_.advance(next.step);
      ++end_.changes;
      note_least();
      if (options_.deadline.passed()) return PathEnd::How::broken;
      passed_ = next;
      const bool back = end_.changes - least_at_ >= patience;
      const bool leaves = begun_at_ * at_.t() > far, still = stands_still();
      if (end_.changes >= most) return back ? PathEnd::How::turned_back : PathEnd::How::broken;
      if ((leaves || still || (options_.patience > 0 && back)) && !begin_again_here())
        return back || still ? PathEnd::How::turned_back : PathEnd::How::broken;
    }
  }

  /// At t = 0: whether that was the last round; else the next one begins, with the softness taken back and the bodies
  /// held less.
  bool ends_round() {
    const std::optional<PathSystem::Point> before = std::exchange(arrived_, at_.point());
    loosened_by_ = held_ > 2.0 * least_hold ? least_hold / held_ : 1.0;
    held_ *= loosened_by_;
    const double error = at_.take_softness_back(loosened_by_);
    const bool rests = error <= rounding && error > gain * error_before_;  // of forces that are not unique
    ++round_;
    const bool same = held_ > 0.0 && loosened_by_ == 1.0 && error > rounding && error > steady * error_before_;
    same_ = same ? same_ + 1 : 0;
    if (same_ == most_same) {
      falls_ = true;
      end_.motion = (arrived_->z - before->z).tail(before->z.size() - 2 * at_.pairs()).normalized();
      end_.left = error;
      return true;
    }
    if (error <= settled || rests || (loosened_by_ == 1.0 && ++rounds_ > options_.rounds)) {
      polish();
      return true;
    }
    error_before_ = error;
    begins_round();
    return false;
  }

  void begins_round() {
    least_ = begun_at_ = 1.0;
    still_from_ = 1.0;
    least_at_ = still_at_ = end_.changes;
    passed_.reset();
    endless_ = false;
  }

  /// Whether the path that lets the bodies go has ended before t = 0, and may once more do so by less at a time.
  bool may_loosen_less() const { return arrived_ && loosened_by_ < little && !options_.deadline.passed(); }

  void loosen_less() {
    held_ *= little / loosened_by_;
    at_.begin_at(*arrived_, little / loosened_by_);
    loosened_by_ = little;
    begins_round();
  }

  static constexpr double far = 2.0;                    // t: the path runs away from the problem
  static constexpr double settled = 1e-14;              // of the largest force: what rounding leaves of the softness
  static constexpr double rounding = 1e-9, gain = 0.1;  // up to which what is left of it may no longer fall
  // Of the hold: what is left of it in the end, and of the one before where it cannot be taken back at once.
  static constexpr double least_hold = 1e-4, little = 0.1;
  // Bodies fall where what holds them is still this part of what it was in the round before, so many times.
  static constexpr double steady = 0.999;
  static constexpr int most_same = 3;
  static constexpr double solves_of_a_change = 3.0;  // about
  // A path of bodies that are held stands still where so many changes, and for each pair, do not take this part of t.
  static constexpr double still_changes = 1000.0, still_changes_of_pairs = 0.25, part_of_t = 0.05;
  static constexpr int least_replaced = 200;     // rows, before a matrix that gives inexact directions is given up
  static constexpr int between_places = 250;     // changes of state, from piece to piece by sums
  static constexpr double most_of_motion = 1e6;  // of all forces and motions so far
  // Leaps: how many changes at first, and after so many single ones again; what counts as beyond a limit, of the
  // largest force or motion; when Newton's method leads on: each time this part of the pairs before, or fewer.
  static constexpr int first_together = 16, later_together = 8, least_pause = 2, most_pause = 16, most_corrections = 8;
  static constexpr double beyond = 1e-11, beyond_at_end = 1e-13, fewer = 0.6, most_growth = 100.0;
  static constexpr double least_again = 1e-3;  // t from which another path begins: nearer to the end it would lead away

  /// The way on which the softness is taken back is as short as rounding; where it ends early, the point before counts.
  PathEnd finish(PathEnd::How how) {
    if (arrived_ && !falls_) how = PathEnd::How::arrived;
    const Vector& z = arrived_ ? arrived_->z : at_.z();
    end_.how = how;
    end_.p = z.head(2 * at_.pairs());
    end_.a = z.tail(z.size() - end_.p.size());
    if (how == PathEnd::How::arrived) {
      end_.left = 0.0;
      end_.motion.resize(0);
    }
    return std::move(end_);
  }

  /// What rounding leaves beyond the limits at the end: Newton's method with the factors at hand, as long as fewer
  /// pairs are beyond them each time.
  void polish() {
    std::size_t before = static_cast<std::size_t>(at_.pairs());
    while (at_.place() && !has_gone_astray()) {
      arrived_ = at_.point();
      const std::vector<PathSystem::Change> changes = impossible_states(beyond_at_end);
      const bool room = at_.replaced_rows() + 2 * static_cast<int>(changes.size()) <= at_.capacity();
      if (changes.empty() || changes.size() >= before || !room) return;
      before = changes.size();
      at_.change(changes);
    }
  }

  void note_least() {
    if (at_.t() >= least_) return;
    least_ = at_.t();
    least_at_ = end_.changes;
    if (round_ == 0) end_.left = std::min(end_.left, begun_at_ * least_);
  }

  /// Whether forces or motions have changed by more than the softness can have caused.
  bool has_gone_astray() const {
    constexpr double most = 1e-3, least = 1e-300;
    const auto changed = [](const auto& now, const auto& before) {
      return before.size() > 0 &&
             !((now - before).cwiseAbs().maxCoeff() <= most * before.cwiseAbs().maxCoeff() + least);
    };
    const Index forces = 2 * at_.pairs(), motions = at_.z().size() - forces;
    return changed(at_.z().head(forces), arrived_->z.head(forces)) ||
           changed(at_.z().tail(motions), arrived_->z.tail(motions));
  }

  /// Paths that arrive lead away from their start soon; others pass thousands of limits beside it.
  bool stands_still() {
    if (options_.hold == 0.0) return false;
    const double t = begun_at_ * least_;
    if (t <= (1.0 - part_of_t) * still_from_) still_from_ = t, still_at_ = end_.changes;
    return end_.changes - still_at_ > still_changes + still_changes_of_pairs * static_cast<double>(at_.pairs());
  }

  bool factorise() {
    ++end_.factorisations;
    if (options_.on_factorisation) options_.on_factorisation(at_.forces(), at_.rigid_motions());
    return at_.factorise();
  }

  /// Before a change, on a piece on which t moves (there the matrix is regular): factorises anew where many rows are
  /// replaced, and else places the point after so many changes.
  bool renew() {
    const int replaced = at_.replaced_rows() + 2;
    const bool many = replaced > (at_.inexact() ? least_replaced : options_.changes);
    const bool anew = (many && !endless_) || replaced > at_.capacity();
    if (!anew && (endless_ || end_.changes < place_at_)) return true;
    place_at_ = end_.changes + between_places;
    return anew ? factorise() : at_.place();
  }

  /// The pair at its limit takes its next state.
  void change(const Next& at) {
    PathState state = at_.state(at.pair);
    side_before_ = state.side;
    switch (at.limit) {
      case Limit::gap:
        state = {true, side_of_motion(at.pair)};
        break;
      case Limit::force:
        state.contact = false;
        break;
      case Limit::upper:  // p_t = mu p_n: slips backward
        state.side = -1;
        break;
      case Limit::lower:
        state.side = 1;
        break;
      case Limit::slip:
        state.side = 0;
        break;
    }
    at_.change({{at.pair, state}});
  }

  int side_of_motion(Index pair) const { return at_.may_stick(pair) && at_.motion()[2 * pair + 1] < 0.0 ? -1 : 1; }

  /// The direction, towards the side of the limit just passed on which it is met.
  bool find_direction() {
    if (!at_.find_direction()) return false;
    if (!passed_) {
      at_.turn(-1.0);
    } else {
      const Index normal = 2 * passed_->pair, tangent = normal + 1;
      double leaves = 0.0;
      switch (passed_->limit) {
        case Limit::gap:
          leaves = at_.dz()[normal];
          break;
        case Limit::force:
          leaves = at_.d_motion()[normal];
          break;
        case Limit::upper:
        case Limit::lower:
          leaves = at_.state(passed_->pair).side * at_.d_motion()[tangent];
          break;
        case Limit::slip:
          leaves = at_.mu_of(passed_->pair, side_before_) * at_.dz()[normal] + side_before_ * at_.dz()[tangent];
          break;
      }
      at_.turn(leaves > 0.0 ? 1.0 : -1.0);
    }
    // Along the path by its own length: where t hardly changes, the bodies move.
    const double size =
        std::max(1.0, at_.dz().lpNorm<Eigen::Infinity>() / std::max(at_.z().lpNorm<Eigen::Infinity>(), 1e-300));
    at_.turn(1.0 / size);
    return true;
  }

  /// Calls meets(limit, step, pair) for every limit that lies ahead on this piece.
  template <typename Meets>
  void for_each_limit(const Meets& meets) const {
    const Vector &z = at_.z(), &dz = at_.dz(), &motion = at_.motion(), &d_motion = at_.d_motion();
    const double still_force = 1e-13 * dz.head(2 * at_.pairs()).lpNorm<Eigen::Infinity>(),
                 still_motion = 1e-13 * d_motion.lpNorm<Eigen::Infinity>();
    for (Index i = 0; i < at_.pairs(); ++i) {
      const PathState& state = at_.state(i);
      const Index normal = 2 * i, tangent = normal + 1;
      const auto falls = [&](Limit limit, double value, double change, double least) {
        if (!(change < -least) || (passed_ && passed_->pair == i && is_just_left(limit))) return;
        meets(limit, std::max(value, 0.0) / -change, i);
      };
      if (!state.contact) {
        falls(Limit::gap, motion[normal], d_motion[normal], still_motion);
      } else if (state.side == 0) {
        const double forward = at_.mu_of(i, 1), backward = at_.mu_of(i, -1);
        falls(Limit::upper, backward * z[normal] - z[tangent], backward * dz[normal] - dz[tangent], still_force);
        falls(Limit::lower, forward * z[normal] + z[tangent], forward * dz[normal] + dz[tangent], still_force);
      } else {
        falls(Limit::force, z[normal], dz[normal], still_force);
        if (at_.may_stick(i))
          falls(Limit::slip, state.side * motion[tangent], state.side * d_motion[tangent], still_motion);
      }
    }
  }

  Next nearest_limit() const {
    Next next;
    for_each_limit([&](Limit limit, double step, Index pair) {
      if (step < next.step) next = {step, pair, limit};
    });
    return next;
  }

  /// The limit on which the path has stood since the change, seen from the new state.
  bool is_just_left(Limit limit) const {
    switch (passed_->limit) {
      case Limit::gap:
        return limit == Limit::force;
      case Limit::force:
        return limit == Limit::gap;
      case Limit::upper:
      case Limit::lower:
        return limit == Limit::slip;
      case Limit::slip:
        return limit == (side_before_ > 0 ? Limit::lower : Limit::upper);
    }
    return false;
  }

  bool may_change_together() const {
    return options_.together > 0 && !endless_ && at_.dt() < 0.0 && end_.changes >= together_at_;
  }

  /// As many changes together as succeed; whether any did.
  bool change_together(const Next& next) {
    std::vector<double> steps;
    for_each_limit([&](Limit, double step, Index) {
      if (step > 0.0) steps.push_back(step);  // else it has been passed by less than counts as beyond
    });
    const double to_end = at_.t() / -at_.dt();
    bool tried_to_end = false;
    const PathSystem::Point from = at_.point();
    for (; together_ > 1; together_ /= 2) {
      double step = to_end;
      if (const auto count = static_cast<std::size_t>(together_); count <= steps.size()) {
        const auto last = steps.begin() + (together_ - 1);
        std::nth_element(steps.begin(), last, steps.end());
        step = std::min(step, *last);
      }
      if (std::exchange(tried_to_end, step == to_end) && step == to_end) continue;
      if (!(step > next.step) || !leap(step, from)) {
        successes_ = 0;
        continue;
      }
      if (++successes_ >= 2) {
        successes_ = 0;
        together_ = std::min(2 * together_, options_.together);
      }
      pause_ = least_pause;
      ++end_.leaps;
      int changed = 0;
      for (std::size_t i = 0; i < from.states.size(); ++i) changed += !(from.states[i] == at_.states()[i]);
      end_.changes += std::max(changed, 1);
      return true;
    }
    together_at_ = end_.changes + pause_;
    pause_ = std::min(2 * pause_, most_pause);
    together_ = std::min(later_together, options_.together);
    return false;
  }

  /// Newton's method at the t that this step leads to, with the factors at hand. Where it begins to lead away, the
  /// last point before is where another path begins. False, and nothing changed, where neither is possible.
  bool leap(double step, const PathSystem::Point& from) {
    const int sign = at_.sign();
    const auto size = [](const Vector& v) { return v.lpNorm<Eigen::Infinity>(); };
    at_.advance(step);
    const double pressed = size(at_.z()), moved = size(at_.motion());
    PathSystem::Point last;
    std::size_t before = 0;
    for (int k = 0;; ++k) {
      const std::vector<PathSystem::Change> changes = impossible_states(beyond);
      const bool nearby = size(at_.z()) <= most_growth * std::max(size(from.z), pressed) &&
                          size(at_.motion()) <= most_growth * std::max(size(from.motion), moved);
      const bool may_end = (k > 0 || changes.empty()) && nearby && at_.sign() == sign;
      if (changes.empty() && may_end && at_.is_exact()) return true;
      if (changes.empty() && may_end && k < most_corrections) {
        if (!at_.correct()) break;
        continue;
      }
      const bool leads_on = k == 0 || static_cast<double>(changes.size()) <= fewer * static_cast<double>(before);
      const bool room = at_.replaced_rows() + 2 * static_cast<int>(changes.size()) <= at_.capacity();
      if (changes.empty() || !leads_on || !room) break;
      if (may_end) last = at_.point();
      before = changes.size();
      interruption_point();
      options_.deadline.spend(solves_of_a_change * at_.operations_of_solve());
      at_.change(changes);
      if (!at_.correct()) break;
    }
    const bool again = options_.hold > 0.0 && !last.states.empty() && begun_at_ * last.t > least_again;
    at_.go_to(again ? last : from);
    if (!again) return false;
    begin_again();
    return true;
  }

  void begin_again() {
    begun_at_ *= at_.t();
    at_.begin_again(margin_, 0.0);
    least_ = 1.0;
  }

  /// Where a path of held bodies does not come nearer to its end. Not where the bodies have begun to be let go.
  bool begin_again_here() {
    if (again_ == options_.again || options_.hold == 0.0 || round_ > 0 || begun_at_ * at_.t() < least_again)
      return false;
    ++again_;
    begin_again();
    still_from_ = begun_at_;
    still_at_ = least_at_ = end_.changes;
    passed_.reset();
    endless_ = false;
    return true;
  }

  /// The states that follow from forces and motions for the pairs beyond their limits by more than `least` of the
  /// largest.
  std::vector<PathSystem::Change> impossible_states(double least) const {
    const Vector &z = at_.z(), &motion = at_.motion();
    const double least_force = least * z.head(2 * at_.pairs()).lpNorm<Eigen::Infinity>(),
                 least_motion = least * motion.lpNorm<Eigen::Infinity>();
    std::vector<PathSystem::Change> changes;
    for (Index i = 0; i < at_.pairs(); ++i) {
      PathState state = at_.state(i);
      const double normal = z[2 * i], tangent = z[2 * i + 1];
      if (!state.contact) {
        if (motion[2 * i] < -least_motion) state = {true, side_of_motion(i)};
      } else if (normal < -least_force) {
        state = {false, state.side == 0 ? side_of_motion(i) : state.side};
      } else if (state.side == 0) {
        if (tangent > at_.mu_of(i, -1) * normal + least_force) state.side = -1;
        if (-tangent > at_.mu_of(i, 1) * normal + least_force) state.side = 1;
      } else if (at_.may_stick(i) && state.side * motion[2 * i + 1] < -least_motion) {
        state.side = 0;
      }
      if (!(state == at_.state(i))) changes.push_back({i, state});
    }
    return changes;
  }

  const PathOptions& options_;
  double margin_;  // where the path begins and begins again
  PathSystem at_;
  PathEnd end_;
  std::optional<PathSystem::Point> arrived_;  // where t was 0, the softness not yet or only in part taken back
  std::optional<Next> passed_;                // the limit that the path has just come from
  bool endless_ = false;                      // t stands still while the bodies move
  double begun_at_ = 1.0;                     // what t = 1 of the path at hand was of the first one
  double least_ = 1.0;                        // t, of the round
  double still_from_ = 1.0;                   // of begun_at_ * least_, at still_at_
  double held_ = 0.0;                         // what holds the bodies, over that of the first round
  double loosened_by_ = 1.0, error_before_ = HUGE_VAL;
  bool falls_ = false;
  int same_ = 0, again_ = 0, round_ = 0, rounds_ = 0, least_at_ = 0, still_at_ = 0, side_before_ = 0,
      place_at_ = between_places;
  int together_, together_at_ = 0, pause_ = least_pause, successes_ = 0;
};

}  // namespace

bool may_follow_path(const Problem& problem) {
  constexpr Index most_dense = 2000;  // rows: a factorisation costs their cube
  return problem.dimension == 2 && problem.pairs() > 0 && problem.cohesion.size() == 0 && problem.tension.size() == 0 &&
         (problem.W.is_sparse() || (problem.W.is_dense() && problem.W.size() <= most_dense));
}

PathEnd follow_path(const Problem& problem, const PathStart& start, const PathOptions& options) {
  return Path(problem, start, options).run();
}

}  // namespace scabo::contact
