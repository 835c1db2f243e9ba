// Basic types used throughout Scabo.
#pragma once

#include <Eigen/Core>

namespace scabo {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The unit vector `t` of a contact frame: `n` turned by -90 degrees (n = +y gives t = +x).
inline Vec2 tangent_of(const Vec2& normal) { return {normal.y(), -normal.x()}; }

/// Two-dimensional cross product, positive when `b` lies counter-clockwise of `a`.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace scabo
