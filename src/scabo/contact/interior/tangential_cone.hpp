// The cone of a pair's tangential law, with its products and its scaling.
//
// Space: X = (b, p_t) and Y = (sigma, u_t) in the second-order cone {V_0 >= |V_t|}, with
//
//     X o Y = (X . Y, X_0 Y_t + Y_0 X_t)
//
// Plane: there the cone is the angle between two rays. With the components along them as coordinates it is the quadrant
// of positive numbers, X = (b_f + p_t, b_b - p_t) / sqrt 2, Y = sqrt 2 (v+, v-), u_t = v+ - v-, and the product is
// taken by components: two half-lines, whose bounds b may differ by direction.
//
// X o Y = m `middle()` is the point of the path of interior points, X . Y = m. One matrix scales both to the same
// point, F X = F^-1 Y (Nesterov and Todd, SIAM J. Optim. 8 (1998) 324); F = Q diag(phi) Q'. In the coordinates of Q the
// cone looks alike in the plane and in space: the first two components are (b + p_e, b - p_e) / sqrt 2 for one
// direction e of the tangents, and in space the third is the tangent across it.
#pragma once

#include <algorithm>
#include <cmath>

#include "scabo/base/types.hpp"

namespace scabo::contact {

template <int d>
struct TangentialCone;

template <>
struct TangentialCone<2> {
  using V = Vec2;
  using M = Mat2;
  using T = Eigen::Matrix<double, 1, 1>;   // components along the tangents
  using TT = Eigen::Matrix<double, 1, 1>;  // directions [e]

  /// X of a force under the bounds forward (of p_t < 0) and backward.
  static V of_force(double forward, double backward, const T& p_t) {
    return V(forward + p_t[0], backward - p_t[0]) / std::sqrt(2.0);
  }
  /// beta.Y, the motion that the normal force feels.
  static double lift(double forward, double backward, const V& Y) {
    return (forward * Y[0] + backward * Y[1]) / std::sqrt(2.0);
  }
  /// u_t of Y, or p_t of X where both bounds are equal.
  static T tangent(const V& Y) { return T((Y[0] - Y[1]) / std::sqrt(2.0)); }
  static V middle() { return V(0.5, 0.5); }
  static bool inside(const V& X) { return X.minCoeff() > 0.0; }
  static V product(const V& X, const V& Y) { return X.cwiseProduct(Y); }
  static V quotient(const V& R, const V& X) { return R.cwiseQuotient(X); }
  static double reach(const V& X, const V& dX) {
    double most = HUGE_VAL;
    for (int k = 0; k < 2; ++k)
      if (dX[k] < 0.0) most = std::min(most, -X[k] / dX[k]);
    return most;
  }
  static void scaling(const V& X, const V& Y, M& Q, TT& directions, V& phi) {
    Q.setIdentity();
    directions.setOnes();
    phi = Y.cwiseQuotient(X).cwiseSqrt();
  }
};

template <>
struct TangentialCone<3> {
  using V = Eigen::Vector3d;
  using M = Eigen::Matrix3d;
  using T = Vec2;
  using TT = Mat2;

  static V of_force(double bound, double, const T& p_t) { return {bound, p_t[0], p_t[1]}; }
  static double lift(double mu, double, const V& Y) { return mu * Y[0]; }
  static T tangent(const V& Y) { return Y.tail<2>(); }
  static V middle() { return V::UnitX(); }
  static double determinant(const V& X) {
    const double t = X.tail<2>().norm();
    return (X[0] - t) * (X[0] + t);
  }
  static bool inside(const V& X) { return X[0] > 0.0 && determinant(X) > 0.0; }
  static V product(const V& X, const V& Y) {
    V R;
    R << X.dot(Y), X[0] * Y.tail<2>() + Y[0] * X.tail<2>();
    return R;
  }
  /// Y of X o Y = R.
  static V quotient(const V& R, const V& X) {
    V Y;
    Y[0] = (X[0] * R[0] - X.tail<2>().dot(R.tail<2>())) / determinant(X);
    Y.tail<2>() = (R.tail<2>() - Y[0] * X.tail<2>()) / X[0];
    return Y;
  }
  /// The largest t for which X + t dX is in the cone.
  static double reach(const V& X, const V& dX) {
    const double a = determinant(dX.cwiseAbs()), c = determinant(X);
    const double b = X[0] * dX[0] - X.tail<2>().dot(dX.tail<2>()), discriminant = b * b - a * c;
    double most = dX[0] < 0.0 ? -X[0] / dX[0] : HUGE_VAL;
    if (discriminant < 0.0) return most;
    for (const double below : {-b + std::sqrt(discriminant), -b - std::sqrt(discriminant)}) {
      const double root = c / below;
      if (root > 0.0) most = std::min(most, root);
    }
    return most;
  }
  static void scaling(const V& X, const V& Y, M& Q, TT& directions, V& phi) {
    const double size_X = std::sqrt(determinant(X)), size_Y = std::sqrt(determinant(Y));
    const V X_unit = X / size_X, Y_unit = Y / size_Y;
    Vec2 t = Y_unit.tail<2>() - X_unit.tail<2>();
    t /= 2.0 * std::sqrt(0.5 * (1.0 + X_unit.dot(Y_unit)));
    const double size = t.norm(), most = std::sqrt(1.0 + size * size) + size;
    const Vec2 e = size > 0.0 ? Vec2(t / size) : Vec2(1.0, 0.0);
    const double half = std::sqrt(0.5);
    Q << half, half, 0.0,                  //
        half * e[0], -half * e[0], -e[1],  //
        half * e[1], -half * e[1], e[0];
    directions << e[0], -e[1], e[1], e[0];
    phi = std::sqrt(size_Y / size_X) * V(most, 1.0 / most, 1.0);
  }
};

}  // namespace scabo::contact
