// Solution of a discrete contact problem: a value. Non-convergence is a result, with its reason.
#pragma once

#include <string>
#include <vector>

#include "scabo/contact/certificate.hpp"

namespace scabo::contact {

/// infeasible: no forces solve it, and `proof` shows why (contact/infeasibility.hpp).
enum class Status { solved, not_converged, mechanism, infeasible };

/// One iteration as it is written to a trace.
struct Iteration {
  int iteration = 0;         ///< counted over all stages, those of problems of fewer pairs included
  double residual = 0.0;     ///< what the stage drives to zero, relative
  double merit = 0.0;        ///< its merit function; 0 where there is none
  double step_length = 0.0;  ///< of the line search; 1 where there is none
  int states_changed = 0;    ///< pairs whose state differs from the iteration before
  std::string stage;         ///< name of the algorithm at work
};

struct Solution {
  Status status = Status::not_converged;
  Vector p;                          // dN, forces on B
  Vector a;                          // m, rigid motions
  Vector gap;                        // N
  Vector slip_increment;             // (d - 1) N
  std::vector<ContactState> states;  // N
  int iterations = 0;                ///< Newton iterations, all attempts together
  int coarse_iterations = 0;         ///< of problems of fewer pairs that made the start; not counted above
  double residual = 0.0;             ///< |H| / force scale
  Certificate certificate;
  double natural_map_residual = 0.0;  ///< contact/judge.hpp
  double rounding = 0.0;              ///< of the motions, against those at work: contact/judge.hpp
  Vector motion;                      ///< m: with `mechanism`, the motion that is not restrained
  Vector proof;                       ///< dN: with `infeasible`, forces in balance with themselves
  Matrix undetermined;           ///< m x k: rigid motions that neither contact nor load fixes (solved all the same)
  std::vector<Iteration> trace;  ///< every iteration of every stage
  std::string reason;            ///< why not, in a sentence
};

}  // namespace scabo::contact
