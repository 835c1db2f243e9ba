// Displacement and stress of a super-element on the rings where it is sampled.
#pragma once

#include <functional>

#include "scabo/element/plane/interior_field.hpp"
#include "scabo/result/ring_sampling.hpp"

namespace scabo::result {

/// Stresses of every point of the ring at xi: the mean of the boundary elements that meet at it.
Eigen::Matrix3Xd ring_stresses(const element::SolvedSuperElement& super_element, const RingSampling& sampling,
                               const element::RadialField::Values& values, const Vec2& centre, double xi,
                               const element::InteriorLoads& interior);

using SetValues = std::function<void(const Vec2& u, const element::Vec3& stress, int material, const Vec2& x)>;

/// Values inside a super-element, `set(u, stress, material, x)` for each point in turn: at the rings from `first_level`
/// on, then at the centre. x is relative to the scaling centre. `field`: without particular solutions.
void values_inside(const element::SolvedSuperElement& super_element, const Vec2& centre, const RingSampling& sampling,
                   const element::RadialField& field, const element::InteriorLoads& interior, std::size_t first_level,
                   const SetValues& set);

}  // namespace scabo::result
