// What the stages of a solve share: the problem in the units in which they work, the start, who judges, the best point
// so far and the trace.
//
// The problem is scaled so that W_ii is 1 in the mean (motions are then forces); the forces p are those of the problem,
// the rigid motions a are multiplied by the stiffness.
#pragma once

#include <string>
#include <vector>

#include "scabo/contact/judge.hpp"
#include "scabo/contact/newton/newton.hpp"
#include "scabo/contact/solution.hpp"
#include "scabo/contact/solve.hpp"

namespace scabo::contact {

/// What a stage ended with, and why, as the end of a sentence: "Newton's method found no direction".
struct StageEnd {
  bool solved = false;
  std::string why;
};

/// How a stage runs Newton's method.
struct NewtonRun {
  std::string stage = "newton";
  int iterations = 0;  ///< 0: those of the options
  int patience = 0;    ///< NewtonOptions::patience
};

class Search {
 public:
  /// Keeps references to `problem` and `options`.
  Search(const Problem& problem, const Start& start, const SolverOptions& options);

  const Problem& problem() const { return scaled_; }
  BDifferentiableEquations equations() const { return {scaled_, options_.r_factor}; }
  const SolverOptions& options() const { return options_; }
  const Point& start() const { return start_; }
  bool has_history() const { return has_history_; }
  const std::vector<bool>& touching() const { return touching_; }
  double stiffness() const { return stiffness_; }  ///< by which W, q and a are multiplied
  const Measure& measure() const { return measure_; }
  bool late() const { return options_.deadline.passed(); }
  bool by_natural_map() const { return options_.judge == Judge::natural_map; }

  /// Whether forces, rigid motions and the motions they cause are a solution.
  bool accepts(const Vector& p, const Vector& a, const Vector& motion) const { return accepts_(p, a, motion); }
  const IsSolution& judge() const { return accepts_; }

  /// Newton's method from `from`; its end counts as found, and its iterations are told.
  NewtonEnd newton_from(Point from, const NewtonRun& run);
  /// Counts the point if it is the best so far. `solved`: it is known to be a solution; of several the most exact
  /// counts.
  void offer(const Vector& p, const Vector& a, double residual, bool solved);
  /// |H| of a point, its largest entry.
  double residual_at(const Vector& p, const Vector& a) const;
  /// Iterations of a stage, numbered on from those before; `force`: the unit of their residuals.
  void add_trace(std::vector<Iteration> trace, int iterations, double force = 1.0);
  void add_coarse(std::vector<Iteration> trace, int iterations);

  const Point& best() const { return best_; }
  double best_residual() const { return best_residual_; }
  bool solved() const { return solved_; }
  int iterations() const { return iterations_; }
  int coarse_iterations() const { return coarse_iterations_; }
  std::vector<Iteration> take_trace() { return std::move(trace_); }

 private:
  const SolverOptions& options_;
  double stiffness_;
  Problem scaled_;
  Measure measure_;
  Point start_;
  bool has_history_ = false;
  std::vector<bool> touching_;
  double small_ = 0.0;     // |H| far below the tolerance
  double rounding_ = 0.0;  // |H| that may be rounding
  IsSolution accepts_;

  Point best_;
  double best_residual_;
  bool solved_ = false;
  int iterations_ = 0, coarse_iterations_ = 0;
  std::vector<Iteration> trace_;
};

}  // namespace scabo::contact
