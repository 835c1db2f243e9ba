// The fallback strategies of solve() in order: starts for Newton, each followed by Newton on the original problem.
#pragma once

#include <cmath>
#include <initializer_list>
#include <optional>

#include "scabo/contact/held_slips.hpp"
#include "scabo/contact/interior_point.hpp"
#include "scabo/contact/newton.hpp"
#include "scabo/contact/path.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/contact/starts/bonded_start.hpp"
#include "scabo/contact/starts/cold_start.hpp"
#include "scabo/contact/starts/long_sweeps.hpp"

namespace scabo::contact {

/// The problem with motions as forces (W, q scaled by one stiffness), so that all unknowns are forces.
struct Scaled {
  Problem problem;
  double stiffness = 1.0;  ///< force / length
};
Scaled scaled(const Problem& problem);

/// How bodies fall if no path of equilibria arrives.
struct Collapse {
  Vector motion;      ///< m, of length 1
  double held = 0.0;  ///< part of the way from the previous increment on which there is equilibrium; 0: not known
};

class Ladder {
 public:
  /// `small`: the largest |H| at which Newton may stop; `content`: decides whether forces and (scaled) motions are
  /// accepted, if H does not.
  Ladder(const Problem& scaled_problem, const SolverOptions& options, double small, IsSolution content);

  /// Returns the best result when no strategy converges. `hopeless`, if given, is called once, after the first
  /// attempts.
  NewtonEnd climb(const Vector& p, const Vector& a, const std::vector<bool>& touching,
                  const std::function<bool()>& hopeless);

  int iterations() const { return iterations_; }
  /// On problems with fewer pairs (contact/cold_start.hpp); not included in iterations().
  int coarse_iterations() const { return coarse_iterations_; }
  std::vector<Iteration> take_trace() { return std::move(trace_); }
  /// Meaningful if no solution was found.
  std::optional<Collapse> collapse() const {
    return may_fall_ && collapse_ && collapse_->motion.size() > 0 ? collapse_ : std::nullopt;
  }

 private:
  struct Run {
    std::string stage;
    double regularisation = 0.0;
    double r_factor = 1.0;
    int iterations = 0;       ///< 0: those of the options
    int patience = 0;         ///< NewtonOptions::patience
    double fall = 0.5;        ///< NewtonOptions::fall
    double first_fall = 1.0;  ///< NewtonOptions::first_fall
    double first_step = 0.0;  ///< NewtonOptions::first_step
    double undecided = 0.0;   ///< NewtonOptions::undecided
    int watched = 6;          ///< NewtonOptions::watched
    bool soft = false;        ///< contact/soft_newton, where it may
  };
  static NewtonEnd nothing() {
    NewtonEnd end;
    end.residual = HUGE_VAL;
    return end;
  }
  /// Tells iterations with their numbers over all attempts; empty if nobody listens.
  std::function<void(const Iteration&)> counted(const std::function<void(const Iteration&)>& tell) const;
  NewtonEnd run(const Problem& problem, const Vector& p, const Vector& a, const Run& how);
  NewtonEnd newton_alone(const Vector& p, const Vector& a, const Run& how) { return run(problem_, p, a, how); }
  NewtonEnd newton_of_many(const Vector& p, const Vector& a, const Run& how);
  NewtonEnd softly(const Vector& p, const Vector& a, Run how);
  NewtonEnd climb_elastic(const Vector& p, const Vector& a, const std::vector<bool>& touching,
                          const std::function<bool()>& hopeless);
  NewtonEnd newton_or_kept_states(const Vector& p, const Vector& a, Run how);
  NewtonEnd on_kept_states(const Vector& p, const Vector& a, double best = HUGE_VAL);
  /// Bonded pairs, where contact alone holds bodies; asked for once.
  const std::optional<BondedStart>& held_together();
  NewtonEnd bonded(const BondedStart& start);
  NewtonEnd along_loads(const Vector& p, const Vector& a);
  NewtonEnd along_paths(const BondedStart& bonded, const std::vector<bool>& touching);
  NewtonEnd with_bodies_held();
  NewtonEnd arrived(PathEnd end);
  bool may_cross_over() const;
  bool begins_bonded();
  struct CrossingPoint {
    Vector p, a;
  };
  NewtonEnd crossed_over(const std::vector<CrossingPoint>& points);
  NewtonEnd crossed_from_bonded();
  NewtonEnd crossed(const CrossingPoint& from, double margin);
  PathStart crossing_start(const CrossingPoint& from, double margin) const;
  PathEnd along_path(const PathStart& start, bool held = false);
  NewtonEnd confirmed(NewtonEnd found, const std::string& name, Run how);
  NewtonEnd confirmed_inside(NewtonEnd found);
  NewtonEnd without_history(const Vector& p, const Vector& a);
  void take_trace_of(ColdStart& start);
  NewtonEnd after_start(ColdStart start, const Run& how);
  NewtonEnd climb_rank_deficient(const Vector& p, const std::function<bool()>& hopeless);
  NewtonEnd swept(const Vector& p, int sweeps, double regularisation, int iterations = 0);
  NewtonEnd swept_on(LongSweeps& sweeps, int most);
  InteriorPointEnd interior_points_from(double start_factor);
  NewtonEnd inside_from(double start_factor);
  NewtonEnd inside_near(Vector p, Vector a, double start);
  NewtonEnd inside(std::initializer_list<double> start_factors);
  NewtonEnd with_held_slips(HeldSlips& held, int rounds, double fall);
  NewtonEnd end_of_sweeps(Vector p, int sweeps);
  NewtonEnd floating_proximal(Vector p, Vector a);
  NewtonEnd vanishing_proximal(Vector p, int most = 0);
  NewtonEnd growing_friction(const Vector& p, const Vector& a);
  NewtonEnd growing_load(const Vector& p, const Vector& a);
  NewtonEnd after_sweeps(const Vector& p, const Vector& a);
  NewtonEnd after_pivoting(const Problem& held);
  bool may_sweep() const;
  /// Whether `content` decides on every point: problems of others. Newton on elastic bodies ends by |H|.
  bool judges_all() const { return options_.judge == Judge::natural_map; }
  bool late() const { return options_.deadline.passed(); }
  bool bodies_fall() const { return falls_ > 1; }

  const Problem& problem_;
  const SolverOptions& options_;
  double small_;
  IsSolution content_;
  int iterations_ = 0, coarse_iterations_ = 0;
  std::vector<Iteration> trace_;
  const std::vector<bool>* touching_ = nullptr;
  std::optional<std::optional<BondedStart>> held_together_;
  bool crossed_from_bonded_ = false;
  int falls_ = 0;  ///< paths on which bodies that were held fall when they are let go
  std::optional<Collapse> collapse_;
  bool may_fall_ = true;  ///< no path was left unfinished
};

}  // namespace scabo::contact
