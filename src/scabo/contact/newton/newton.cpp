#include "scabo/contact/newton/newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/kkt/newton_direction.hpp"
#include "scabo/contact/work.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::contact {

namespace {

/// How far the iterations have come.
struct Progress {
  std::array<double, newton_constants.memory> merits;  // the last few
  double best = HUGE_VAL;                              // merit
  double halved = HUGE_VAL;                            // the best one when it was last halved,
  int halved_at = 0;                                   // and the iteration
  int unchecked = 0;                                   // whole steps that did not pass the search
  bool regularised = false;
  double step = 0.0;  // the last one
};

class Newton {
 public:
  Newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options)
      : equations_(equations), options_(options), direction_(equations), at_point_{std::move(p), std::move(a)} {}

  NewtonEnd run() {
    const double operations = operations_of_system(equations_.problem());
    end_.p = at_point_.p;
    end_.a = at_point_.a;
    end_.trace.reserve(static_cast<std::size_t>(options_.iterations) + 1);
    end_.residual = HUGE_VAL;  // stays where H is not finite: never converged
    equations_.evaluate(at_point_.p, at_point_.a, at_);
    for (;; ++end_.iterations) {
      keep_best();
      record();
      if (end_.converged || end_.iterations >= options_.iterations || !std::isfinite(at_.merit()) || creeps()) break;
      options_.deadline.spend(operations);
      if (options_.deadline.passed() || !(settle() || advance())) break;
    }
    // However the search ended: what is left may be rounding.
    end_.converged = end_.converged || end_.residual <= std::max(aim(), options_.rounding);
    return std::move(end_);
  }

 private:
  /// One step; false where there is none.
  bool advance() {
    for (;; progress_.regularised = true) {
      const bool found = direction_.find(at_, regularisation(), d_);
      const double step = found ? passing_step() : 0.0;
      if (step > 0.0) return take(step);
      if (!progress_.regularised) continue;
      if (found && ++progress_.unchecked <= newton_constants.unchecked) return take(1.0);
      end_.singular = !found;
      return false;
    }
  }

  /// Where the iterations go around, and many pairs have forces and motions as small as |H|, as at crack tips: the step
  /// to where these stick, without a search.
  bool settle() {
    if (end_.iterations - progress_.halved_at != newton_constants.going_around) return false;
    const double level = newton_constants.undecided_below * at_.largest();
    if (!(level < linalg::largest_of(at_point_.p))) return false;  // no pair is decided yet
    trial_ = at_;
    const int undecided = equations_.stick_below(level, at_point_.p, trial_);
    if (newton_constants.few * undecided <= equations_.problem().pairs()) return false;
    return direction_.find(trial_, 0.0, d_) && take(1.0);
  }

  double regularisation() const {
    if (!progress_.regularised) return 0.0;
    const double part = newton_constants.part * at_.largest() / linalg::largest_of(at_point_.p);  // infinite at p = 0
    return std::clamp(part, newton_constants.least, newton_constants.most);
  }

  /// The longest step 2^-k along d that passes the search; 0 where there is none.
  double passing_step() {
    const double largest = *std::max_element(progress_.merits.begin(), progress_.merits.end()), merit = at_.merit();
    double step = 1.0;
    for (int k = 0; k <= newton_constants.halvings; ++k, step *= 0.5) {
      trial_p_ = at_point_.p + step * d_.head(at_point_.p.size());
      trial_.motion = at_.motion + step * at_.along;
      equations_.evaluate_at_motion(trial_p_, trial_);
      if (trial_.merit() <= largest - 2.0 * newton_constants.sufficient * step * merit)
        return step;  // theta'(z; d) = -2 theta
    }
    return 0.0;
  }

  bool take(double step) {
    progress_.step = step;
    at_point_.p.noalias() += step * d_.head(at_point_.p.size());
    at_point_.a.noalias() += step * d_.tail(at_point_.a.size());
    equations_.evaluate(at_point_.p, at_point_.a, at_);
    return true;
  }

  void keep_best() {
    const double merit = at_.merit();
    const bool asked =
        options_.accepts && (!options_.ask_when_stuck || no_longer_falls(merit) || at_.largest() <= aim());
    const bool accepted = asked && options_.accepts(at_point_.p, at_point_.a, at_.motion);
    if (merit < progress_.best || accepted) {
      progress_.best = merit;
      end_.p = at_point_.p;
      end_.a = at_point_.a;
      end_.residual = at_.largest();
    }
    end_.converged = accepted || (!options_.accepts && end_.residual <= aim());
    if (end_.iterations == 0) progress_.merits.fill(merit);
    progress_.merits[static_cast<std::size_t>(end_.iterations % newton_constants.memory)] = merit;
  }

  /// Short steps from kink to kink, which lead on but not to an end; or what is left is small and may be rounding.
  bool creeps() {
    if (progress_.best <= 0.5 * progress_.halved) {
      progress_.halved = progress_.best;
      progress_.halved_at = end_.iterations;
    }
    if (end_.residual <= std::max(aim(), options_.rounding) && end_.iterations > progress_.halved_at) return true;
    return options_.patience > 0 && end_.iterations - progress_.halved_at >= options_.patience;
  }

  /// |H| is near its aim and was not halved: what is left may be rounding.
  bool no_longer_falls(double merit) const {
    return at_.largest() <= newton_constants.near * std::max(aim(), options_.rounding) &&
           merit > newton_constants.halved * progress_.best;
  }

  double aim() const { return std::max(options_.small, options_.relative * linalg::largest_of(end_.p)); }

  void record() {
    int changed = 0;
    for (std::size_t i = 0; i < before_.size(); ++i) changed += !at_.branches[i].same_branch(before_[i]);
    before_ = at_.branches;
    end_.trace.push_back({end_.iterations, at_.largest(), at_.merit(), progress_.step, changed, options_.stage});
    if (options_.on_iteration) options_.on_iteration(end_.trace.back());
  }

  const BDifferentiableEquations& equations_;
  const NewtonOptions& options_;
  NewtonDirection direction_;
  Point at_point_;
  Residual at_, trial_;
  Vector d_, trial_p_;  // memory that is kept
  std::vector<Branch> before_;
  Progress progress_;
  NewtonEnd end_;
};

}  // namespace

NewtonEnd newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options) {
  return Newton(equations, std::move(p), std::move(a), options).run();
}

}  // namespace scabo::contact
