// One load increment: from an accepted state to the next, halved where contact does not converge.
#pragma once

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/system/contact_system.hpp"

namespace scabo::analysis {

/// Everything an increment needs, made once.
struct Prepared {
  const model::Model& model;
  const mesh::Mesh& mesh;
  const system::Structure& structure;
  const system::ContactSystem& contact;
  double force_scale = 0.0;  ///< largest nodal force of any load at factor 1: what a force is small against, also where
                             ///< all loads are zero for a moment
};

/// Factors of loads and supports at one time.
struct Factors {
  std::vector<double> loads, supports;
};
Factors between(const Factors& from, const Factors& to, double part);

/// An accepted state: the history that the next increment starts from. A value: an increment that fails leaves none of
/// itself behind.
struct State {
  Factors factors;
  Vector p;                  // 2N, contact forces on B
  Vector a;                  // m, rigid motions
  Vector gap, slip;          // N; slip since the start
  contact::History history;  // N, of the laws
  std::vector<contact::ContactState> states;
  std::vector<Vector> u;           // per body
  std::vector<Vector> forces;      // per body: applied forces without contact
  std::vector<Vector> reactions;   // per body, one for each constraint
  std::vector<Vector> prescribed;  // per body, one for each constraint
  double largest_force = 0.0;      ///< so far: what a force is small against once a joint broke and all is unloaded
  Energy energy;
};
State initial_state(const Prepared& prepared);

/// Result of trying to reach `factors` from `from`, certificate included.
struct Attempt {
  State state;
  contact::Solution solution;
  contact::Certificate certificate;
  double rounding = 0.0;  ///< what of equilibrium and rigid balance rounding of the displacements alone can be
  bool accepted = false;
  contact::Problem problem;  ///< what was solved, from `start`; W is shared, not copied
  contact::Start start;
  double force_scale = 0.0;
  std::optional<UniquenessResult> uniqueness;
};
Attempt attempt(const Prepared& prepared, const State& from, const Factors& factors);

/// The problem of an attempt as others can solve it.
DiscreteProblem discrete_problem(const Prepared& prepared, const Attempt& attempt);

/// What users see of an accepted state.
IncrementResult describe(const Prepared& prepared, const State& state);

/// Bodies whose displacements pass a tenth of their size, where small displacements are no longer small: a sentence for
/// the first, empty where there is none.
std::string too_large(const Prepared& prepared, const State& state);

/// `body 'upper': translation along (1, 0)` for rigid motions `a`.
std::string describe_motions(const Prepared& prepared, const Vector& a);

}  // namespace scabo::analysis
