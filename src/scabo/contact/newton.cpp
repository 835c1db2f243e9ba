#include "scabo/contact/newton.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/newton_direction.hpp"

namespace scabo::contact {

namespace {

class Newton {
 public:
  Newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options)
      : equations_(equations), options_(options), direction_(equations), p_(std::move(p)), a_(std::move(a)) {}

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
      if (end_.converged || end_.iterations >= options_.iterations || !std::isfinite(at_.merit())) break;
      const bool found = find_direction(first);
      ++end_.iterations;
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
  bool find_direction(double first) {
    double alpha = options_.regularisation * std::clamp(at_.largest() / first, 1e-8, 1.0);
    for (int attempt = 0; attempt < 4; ++attempt, alpha *= 100.0) {
      if (direction_.find(at_, alpha, d_)) return true;
      if (alpha == 0.0) return false;
    }
    return false;
  }

  void keep_best() {
    const double merit = at_.merit();
    const bool content = options_.content && options_.content(p_, at_.motion);
    if (merit < best_merit_ || content) {
      best_merit_ = merit;
      end_.p = p_;
      end_.a = a_;
      end_.residual = at_.largest();
    }
    end_.converged = content || end_.residual <= options_.small;
  }

  void record() {
    int changed = 0;
    for (std::size_t i = 0; i < before_.size(); ++i) changed += !at_.branches[i].same_branch(before_[i]);
    before_ = at_.branches;
    end_.trace.push_back({end_.iterations, at_.largest(), at_.merit(), step_, changed, options_.stage});
  }

  void take(double step) {
    step_ = step;
    p_.noalias() += step * d_.head(p_.size());
    a_.noalias() += step * d_.tail(a_.size());
    equations_.evaluate(p_, a_, at_);
  }

  bool line_search() {
    constexpr double sufficient = 1e-4;
    constexpr int halvings = 12;
    const double merit = at_.merit();
    equations_.motion_along(d_, change_);
    double step = 1.0;
    for (int k = 0; k <= halvings; ++k, step *= 0.5) {
      trial_p_ = p_ + step * d_.head(p_.size());
      trial_.motion = at_.motion + step * change_;
      equations_.evaluate_at_motion(trial_p_, trial_);
      if (trial_.merit() > (1.0 - 2.0 * sufficient * step) * merit) continue;  // theta'(z; d) = -2 theta
      take(step);
      return true;
    }
    return false;
  }

  const BDifferentiableEquations& equations_;
  const NewtonOptions& options_;
  NewtonDirection direction_;
  Vector p_, a_, d_, change_, trial_p_;
  Residual at_, trial_;
  std::vector<Branch> before_;
  NewtonEnd end_;
  double best_merit_ = HUGE_VAL, step_ = 0.0;
  int unchecked_ = 0;  // full steps without descent
};

}  // namespace

NewtonEnd newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options) {
  return Newton(equations, std::move(p), std::move(a), options).run();
}

}  // namespace scabo::contact
