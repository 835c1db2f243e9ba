// Saddle systems (saddle_system.hpp) of rigid bodies, in unknowns that are fewer than the forces: the motions of the
// bodies where these are known (motion_system.hpp), else those of their joints (joint_system.hpp).
#pragma once

#include <memory>

#include "scabo/contact/kkt/saddle_matrix.hpp"

namespace scabo::contact {

class RigidSystem {
 public:
  /// Null where bodies are not rigid, or have so few pairs that nothing is gained. Keeps a reference to `problem`.
  static std::unique_ptr<RigidSystem> of(const Problem& problem);

  virtual ~RigidSystem() = default;
  /// `D`: in place of that of `rows`, positive. May keep a reference to `rows`. False where a pivot is zero.
  [[nodiscard]] virtual bool factorise(const SaddleRows& rows, const Vector& D) = 0;
  /// x = [z; a] of b = [b; g], of what was factorised last, without refinement.
  virtual void solve(const Vector& b, Vector& x) const = 0;
};

}  // namespace scabo::contact
