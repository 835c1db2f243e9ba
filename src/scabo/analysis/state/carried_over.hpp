// What pairs of a contact carry over to others on the same two sides, by arc length.
#pragma once

#include <vector>

#include "scabo/analysis/state/state.hpp"

namespace scabo::analysis {

/// Values of one pair.
struct CarriedPair {
  double at_a = 0.0, at_b = 0.0;       ///< arc length on the edges of the two bodies, or on the path of the crack
  double pressure = 0.0, shear = 0.0;  ///< on B; 0 beyond the last pair
  double slip = 0.0;                   ///< since the start
  Vec2 motion = Vec2::Zero();          ///< of B relative to A since the start
  int direction = 0;                   ///< of slip, of the nearest pairs in contact: 1 along t, -1 against it, 0 stick
  bool closed = false;
  contact::PairHistory history;
};

/// Of every contact, in the order of its pairs.
using CarriedPairs = std::vector<std::vector<CarriedPair>>;

/// `on`: the model on whose edges and cracks arc lengths are measured, which may have longer cracks than that of
/// `prepared`; by default the same.
CarriedPairs pairs_to_carry(const Prepared& prepared, const State& state, const model::Model* on = nullptr);

/// Arc length of a point on the path of a crack.
double arc_length_on(const model::Crack& crack, const Vec2& x);

/// The values at the pairs of another mesh of the same model: `before` interpolated on A and on B, and the mean of
/// both. In the order of its ContactSystem::pairs.
std::vector<CarriedPair> carried_to(const Prepared& prepared, const CarriedPairs& before);

}  // namespace scabo::analysis
