#include "scabo/contact/newton.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/newton_direction.hpp"
#include "scabo/contact/starts/bonded_start.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

namespace {

class Newton {
 public:
  Newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options)
      : equations_(equations),
        options_(options),
        direction_(equations),
        many_(may_bond(equations.problem())),
        operations_(operations_of_system(equations.problem())),
        p_(std::move(p)),
        a_(std::move(a)) {}

  NewtonEnd run() {
    end_.p = p_;
    end_.a = a_;
    end_.residual = HUGE_VAL;  // stays where H is not finite: never converged
    end_.trace.reserve(static_cast<std::size_t>(options_.iterations) + 1);
    equations_.evaluate(p_, a_, at_);
    const double first = at_.largest();
    while (true) {
      keep_best();
      record();
      if (end_.converged || end_.iterations >= options_.iterations + given_up_ || !std::isfinite(at_.merit()) ||
          options_.deadline.passed() || creeps())
        break;
      if (end_.iterations == most_stuck && given_up_ == 0) go_back_from_stuck();
      ++end_.iterations;
      options_.deadline.spend(operations_);
      if (end_.iterations == 1 && step_with_undecided_stuck()) continue;
      if (many_ && step_of_many_bodies(first)) continue;
      if (many_ && options_.watched == 0) {
        end_.singular = !found_;
        break;
      }
      const bool found = find_direction(first, NewtonDirection::Ties::as_d_takes_them);
      if (found && line_search()) continue;
      if (!found || ++unchecked_ > options_.unchecked) {
        end_.singular = !found;
        break;
      }
      take(1.0);
    }
    return std::move(end_);
  }

 private:
  /// With the regularisation of the moment; where no direction exists all the same, with more and more.
  bool find_direction(double first, NewtonDirection::Ties ties) {
    double alpha = eased_ * options_.regularisation * std::clamp(at_.largest() / first, 1e-8, 1.0);
    for (int attempt = 0; attempt < 4; ++attempt, alpha *= 100.0) {
      if (direction_.find(p_, at_, alpha, ties, d_)) return true;
      if (alpha == 0.0) return false;
    }
    return false;
  }

  /// Interior points know forces and motions to within |H|, which is more than pairs have at the tip of a crack: 1e-9
  /// of the largest force, where sides are divided towards it. Their branches there are those of errors, of which
  /// Newton's method mends one ring of pairs after the other (13 to 28 iterations). Where they all stick, the first
  /// step finds the field around the tip, which tells their states: 1 to 3, even if a wrong state makes |H| large on
  /// the way.
  bool step_with_undecided_stuck() {
    constexpr int few = 10;  // of so many pairs not more than one is undecided: Newton finds its state itself
    if (options_.undecided <= 0.0) return false;
    trial_ = at_;
    const int undecided = equations_.stick_below(options_.undecided * at_.largest(), p_, trial_);
    if (few * undecided <= equations_.problem().pairs()) return false;
    if (!direction_.find(p_, trial_, 0.0, NewtonDirection::Ties::free, d_)) return false;
    stuck_merit_ = at_.merit();
    take(1.0);
    return true;
  }

  /// Where the faces of a crack slip at its tips the step leads away. The best point is the first one then.
  void go_back_from_stuck() {
    if (!(stuck_merit_ > 0.0) || at_.merit() < stuck_merit_) return;
    given_up_ = most_stuck;
    halved_at_ = end_.iterations;
    watch_ = patience_ = 0;
    p_ = end_.p;
    a_ = end_.a;
    equations_.evaluate(p_, a_, at_);
  }

  /// Of a wall hundreds of joints change their state together, and have ties besides: they just touch or are about to
  /// slip. One kink after the other stops the line search, while full steps pass them all: up to `watched` full steps
  /// without descent are tried before the search is used (watchdog of Chamberlain, Powell, Lemarechal and Pedersen,
  /// Math. Programming Study 16 (1982) 1). A tower of 50 blocks at half of its overturning load: 43 iterations with the
  /// search alone.
  bool step_of_many_bodies(double first) {
    constexpr int patience = 8;
    constexpr double long_enough = 0.5;
    if (watch_ > 0 && at_.merit() < watched_merit_) watch_ = 0;
    if (watch_ > 0 && watch_ == options_.watched) {
      p_ = watched_p_;
      a_ = watched_a_;
      equations_.evaluate(p_, a_, at_);
      watch_ = 0;
      patience_ = patience;
    }
    found_ = find_direction(first, NewtonDirection::Ties::free);
    if (!found_) return false;
    const double step = descending_step();
    if (watch_ == 0 && (step >= long_enough || (patience_ > 0 && step > 0.0))) {
      --patience_;
      take(step);
      return true;
    }
    if (patience_ > 0 || options_.watched == 0) return false;
    if (watch_++ == 0) {
      watched_p_ = p_;
      watched_a_ = a_;
      watched_merit_ = at_.merit();
    }
    take(1.0);
    return true;
  }

  void keep_best() {
    const double merit = at_.merit();
    const bool asked = options_.content && (!options_.ask_when_stuck || no_longer_falls(merit));
    const bool content = asked && options_.content(p_, a_, at_.motion);
    if (merit < best_merit_ || content) {
      best_merit_ = merit;
      end_.p = p_;
      end_.a = a_;
      end_.residual = at_.largest();
    }
    end_.converged = content || end_.residual <= aim();
  }

  /// Short steps from kink to kink, which lead on but not to an end.
  bool creeps() {
    if (end_.iterations == 0) first_merit_ = at_.merit();
    if (end_.iterations == 1 && best_merit_ > options_.first_fall * first_merit_) return true;
    if (best_merit_ <= options_.fall * halved_merit_) {
      halved_merit_ = best_merit_;
      halved_at_ = end_.iterations;
    }
    return options_.patience > 0 && end_.iterations - halved_at_ >= options_.patience;
  }

  /// |H| is near its aim and was not halved: what is left may be rounding.
  bool no_longer_falls(double merit) const {
    constexpr double near = 1e3, halved = 0.25;
    return at_.largest() <= near * aim() && merit > halved * best_merit_;
  }

  /// Where a whole step near the solution changes no state and hardly lowers the merit, the regularisation alone holds
  /// it back: of a wall of 30 x 30 blocks with masses 1 : 100, modes as soft as 1e-6 of W. It left 0.98 of |H| in each
  /// iteration. Further away it may keep Newton from leaving (pile100x4_mu0.8_ratio100).
  void ease(bool states_kept) {
    constexpr double near = 1e-8, hardly = 0.25, part = 0.1, least = 1e-8;
    const double merit = at_.merit();
    if (end_.iterations > 0 && states_kept && step_ == 1.0 && merit <= last_merit_ && merit > hardly * last_merit_ &&
        at_.largest() <= near * p_.lpNorm<Eigen::Infinity>())
      eased_ = std::max(part * eased_, least);
    last_merit_ = merit;
  }

  double aim() const {
    const double largest = end_.p.size() > 0 ? end_.p.lpNorm<Eigen::Infinity>() : 0.0;
    return std::max(options_.small, options_.relative * largest);
  }

  void record() {
    int changed = 0;
    bool kept = true;
    for (std::size_t i = 0; i < before_.size(); ++i) {
      changed += !at_.branches[i].same_branch(before_[i]);
      kept = kept && at_.branches[i].same_state(before_[i]);
    }
    before_ = at_.branches;
    ease(kept);
    end_.trace.push_back({end_.iterations, at_.largest(), at_.merit(), step_, changed, options_.stage});
    if (options_.on_iteration) options_.on_iteration(end_.trace.back());
  }

  void take(double step) {
    step_ = step;
    p_.noalias() += step * d_.head(p_.size());
    a_.noalias() += step * d_.tail(a_.size());
    equations_.evaluate(p_, a_, at_);
  }

  bool line_search() {
    const double step = descending_step();
    if (step > 0.0) take(step);
    return step > 0.0;
  }

  /// The longest step 2^-k along d with sufficient descent; 0 where there is none.
  double descending_step() {
    constexpr double sufficient = 1e-4;
    constexpr int halvings = 12;
    const double merit = at_.merit();
    equations_.motion_along(d_, change_);
    double step = 1.0;
    for (int k = 0; k <= halvings; ++k, step *= 0.5) {
      trial_p_ = p_ + step * d_.head(p_.size());
      trial_.motion = at_.motion + step * change_;
      equations_.evaluate_at_motion(trial_p_, trial_);
      if (trial_.merit() <= (1.0 - 2.0 * sufficient * step) * merit) return step;  // theta'(z; d) = -2 theta
    }
    return 0.0;
  }

  static constexpr int most_stuck = 2;  // iterations after which a step with undecided pairs stuck has led nearer

  const BDifferentiableEquations& equations_;
  const NewtonOptions& options_;
  NewtonDirection direction_;
  bool many_;          // bodies
  bool found_ = true;  // the last direction of many bodies
  double operations_;  // of an iteration
  Vector p_, a_, d_, change_, trial_p_;
  Residual at_, trial_;
  std::vector<Branch> before_;
  NewtonEnd end_;
  double best_merit_ = HUGE_VAL, first_merit_ = 0.0, last_merit_ = HUGE_VAL, step_ = 0.0;
  double eased_ = 1.0;              // part of the regularisation that is left
  double halved_merit_ = HUGE_VAL;  // the smallest one when it was last halved,
  int halved_at_ = 0;               // and the iteration
  double stuck_merit_ = 0.0;        // before a step with undecided pairs stuck; 0: none
  int given_up_ = 0;                // iterations after such a step that led away
  int unchecked_ = 0;               // full steps without descent
  int watch_ = 0, patience_ = 0;    // full steps since watched_; line searches to go before the next
  Vector watched_p_, watched_a_;
  double watched_merit_ = 0.0;
};

}  // namespace

NewtonEnd newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options) {
  return Newton(equations, std::move(p), std::move(a), options).run();
}

}  // namespace scabo::contact
