// Rigid motions that no pair feels, open or closed: G v = 0 in all rows that can carry a force (normals; tangents with
// friction or strength). Two blocks pressed together may move sideways together, and a body that slides without
// friction along its sides moves alone.
//
// Newton's equations are singular along them, or worse, determined by the last digits of the normals, which then decide
// about the forces. No force depends on them where the loads do not drive them, so that they are taken out first and
// stay as they were.
#pragma once

#include <optional>

#include "scabo/contact/solution.hpp"

namespace scabo::contact {

struct WithoutNeutral {
  Problem problem;              ///< without the columns `held` of G and f: these motions are 0 there
  Matrix neutral;               ///< m x k, orthonormal
  std::vector<int> held, kept;  ///< k and m - k motions, ascending

  /// The start with its neutral part changed so that the motions `held` are 0.
  Start start(const Start& given) const;
  /// Motions of the given problem whose neutral part is that of `a_start` (m), from those that are left.
  Vector motions(const Vector& a_left, const Vector& a_start) const;
};

/// Nothing where there are no such motions, the loads drive one (`force_scale`: largest applied force), or W is known
/// by its products alone.
std::optional<WithoutNeutral> without_neutral(const Problem& problem, double force_scale);

}  // namespace scabo::contact
