// Solution of a discrete contact problem: a value. Non-convergence is a result, with its reason.
#pragma once

#include <string>
#include <vector>

#include "scabo/contact/certificate.hpp"

namespace scabo::contact {

/// mechanism: no forces at all balance the loads, which is proven. collapse: no stage found an equilibrium, and the
/// bodies begin to move when they are let go (questions/onset.hpp); friction may still allow an equilibrium.
/// infeasible: the problem has no solution, as shown by `proof` (questions/infeasibility.hpp).
enum class Status { solved, not_converged, mechanism, collapse, infeasible };

/// One iteration, as written to a trace.
struct Iteration {
  int iteration = 0;         ///< counted over all stages, including those of problems of fewer pairs
  double residual = 0.0;     ///< relative residual of the stage
  double merit = 0.0;        ///< its merit function; 0 if there is none
  double step_length = 0.0;  ///< of the line search; 1 if there is none
  int states_changed = 0;    ///< pairs whose state differs from the previous iteration
  std::string stage;         ///< name of the algorithm
};

struct Solution {
  Status status = Status::not_converged;  ///< what the solver ended with
  Vector p;               ///< forces on B, d N numbers, pair by pair: normal (compression positive), tangential
  Vector a;               ///< rigid motions, m numbers
  Vector gap;             ///< normal gaps, N numbers, positive if open
  Vector slip_increment;  ///< slip of B relative to A in this increment, (d - 1) N numbers
  std::vector<ContactState> states;  ///< of the pairs, N: 0 open, 1 stick, 2 slip
  int iterations = 0;                ///< factorisations of Newton's method, interior points and starts
  int coarse_iterations = 0;         ///< on problems of fewer pairs for the start; not counted above
  double residual = 0.0;             ///< |H| / force scale
  Certificate certificate;
  double natural_map_residual = 0.0;  ///< residual of the natural map (contact/judge.hpp)
  double rounding = 0.0;              ///< estimated rounding of the motions, relative (contact/judge.hpp)
  Vector motion;  ///< with `mechanism`, the motion that is not restrained, with `collapse` that of the fall, m numbers
  Vector proof;   ///< with `infeasible`, forces in equilibrium with themselves, d N numbers
  Matrix undetermined;           ///< m x k: rigid motions not determined by contact and loads (solved nevertheless)
  std::vector<Iteration> trace;  ///< every iteration of every stage
  std::string reason;            ///< why the problem was not solved, as a sentence
};

/// `solution` with the iterations of the one before, which led to it.
Solution continued(Solution before, Solution solution);

}  // namespace scabo::contact
