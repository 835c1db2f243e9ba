#include "scabo/contact/soft_newton.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/soft_direction.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

namespace {

class SoftNewton {
 public:
  SoftNewton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options)
      : equations_(equations), options_(options), direction_(equations), p_(std::move(p)), a_(std::move(a)) {
    end_.residual = HUGE_VAL;
  }

  NewtonEnd run() {
    end_.p = p_;
    end_.a = a_;
    equations_.evaluate(p_, a_, at_);
    int gained_at = 0;
    double gained = HUGE_VAL, step = 0.0;
    bool moved = false;
    for (int steps = 0;; ++steps) {
      keep_best();
      record(step);
      if (best_ <= options_.fall * gained) gained = best_, gained_at = steps;
      if (end_.converged || !std::isfinite(at_.merit()) || steps >= most_steps || options_.deadline.passed()) break;
      if (end_.iterations >= options_.iterations || steps - gained_at >= options_.patience) break;
      options_.deadline.spend(operations_of_system(equations_.problem()));
      const bool found = direction_.find(at_, p_, d_);
      end_.iterations = direction_.factorisations();
      if (!found) break;
      step = descending_step();
      if (step < least_step) {
        if (!direction_.reused()) break;
        direction_.forget_factor();  // GMRES leaves a part of the right-hand side
        step = 0.0;
        continue;
      }
      if (!moved && step < options_.first_step) break;
      moved = true;
      p_ += step * d_.head(p_.size());
      a_ += step * d_.tail(a_.size());
      equations_.evaluate(p_, a_, at_);
    }
    if (!end_.converged && options_.content && end_.residual <= near * aim())
      end_.converged = options_.content(end_.p, end_.a, equations_.residual(end_.p, end_.a).motion);
    return std::move(end_);
  }

 private:
  static constexpr double sufficient = 1e-4;  // descent of the merit, of what the direction promises
  static constexpr double least_step = 1.0 / 16.0;
  static constexpr int most_steps = 60;               // those by the factor of an earlier one are cheap
  static constexpr double near = 1e3, fallen = 0.25;  // of the aim; of the least merit: what is left may be rounding

  double aim() const {
    return std::max(options_.small, options_.relative * (end_.p.size() > 0 ? end_.p.lpNorm<Eigen::Infinity>() : 0.0));
  }

  void keep_best() {
    const double merit = at_.merit();
    const bool stuck = at_.largest() <= near * aim() && merit > fallen * best_;
    const bool content = options_.content && stuck && options_.content(p_, a_, at_.motion);
    if (merit < best_ || content) {
      best_ = merit;
      end_.p = p_;
      end_.a = a_;
      end_.residual = at_.largest();
    }
    end_.converged = content || end_.residual <= aim();
  }

  void record(double step) {
    int changed = 0;
    for (std::size_t i = 0; i < before_.size(); ++i) changed += !at_.branches[i].same_branch(before_[i]);
    before_ = at_.branches;
    end_.trace.push_back({end_.iterations, at_.largest(), at_.merit(), step, changed, options_.stage});
    if (options_.on_iteration) options_.on_iteration(end_.trace.back());
  }

  /// The longest step 2^-k, not below the least, with sufficient descent; 0 where there is none.
  double descending_step() {
    const double merit = at_.merit();
    equations_.motion_along(d_, change_);
    for (double step = 1.0; step >= least_step; step *= 0.5) {
      trial_p_ = p_ + step * d_.head(p_.size());
      trial_.motion = at_.motion + step * change_;
      equations_.evaluate_at_motion(trial_p_, trial_);
      if (trial_.merit() <= (1.0 - 2.0 * sufficient * step) * merit) return step;
    }
    return 0.0;
  }

  const BDifferentiableEquations& equations_;
  const NewtonOptions& options_;
  SoftDirection direction_;
  Vector p_, a_, d_, change_, trial_p_;
  Residual at_, trial_;
  std::vector<Branch> before_;
  NewtonEnd end_;
  double best_ = HUGE_VAL;  // merit
};

}  // namespace

bool may_soften(const Problem& problem) {
  return problem.dimension == 2 && problem.W.is_sparse() && problem.G.cols() > 0;
}

NewtonEnd soft_newton(const BDifferentiableEquations& equations, Vector p, Vector a, const NewtonOptions& options) {
  return SoftNewton(equations, std::move(p), std::move(a), options).run();
}

}  // namespace scabo::contact
