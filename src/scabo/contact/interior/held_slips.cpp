#include "scabo/contact/interior/held_slips.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/constants.hpp"
#include "scabo/contact/extrapolation.hpp"
#include "scabo/contact/interior/judged_steps.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

namespace {

template <int d>
class FixedPoint {
 public:
  explicit FixedPoint(const Problem& problem)
      : problem_(&problem),
        measure_(problem),
        steps_(problem),
        scale_(steps_.size_of_loads() / std::sqrt(static_cast<double>(problem.pairs()))),
        change_(scale_),
        held_(Vector::Zero(problem.pairs())) {
    steps_.start(1.0);
  }

  void run(const IsSolution& accepts, const Deadline& deadline,
           const std::function<bool(InteriorPointEnd)>& cross_over) {
    InteriorPointEnd end;
    double aim = held_constants.first_aim;
    while (true) {
      const double map = solve(accepts, deadline, end);
      const bool last =
          end.accepted || !std::isfinite(map) || deadline.passed() || since_halved_ == held_constants.rounds;
      if (!last) hold_next();
      if (!last && map > aim) continue;
      aim = held_constants.next_aim * end.residual;
      if (cross_over(std::move(end)) || last) return;
      end = {};
    }
  }

 private:
  struct Passed {
    double gap;
    typename InteriorSteps<d>::Point point;
  };

  /// The convex problem of the slips held; the natural map of the last point.
  double solve(const IsSolution& accepts, const Deadline& deadline, InteriorPointEnd& end) {
    const HeldConstants& c = held_constants;
    const double enough = std::max(c.aim * change_ * change_, c.least * scale_ * scale_);
    steps_.hold(held_);
    double least_gap = HUGE_VAL;
    for (int step = 0, since = 0;; ++step, ++end.iterations) {
      interruption_point();
      deadline.spend(operations_of_system(*problem_));
      steps_.evaluate();
      if (step == 0) steps_.measure_from_here();
      const double map = judge_iterate(steps_, *problem_, measure_, accepts, "slips held", end);
      if (!std::isfinite(map) || end.accepted) return map;
      const double gap = steps_.gap();
      passed_.push_back({gap, steps_.point()});
      since = gap <= interior_constants.gain * least_gap ? 0 : since + 1;
      least_gap = std::min(least_gap, gap);
      const bool solved = gap <= enough && steps_.distance() <= c.met * change_;
      if (solved || since >= interior_constants.patience || step >= c.most || deadline.passed() || !steps_.advance())
        return map;
    }
  }

  /// The next slips, and the point from which they are looked for.
  void hold_next() {
    const HeldConstants& c = held_constants;
    const Vector slips = steps_.lifts();
    const Vector off = slips - held_;
    change_ = off.template lpNorm<Eigen::Infinity>();
    choose_way(off.norm());
    Vector next = way_ == Way::halved ? Vector(0.5 * (slips + held_)) : slips;
    remembered_.remember(off, slips);
    if (way_ == Way::extrapolated) remembered_.apply(next);
    const double sticks = c.sticking * std::sqrt(steps_.gap());
    for (Eigen::Index i = 0; i < next.size(); ++i) next[i] = slips[i] <= sticks ? 0.0 : std::max(next[i], 0.0);
    const double moved = (next - held_).template lpNorm<Eigen::Infinity>();
    held_ = std::move(next);
    while (passed_.size() > 1 && passed_.back().gap < c.start * moved * moved) passed_.pop_back();
    steps_.go_to(passed_.back().point);
    passed_.pop_back();
  }

  void choose_way(double off) {
    ++since_halved_;
    if (off < 0.5 * halved_) halved_ = off, since_halved_ = 0;
    if (off <= held_constants.fall * fallen_) fallen_ = off, since_fall_ = 0;
    if (++since_fall_ <= held_constants.rounds_of_way) return;
    way_ = way_ == Way::plain ? Way::extrapolated : way_ == Way::extrapolated ? Way::halved : Way::plain;
    since_fall_ = 0;
    fallen_ = off;
  }

  enum class Way { plain, extrapolated, halved };

  const Problem* problem_;
  Measure measure_;
  InteriorSteps<d> steps_;
  double scale_, change_;
  Vector held_;                 // lifts
  std::vector<Passed> passed_;  // of this round and those before it, m falling from round to round
  Extrapolation remembered_{held_constants.remembered};
  Way way_ = Way::plain;
  double fallen_ = HUGE_VAL, halved_ = HUGE_VAL;
  int since_fall_ = 0, since_halved_ = 0;
};

}  // namespace

void hold_slips(const Problem& problem, const IsSolution& accepts, const Deadline& deadline,
                const std::function<bool(InteriorPointEnd)>& cross_over) {
  if (problem.dimension == 3)
    FixedPoint<3>(problem).run(accepts, deadline, cross_over);
  else
    FixedPoint<2>(problem).run(accepts, deadline, cross_over);
}

}  // namespace scabo::contact
