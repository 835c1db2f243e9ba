// Solution of a discrete contact problem: a value. Not to converge is a result, with its reason.
#pragma once

#include <string>
#include <vector>

#include "scabo/contact/certificate.hpp"

namespace scabo::contact {

enum class Status { solved, not_converged, mechanism };

struct Solution {
  Status status = Status::not_converged;
  Vector p;                          // 2N, forces on B
  Vector a;                          // m, rigid motions
  Vector gap;                        // N
  Vector slip_increment;             // N
  std::vector<ContactState> states;  // N
  int iterations = 0;                ///< Newton iterations, all attempts together
  double residual = 0.0;             ///< |H| / force scale
  Certificate certificate;
  Vector motion;                     ///< m: with `mechanism`, the motion that nothing holds
  Matrix undetermined;               ///< m x k: rigid motions that neither contact nor load fixes (solved all the same)
  std::vector<double> history;       ///< residual after each iteration
  std::string reason;                ///< why not, in a sentence
};

}  // namespace scabo::contact
